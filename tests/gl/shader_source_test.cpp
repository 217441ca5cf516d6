#include "gl/shader_source.h"

#include <gmock/gmock.h>

#include "gelatin/error.h"
#include "gl/embedded_shaders.h"
#include "support/environment.h"
#include "support/shader_folder.h"
#include "support/source_path.h"

namespace gelatin::gl {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error_of(const std::string& file) {
    try {
        load_shader(file);
    } catch (const GlError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ShaderSourceTest, ExpandsIncludesWithTrueLines) {
    test::ShaderFolder folder;
    folder.add("a.comp", "one\n#include \"sub/b.glsl\"\nthree\n");
    folder.add("sub/b.glsl", "b one\n");
    const ShaderSource source = load_shader("a.comp");
    EXPECT_EQ(source.text, "#version 430 core\n#line 1 0\none\n#line 1 1\nb one\n#line 3 0\nthree\n");
    EXPECT_THAT(source.files, ElementsAre("a.comp", "sub/b.glsl"));
}

TEST(ShaderSourceTest, PutsDefinesAfterTheVersion) {
    test::ShaderFolder folder;
    folder.add("a.comp", "x\n");
    EXPECT_THAT(load_shader("a.comp", {"FUSED", "SIZE 64"}).text,
                StartsWith("#version 430 core\n#define FUSED\n#define SIZE 64\n#line 1 0\n"));
}

TEST(ShaderSourceTest, TakesEachFileOnce) {
    test::ShaderFolder folder;
    folder.add("a.comp", "#include \"b.glsl\"\n  # include \"c.glsl\"  // again b\n#include \"b.glsl\"\n");
    folder.add("b.glsl", "only once\n");
    folder.add("c.glsl", "#include \"b.glsl\"\n");
    const std::string text = load_shader("a.comp").text;
    const std::size_t first = text.find("only once");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(text.find("only once", first + 1), std::string::npos);
}

TEST(ShaderSourceTest, IgnoresIncludesInComments) {
    test::ShaderFolder folder;
    folder.add("a.comp", "// #include \"missing.glsl\"\n");
    EXPECT_EQ(error_of("a.comp"), "no error");
}

TEST(ShaderSourceTest, MissingIncludeNamesWhereItIsAskedFor) {
    test::ShaderFolder folder;
    folder.add("a.comp", "\n#include \"sub/b.glsl\"\n");
    folder.add("sub/b.glsl", "\n\n#include \"missing.glsl\"\n");
    EXPECT_THAT(error_of("a.comp"), StartsWith("sub/b.glsl:3: no shader missing.glsl"));
    EXPECT_THAT(error_of("a.comp"), HasSubstr(folder.path().string()));
}

TEST(ShaderSourceTest, MissingFileIsNamed) {
    EXPECT_THAT(error_of("no/such.comp"), StartsWith("no shader no/such.comp"));
}

TEST(ShaderSourceTest, CircleIsNamed) {
    test::ShaderFolder folder;
    folder.add("a.comp", "#include \"b.glsl\"\n");
    folder.add("b.glsl", "\n#include \"a.comp\"\n");
    EXPECT_THAT(error_of("a.comp"), StartsWith("b.glsl:2: #include of a.comp goes round in a circle"));
}

TEST(ShaderSourceTest, EmbeddedFilesAreThoseOfTheSourceTree) {
    const std::string embedded = load_shader("include/global_index.glsl").text;
    const test::EnvironmentVariable variable("GELATIN_SHADER_DIR", test::source_path("shaders"));
    EXPECT_EQ(load_shader("include/global_index.glsl").text, embedded);
    EXPECT_GT(embedded_shaders().size(), 5u);
}

TEST(ShaderSourceTest, AnOverrideComesBeforeFilesForAsLongAsItLives) {
    const char* const file = "include/global_index.glsl";
    const std::string original = shader_text(file);
    {
        const ShaderOverride other(file, "another\n"),
            added("a.comp", "#include \"include/global_index.glsl\"\n");
        EXPECT_EQ(shader_text(file), "another\n");
        EXPECT_THAT(load_shader("a.comp").text, HasSubstr("another"));
        const test::EnvironmentVariable variable("GELATIN_SHADER_DIR", test::source_path("shaders"));
        EXPECT_EQ(shader_text(file), "another\n");
    }
    EXPECT_EQ(shader_text(file), original);
    EXPECT_THAT(error_of("a.comp"), StartsWith("no shader a.comp"));
}

TEST(ShaderSourceTest, TranslatesEachVendorsPositions) {
    const ShaderSource source{"", {"a.comp", "b.glsl"}};
    EXPECT_EQ(source.translate_log("1:14(3): error: x\n"), "b.glsl:14(3): error: x\n");         // Mesa
    EXPECT_EQ(source.translate_log("0(14) : error C1008: x"), "a.comp:14 : error C1008: x\n");  // NVIDIA
    EXPECT_EQ(source.translate_log("ERROR: 1:14: x\n"), "ERROR: b.glsl:14: x\n");  // AMD, Intel, Apple
    EXPECT_EQ(source.translate_log("7:14(3): error: x\nno position\n"), "7:14(3): error: x\nno position\n");
}

}  // namespace
}  // namespace gelatin::gl
