#include "gl/program.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "gelatin/error.h"
#include "gl/buffer.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"
#include "support/source_path.h"

namespace gelatin::gl {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ProgramTest : public test::GlTest {
protected:
    test::ShaderFolder folder_;

    std::string error_of(const std::string& file) {
        try {
            Program::compute(file);
        } catch (const GlError& error) {
            ignore_debug_messages();
            return error.what();
        }
        return "no error";
    }
};

TEST_F(ProgramTest, CompileErrorNamesTheTrueFileAndLine) {
    folder_.add(
        "main.comp",
        "layout(local_size_x = 64) in;\n#include \"good.glsl\"\n#include \"bad.glsl\"\nvoid main() {}\n");
    folder_.add("good.glsl", "float good() { return 1.0; }\n\n\n");
    folder_.add("bad.glsl", "// fine\nfloat bad() {\n    return undefined_name;\n}\n");
    const std::string message = error_of("main.comp");
    EXPECT_THAT(message, HasSubstr("main.comp does not compile"));
    EXPECT_THAT(message, HasSubstr("bad.glsl:3"));
    EXPECT_THAT(message, HasSubstr("undefined_name"));
}

TEST_F(ProgramTest, CompileErrorAfterAnIncludeNamesTheIncludingFile) {
    folder_.add("main.comp",
                "layout(local_size_x = 64) in;\n#include \"good.glsl\"\nvoid main() { undefined_name(); }\n");
    folder_.add("good.glsl", "float good() { return 1.0; }\n\n\n");
    EXPECT_THAT(error_of("main.comp"), HasSubstr("main.comp:3"));
}

TEST_F(ProgramTest, LinkErrorNamesBothFiles) {
    folder_.add("a.vert", "float nowhere(); void main() { gl_Position = vec4(nowhere()); }\n");
    folder_.add("a.frag", "out vec4 o; void main() { o = vec4(1.0); }\n");
    try {
        Program::graphics("a.vert", "a.frag");
        FAIL() << "expected GlError";
    } catch (const GlError& error) {
        EXPECT_THAT(error.what(), HasSubstr("a.vert with a.frag does not link"));
    }
    ignore_debug_messages();
}

TEST_F(ProgramTest, LinksAGeometryShaderBetweenTheOthers) {
    folder_.add("a.vert", "out float a; void main() { a = 1.0; gl_Position = vec4(0.0); }\n");
    folder_.add("a.geom",
                "layout(points) in; layout(points, max_vertices = 1) out; in float a[]; out float b;\n"
                "void main() { b = a[0]; EmitVertex(); }\n");
    folder_.add("b.geom", "layout(points) in;\nvoid main() { nonsense }\n");
    folder_.add("a.frag", "in float b; out vec4 o; void main() { o = vec4(b); }\n");
    EXPECT_NE(Program::graphics_with_geometry("a.vert", "a.geom", "a.frag").id(), 0u);
    try {
        Program::graphics_with_geometry("a.vert", "b.geom", "a.frag");
        FAIL() << "expected GlError";
    } catch (const GlError& error) {
        EXPECT_THAT(error.what(), HasSubstr("b.geom does not compile"));
        EXPECT_THAT(error.what(), HasSubstr("b.geom:2"));
    }
    ignore_debug_messages();
}

TEST_F(ProgramTest, SetsUniformsOfEveryType) {
    folder_.add("uniforms.comp", R"(
        layout(local_size_x = 1) in;
        layout(std430) buffer Out { float values[]; };
        uniform float f; uniform int i; uniform uint u;
        uniform vec2 v2; uniform vec3 v3; uniform vec4 v4; uniform mat4 m; uniform float a[2];
        uniform float optimised_away;
        void main() {
            values[0] = f; values[1] = float(i); values[2] = float(u);
            values[3] = v2.y; values[4] = v3.z; values[5] = v4.w; values[6] = m[3][1];
            values[7] = a[0] + a[1];
        })");
    const Program program = Program::compute("uniforms.comp");
    program.set("f", 1.5f);
    program.set("i", -2);
    program.set("u", std::uint32_t{3});
    program.set("v2", glm::vec2(0, 4));
    program.set("v3", glm::vec3(0, 0, 5));
    program.set("v4", glm::vec4(0, 0, 0, 6));
    glm::mat4 matrix(0.0f);
    matrix[3][1] = 7.0f;
    program.set("m", matrix);
    program.set("a[0]", 8.0f);
    program.set("a[1]", 0.5f);
    program.set("optimised_away", 1.0f);

    const Buffer<float> buffer(8);
    program.bind("Out", buffer);
    program.dispatch(1);
    barrier(Barrier::buffer_update);
    std::vector<float> out(8);
    buffer.download(out);
    EXPECT_THAT(out, ElementsAre(1.5f, -2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 8.5f));
}

// Every invocation counts itself, so that one too few and one too many both show.
class DispatchTest : public ProgramTest {
protected:
    std::vector<std::uint32_t> visits(std::size_t invocations, std::uint32_t group_size) {
        const Program program = Program::compute("count.comp", {"GROUP_SIZE " + std::to_string(group_size)});
        program.set("count", static_cast<std::uint32_t>(invocations));
        Buffer<std::uint32_t> buffer(invocations + 1);
        buffer.upload(std::vector<std::uint32_t>(invocations + 1, 0));
        program.bind("Out", buffer);
        program.dispatch(invocations);
        barrier(Barrier::buffer_update);
        std::vector<std::uint32_t> out(invocations + 1);
        buffer.download(out);
        return out;
    }

