#include "gl/block_access.h"

#include <gtest/gtest.h>

namespace gelatin::gl {
namespace {

// "rw", "r" or "w"; empty where there is no such block.
std::string access_of(const std::string& source, const std::string& block) {
    const auto all = block_accesses(source);
    const auto found = all.find(block);
    if (found == all.end()) return {};
    return std::string(found->second.reads ? "r" : "") + (found->second.writes ? "w" : "");
}

TEST(BlockAccesses, AreWhatTheQualifiersSay) {
    const std::string source =
        "#version 430 core\n"
        "layout(std430, binding = 0) readonly buffer A { vec4 a[]; };\n"
        "layout(std430) writeonly buffer B { vec4 b[]; };\n"
        "layout(std430) coherent restrict\n    readonly\n    buffer C { vec4 c[]; } instance;\n"
        "readonly layout(std430) buffer D { vec4 d[]; };\n"
        "layout(std430) buffer E { vec4 e[]; };\n"
        "layout(std430) readonly writeonly buffer F { vec4 f[]; };\n"
        "uniform samplerBuffer texels;\n";
    EXPECT_EQ(access_of(source, "A"), "r");
    EXPECT_EQ(access_of(source, "B"), "w");
    EXPECT_EQ(access_of(source, "C"), "r");
    EXPECT_EQ(access_of(source, "D"), "r");
    EXPECT_EQ(access_of(source, "E"), "rw");
    EXPECT_EQ(access_of(source, "F"), "");
    EXPECT_EQ(block_accesses(source).size(), 6u);
}

TEST(BlockAccesses, LeaveOutComments) {
    const std::string source =
        "// readonly\nlayout(std430) buffer A { vec4 a[]; };\n"
        "/* readonly\n buffer C { float c[]; }; */ buffer B { vec4 b[]; };  // writeonly\n";
    EXPECT_EQ(access_of(source, "A"), "rw");
    EXPECT_EQ(access_of(source, "B"), "rw");
    EXPECT_EQ(access_of(source, "C"), "");
}

TEST(BlockAccesses, FollowConditions) {
    const std::string source =
        "#ifdef NODES\n"
        "readonly buffer A { vec4 a[]; };\n"
        "#  ifndef SMALL\nbuffer Inner { float i[]; };\n#  endif\n"
        "#elif defined(OBJECTS)\n"
        "writeonly buffer A { vec4 a[]; };\n"
        "#else\n"
        "buffer A { vec4 a[]; };\n"
        "#endif\n"
        "readonly buffer After { float f[]; };\n";
    EXPECT_EQ(access_of("#define NODES\n" + source, "A"), "r");
    EXPECT_EQ(access_of("#define NODES\n" + source, "Inner"), "rw");
    EXPECT_EQ(access_of("#define NODES\n#define SMALL 1\n" + source, "Inner"), "");
    EXPECT_EQ(access_of("#define OBJECTS\n" + source, "A"), "w");
    EXPECT_EQ(access_of("#define OBJECTS\n" + source, "Inner"), "");
    EXPECT_EQ(access_of("#define NODES\n#define OBJECTS\n" + source, "A"), "r");
    EXPECT_EQ(access_of("#define NODES\n#undef NODES\n" + source, "A"), "rw");
    EXPECT_EQ(access_of(source, "A"), "rw");
    EXPECT_EQ(access_of(source, "After"), "r");
}

TEST(BlockAccesses, OfBothBranchesWhereTheConditionIsNotUnderstood) {
    const std::string source =
        "#if (KINDS & 2) != 0\nreadonly buffer A { vec4 a[]; };\n#else\nwriteonly buffer A { vec4 a[]; "
        "};\n#endif\n";
    EXPECT_EQ(access_of(source, "A"), "rw");
}

}  // namespace
}  // namespace gelatin::gl
