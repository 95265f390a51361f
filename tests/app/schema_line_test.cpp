#include "app/schema_line.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

TEST(SchemaLine, StandsFirstAndReplacesAnother) {
    EXPECT_EQ(with_schema_line("version = 1\n", "/a b/ひ.json"),
              "#:schema file:///a%20b/%E3%81%B2.json\nversion = 1\n");
    EXPECT_EQ(with_schema_line("#:schema ../old.json\nversion = 1\n", "/new.json"),
              "#:schema file:///new.json\nversion = 1\n");
    EXPECT_EQ(with_schema_line("#:schema ../old.json\nversion = 1\n", {}), "version = 1\n");
}

TEST(SchemaLine, NamesTheFileBesideTheProgramOrWhereItIsInstalled) {
    const TemporaryFolder folder;
    const auto program = folder.path() / "bin/hibi";
    EXPECT_FALSE(schema_file(program));
    const auto installed = folder.path() / "share/hibi/scene.schema.json",
               beside = folder.path() / "bin/scene.schema.json";
    for (const auto& file : {installed, beside}) {
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << "{}";
        EXPECT_EQ(schema_file(program), file);
    }
}

}  // namespace
}  // namespace hibi