    DispatchTest() {
        folder_.add("count.comp", R"(
            #include "global_index.glsl"
            layout(local_size_x = GROUP_SIZE) in;
            layout(std430) buffer Out { uint visits[]; };
            uniform uint count;
            void main() { uint i = global_index(); if (i < count) atomicAdd(visits[i], 1u); })");
        folder_.add("global_index.glsl", read_file(test::source_path("shaders/include/global_index.glsl")));
    }
};

TEST_F(DispatchTest, VisitsEachInvocationOnce) {
    for (const std::size_t invocations : {1u, 63u, 64u, 65u, 1000u}) {
        std::vector<std::uint32_t> counts = visits(invocations, 64);
        EXPECT_EQ(counts.back(), 0u);
        counts.pop_back();
        EXPECT_THAT(counts, Each(1u)) << invocations;
    }
}

class DispatchHeavy : public DispatchTest {};

TEST_F(DispatchHeavy, FoldsMoreThan65535Groups) {
    for (const std::size_t invocations : {65'535u * 4u, 65'535u * 4u + 1u, 65'536u * 9u + 3u}) {
        std::vector<std::uint32_t> counts = visits(invocations, 4);
        EXPECT_EQ(counts.back(), 0u);
        counts.pop_back();
        EXPECT_TRUE(std::all_of(counts.begin(), counts.end(), [](std::uint32_t n) { return n == 1; }))
            << invocations;
    }
}

TEST_F(DispatchTest, NothingRunsForNoInvocations) {
    EXPECT_THAT(visits(0, 64), ElementsAre(0u));
}

TEST_F(DispatchTest, MoreThanTwoDimensionsHoldIsAnError) {
    const Program program = Program::compute("count.comp", {"GROUP_SIZE 1"});
    EXPECT_THROW(program.dispatch(std::size_t{65'535} * 65'535 + 1), GlError);
}

TEST_F(DispatchTest, MovedFromProgramIsEmptyAndTheTargetsOldOneIsFreed) {
    Program source = Program::compute("count.comp", {"GROUP_SIZE 64"});
    Program target = Program::compute("count.comp", {"GROUP_SIZE 32"});
    const unsigned kept = source.id();
    const unsigned old = target.id();
    target = std::move(source);
    // What is tested: NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
    EXPECT_EQ(source.id(), 0u);
    EXPECT_EQ(target.id(), kept);
    EXPECT_FALSE(glIsProgram(old));
}

}  // namespace
}  // namespace gelatin::gl
