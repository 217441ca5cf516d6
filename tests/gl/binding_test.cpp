#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <optional>
#include <string>
#include <vector>

#include "gelatin/error.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"

namespace gelatin::gl {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<float> values_in(const Buffer<float>& buffer) {
    std::vector<float> values(buffer.size());
    barrier(Barrier::buffer_update);
    buffer.download(values);
    return values;
}

// Out[0] = 10 A[0] + texel B[0].
class BindingTest : public test::GlTest {
protected:
    test::ShaderFolder folder_;
    Buffer<float> a_, b_, out_;
    BufferTexture b_texels_;
    std::optional<Program> program_;

    static Buffer<float> of(float value) { return Buffer<float>(std::span<const float>(&value, 1)); }

    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        folder_.add("sum.comp", R"(
            layout(local_size_x = 1) in;
            layout(std430) writeonly buffer Out { float sums[]; };
            layout(std430) readonly buffer A { float a[]; };
            uniform samplerBuffer b;
            uniform samplerBuffer unused;
            void main() { sums[0] = 10.0 * a[0] + texelFetch(b, 0).r; })");
        program_ = Program::compute("sum.comp");
        a_ = of(1.0f);
        b_ = of(2.0f);
        out_ = of(-1.0f);
        b_texels_ = BufferTexture(b_, TexelFormat::r32f);
    }

    void bind_all() {
        program_->bind("A", a_);
        program_->bind("b", b_texels_);
        program_->bind("Out", out_);
    }
    float result() {
        program_->dispatch(1);
        barrier(Barrier::storage);
        return values_in(out_)[0];
    }
    std::string error() {
        try {
            program_->dispatch(1);
            barrier(Barrier::storage);
        } catch (const GlError& e) {
            return e.what();
        }
        return "no error";
    }
};

TEST_F(BindingTest, ResourcesAreFoundByName) {
    bind_all();
    EXPECT_EQ(result(), 12.0f);
}

TEST_F(BindingTest, BindingsStayWithTheirProgram) {
    bind_all();
    const Program other = Program::compute("sum.comp");
    const Buffer<float> a = of(7.0f), out = of(-1.0f);
    other.bind("A", a);
    other.bind("b", b_texels_);
    other.bind("Out", out);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(result(), 12.0f);
        other.dispatch(1);
        barrier(Barrier::storage);
        EXPECT_EQ(values_in(out)[0], 72.0f);
    }
}

TEST_F(BindingTest, ABindingThatChangesBetweenDispatchesIsSeen) {
    bind_all();
    EXPECT_EQ(result(), 12.0f);
    const Buffer<float> seven = of(7.0f);
    program_->bind("A", seven);
    EXPECT_EQ(result(), 72.0f);
    const BufferTexture texels(seven, TexelFormat::r32f);
    program_->bind("b", texels);
    EXPECT_EQ(result(), 77.0f);
}

TEST_F(BindingTest, NamesThatTheLinkerDroppedAreIgnored) {
    bind_all();
    program_->bind("unused", b_texels_);
    EXPECT_EQ(result(), 12.0f);
}

TEST_F(BindingTest, WhatIsNotBoundIsNamedWithItsProgram) {
    EXPECT_THAT(error(), HasSubstr("sum.comp: nothing is bound to storage block A"));
    program_->bind("A", a_);
    EXPECT_THAT(error(), HasSubstr("storage block Out"));
    program_->bind("Out", out_);
    EXPECT_THAT(error(), HasSubstr("sampler b"));
    program_->bind("b", b_texels_);
    EXPECT_EQ(error(), "no error");
}

TEST_F(BindingTest, ABufferThatIsNoObjectIsNotBound) {
    bind_all();
    program_->bind("A", Buffer<float>());
    EXPECT_THAT(error(), HasSubstr("storage block A"));
}

TEST_F(BindingTest, ABufferThatWasDeletedIsNamedEvenWhereAnotherHasItsName) {
    bind_all();
    EXPECT_EQ(result(), 12.0f);
    a_ = of(3.0f);
    const Buffer<float> others[] = {of(4.0f), of(5.0f)};
    EXPECT_THAT(error(), HasSubstr("storage block A"));
    program_->bind("A", a_);
    b_texels_ = BufferTexture(others[0], TexelFormat::r32f);
    EXPECT_THAT(error(), HasSubstr("sampler b"));
}

TEST_F(BindingTest, ABufferThatMovesStaysBound) {
    bind_all();
    const Buffer<float> moved = std::move(a_);
    EXPECT_EQ(result(), 12.0f);
}

TEST_F(BindingTest, MakingATextureDoesNotDisturbTheNextDispatch) {
    bind_all();
    EXPECT_EQ(result(), 12.0f);
    const BufferTexture other(a_, TexelFormat::r32f);
    EXPECT_EQ(result(), 12.0f);
}

TEST_F(BindingTest, ForgettingTheStateBindsAgainWhatTheHostHasChanged) {
    bind_all();
    EXPECT_EQ(result(), 12.0f);
    glUseProgram(0);
    for (GLuint i = 0; i < 4; ++i) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
        glActiveTexture(GL_TEXTURE0 + i);
        glBindTexture(GL_TEXTURE_BUFFER, 0);
    }
    forget_state();
    EXPECT_EQ(result(), 12.0f);
}

TEST_F(BindingTest, NothingIsBoundAgainForADispatchOfTheSameProgram) {
    bind_all();
    EXPECT_EQ(result(), 12.0f);
    for (GLuint i = 0; i < 2; ++i) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
    program_->bind("A", a_);
    program_->use();
    GLint buffer = -1;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &buffer);
    EXPECT_EQ(buffer, 0);
    forget_state();
}

