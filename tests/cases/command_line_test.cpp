// What the program brings for editors and shells, as they use it.
#include <gtest/gtest.h>

#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

TEST(WebNew, ScenesNameTheSchemaOfTheProgramAndAreAcceptedByIt) {
    const TemporaryFolder folder;
    const std::string in_folder = "cd " + folder.path().string() + " && ";
    ASSERT_EQ(
        call(in_folder + HIBI_PROGRAM " new starter && " HIBI_PROGRAM " new copy --from bending_fine").status,
        0);
    const std::string lint = HIBI_WEB "/node_modules/.bin/taplo lint --no-auto-config ";
    Answer answer = call(in_folder + lint + "starter.toml copy.toml");
    EXPECT_EQ(answer.status, 0) << answer.out;
    ASSERT_EQ(call(in_folder + "sed -i 's/^ramp .*/ramp = true/' starter.toml copy.toml").status, 0);
    for (const char* name : {"starter.toml", "copy.toml"}) {
        answer = call(in_folder + lint + name);
        EXPECT_NE(answer.status, 0) << name;
        EXPECT_NE(answer.out.find("true is not of types"), std::string::npos) << answer.out;
    }
}

}  // namespace
}  // namespace hibi
