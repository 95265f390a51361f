# What `cmake --install` puts where, and the Debian package:
#     cmake --build --preset release && cpack --preset release       build/release/hibi_VERSION_ARCHITECTURE.deb
include(GNUInstallDirs)

# Written by the program itself, beside it.
set(written ${CMAKE_BINARY_DIR})
add_custom_command(TARGET hibi POST_BUILD
    COMMAND hibi schema > ${written}/scene.schema.json  # `hibi new` names it in the scenes that it writes
    COMMAND hibi manual > ${written}/hibi.1
    COMMAND gzip -9nf ${written}/hibi.1
    COMMAND hibi completion bash > ${written}/hibi.bash
    COMMAND hibi completion zsh > ${written}/hibi.zsh
    COMMAND hibi completion fish > ${written}/hibi.fish
    BYPRODUCTS ${written}/scene.schema.json ${written}/hibi.1.gz ${written}/hibi.bash ${written}/hibi.zsh
               ${written}/hibi.fish
    VERBATIM)

install(TARGETS hibi)
install(FILES ${written}/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/hibi)
install(FILES ${written}/hibi.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${written}/hibi.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hibi)
# zsh of Debian reads the first below /usr/local, the second below /usr.
foreach(folder IN ITEMS site-functions vendor-completions)
    install(FILES ${written}/hibi.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder} RENAME _hibi)
endforeach()
install(FILES ${written}/hibi.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# The scenes name the schema where it lies then.
foreach(scene IN LISTS HIBI_SCENES)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scene})
    file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} ${scene})
    get_filename_component(folder ${name} DIRECTORY)
    file(READ ${scene} text)
    string(REPLACE "../build/release/scene.schema.json" "../scene.schema.json" text "${text}")
    file(GENERATE OUTPUT ${written}/packaging/${name} CONTENT "${text}")
    install(FILES ${written}/packaging/${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/hibi/${folder})
endforeach()

# Licences that ask to be handed on with what is compiled from headers and fonts.
set(HIBI_BUILT_IN_COPYRIGHTS "")
foreach(package IN ITEMS fonts-inter fonts-ipaexfont-gothic fonts-droid-fallback fonts-nanum fonts-noto-core
                         libcli11-dev libeigen3-dev nlohmann-json3-dev)
    set(file /usr/share/doc/${package}/copyright)
    if(EXISTS ${file})  # trees without documentation lack it
        file(READ ${file} text)
        string(APPEND HIBI_BUILT_IN_COPYRIGHTS "\n==== ${package} ====\n\n${text}")
    endif()
endforeach()
configure_file(packaging/copyright.in ${written}/packaging/copyright @ONLY)
install(FILES ${written}/packaging/copyright README.md CHANGELOG.md scenes/REFERENCE.md scenes/TESTING.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Hibi developers <developers@hibi.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "turns one text file into a fracture film")
set(CPACK_PACKAGE_DESCRIPTION
"A scene, one TOML file, describes bodies, supports and loads. A particle solver (MPS) breaks them; what happened
is recorded, drawn and encoded: a film, figures for print and a report, for engineers and students.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Opened at run time, so that nothing shows in the program: one OpenGL is needed, the other is for --gl egl.
set(CPACK_DEBIAN_PACKAGE_DEPENDS libosmesa6)
# The BLAS behind static runs may be any; this one is fast.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, libopenblas0-serial")
include(CPack)
