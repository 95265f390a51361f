# What ./run and ./test share, for bash: installs the Debian packages that are missing and builds the program.
# Everything said here goes to standard error; standard output belongs to the program.

set -euo pipefail
export LC_ALL=C.UTF-8
root="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"

# Names in dependencies.txt for the given user ("run"; "run|test").
packages_for() { awk -v who="^($1)\$" '$1 ~ who { print $2 }' "$root/dependencies.txt"; }

# Those of the arguments that are not installed.
missing_of() {
    local installed
    installed="$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${@%%=*}" 2>/dev/null || true)"
    local package
    for package in "$@"; do
        # PACKAGE=COMMAND: the command may come from elsewhere.
        [ "$package" = "${package#*=}" ] || ! command -v "${package#*=}" >/dev/null || continue
        grep -qx "installed ${package%%=*}" <<<"$installed" || echo "${package%%=*}"
    done
}

install_missing() {
    # Package names hold no spaces. No process substitution: it needs /proc, which a bare chroot lacks.
    local wanted missing
    wanted=($(packages_for "$1"))
    missing=($(missing_of "${wanted[@]}"))
    [ ${#missing[@]} -gt 0 ] || return 0

    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        # Without a terminal sudo could not ask for a password, and would wait or fail half-way.
        if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || { [ -t 0 ] && sudo true; }; }; then
            as_root=(sudo)
        else
            echo "Debian packages are missing and there is no right to install them. As root, type:" >&2
            echo "    apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
            exit 1
        fi
    fi
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
    echo "Installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
    # A source that cannot be reached need not be the one that has them: install decides.
    "${apt[@]}" -q update >&2 || true
    if ! "${apt[@]}" -q -y --no-install-recommends install "${missing[@]}" >&2; then
        echo "The packages could not be installed. What was tried, to be repeated by hand as root:" >&2
        echo "    apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
        exit 1
    fi
}

# Configures build/release where that has not been done, then builds the given target.
build() {
    local tree="$root/build/release" strict=OFF
    if [ "${CI:-}" = true ]; then strict=ON; fi
    if [ ! -f "$tree/build.ninja" ] || [ "$root/CMakePresets.json" -nt "$tree/CMakeCache.txt" ] ||
        ! grep -qx "HIBI_WERROR:BOOL=$strict" "$tree/CMakeCache.txt"; then
        # CMake looks for presets in the current folder.
        (cd "$root" && cmake --preset release -DHIBI_WERROR=$strict) >&2
    fi
    cmake --build "$tree" --target "$1" >&2
}