TEST_F(BindingTest, UniformsOfATypeThatCannotBeBoundAreNamed) {
    folder_.add("cube.comp", R"(
        layout(local_size_x = 1) in;
        layout(std430) buffer Out { vec4 value; };
        uniform samplerCube sky;
        void main() { value = textureLod(sky, vec3(1.0), 0.0); })");
    try {
        Program::compute("cube.comp");
        FAIL() << "expected GlError";
    } catch (const GlError& e) {
        EXPECT_THAT(e.what(), HasSubstr("cube.comp: uniform sky"));
    }
}

#ifndef NDEBUG
TEST_F(BindingTest, NamesThatTheSourceNeverHadAreAMistake) {
    EXPECT_DEATH(program_->bind("a_", a_), "declares");
}
#endif

// A picture of 4 x 1 pixels.
class DrawTest : public test::GlTest {
protected:
    test::ShaderFolder folder_;
    GLuint framebuffer_ = 0, renderbuffer_ = 0, vertex_array_ = 0;

    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        glGenVertexArrays(1, &vertex_array_);
        glBindVertexArray(vertex_array_);
        glGenRenderbuffers(1, &renderbuffer_);
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 4, 1);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer_);
        glViewport(0, 0, 4, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        folder_.add("color.frag", "in vec4 color; out vec4 o; void main() { o = color; }");
        // Points, a pixel each.
        folder_.add("place.glsl", R"(
            void place(uint pixel) { gl_Position = vec4((float(pixel) + 0.5) / 2.0 - 1.0, 0.0, 0.0, 1.0); })");
    }
    void TearDown() override {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glBindVertexArray(0);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteRenderbuffers(1, &renderbuffer_);
        glDeleteVertexArrays(1, &vertex_array_);
        GlTest::TearDown();
    }

    static std::vector<int> reds() {
        std::vector<std::uint8_t> bytes(16);
        glReadPixels(0, 0, 4, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        return {bytes[0], bytes[4], bytes[8], bytes[12]};
    }
};

TEST_F(DrawTest, DrawsWithoutInputs) {
    folder_.add("a.vert", R"(
        #include "place.glsl"
        out vec4 color;
        layout(std430) readonly buffer Reds { float reds[]; };
        void main() { place(uint(gl_VertexID)); color = vec4(reds[gl_VertexID], 0.0, 0.0, 1.0); })");
    const Program program = Program::graphics("a.vert", "color.frag");
    EXPECT_THROW(program.draw_arrays(Primitive::points, 3), GlError);
    const std::vector<float> values = {1.0f, 0.2f, 0.6f};
    const Buffer<float> buffer{std::span<const float>(values)};
    program.bind("Reds", buffer);
    program.draw_arrays(Primitive::points, 0);
    EXPECT_THAT(reds(), ElementsAre(0, 0, 0, 0));
    program.draw_arrays(Primitive::points, 3);
    EXPECT_THAT(reds(), ElementsAre(255, 51, 153, 0));
}

TEST_F(DrawTest, DrawsElementsFromInputsThatAreFoundByName) {
    folder_.add("a.vert", R"(
        in vec4 place;
        in vec4 tint;
        out vec4 color;
        void main() { gl_Position = place; color = tint; })");
    const Program program = Program::graphics("a.vert", "color.frag");
    const std::vector<glm::vec4> places = {{-0.75f, 0, 0, 1}, {-0.25f, 0, 0, 1}, {0.25f, 0, 0, 1}};
    const std::vector<std::uint32_t> tints = {0xFF000010u, 0xFF000020u, 0xFF000030u}, indices = {2, 0};
    const Buffer<glm::vec4> vertices{std::span<const glm::vec4>(places)};
    const Buffer<std::uint32_t> colors{std::span<const std::uint32_t>(tints)};
    const Buffer<std::uint32_t> elements{std::span<const std::uint32_t>(indices)};
    program.bind_input("place", vertices);
    EXPECT_THROW(program.draw_elements(Primitive::points, elements.id(), 2), GlError);
    program.bind_input("tint", colors);
    program.draw_elements(Primitive::points, elements.id(), 2);
    EXPECT_THAT(reds(), ElementsAre(0x10, 0, 0x30, 0));
    GLint enabled = GL_TRUE;
    glGetVertexAttribiv(0, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
    EXPECT_EQ(enabled, GL_FALSE);
}

TEST_F(DrawTest, DrawsWhatABufferSays) {
    folder_.add("a.vert", R"(
        #include "place.glsl"
        uniform sampler2D picture;
        out vec4 color;
        void main() { place(uint(gl_VertexID)); color = texelFetch(picture, ivec2(0), 0); })");
    const Program program = Program::graphics("a.vert", "color.frag");
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    const std::uint8_t texel[] = {80, 0, 0, 255};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    program.bind_texture("picture", texture);
    const std::vector<std::uint32_t> arguments = {9, 9, 9, 9, 2, 1, 1, 0};  // the second: points 1 and 2
    const Buffer<std::uint32_t> draws{std::span<const std::uint32_t>(arguments)};
    program.draw_arrays_indirect(Primitive::points, draws.id(), 16);
    EXPECT_THAT(reds(), ElementsAre(0, 80, 80, 0));
    glDeleteTextures(1, &texture);
}

}  // namespace
}  // namespace gelatin::gl
