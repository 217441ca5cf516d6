// An application that uses OpenGL's state heavily, in whose context Gelatin simulates and draws: neither of
// the two may notice the other.
#include <epoxy/gl.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "gelatin/log.h"
#include "gelatin/picture.h"
#include "gl/debug.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

// What is one value, or four at most. More than gl::HostState keeps.
constexpr GLenum kIntegers[] = {
    GL_CURRENT_PROGRAM,
    GL_PROGRAM_PIPELINE_BINDING,
    GL_VERTEX_ARRAY_BINDING,
    GL_ARRAY_BUFFER_BINDING,
    GL_ELEMENT_ARRAY_BUFFER_BINDING,
    GL_COPY_READ_BUFFER_BINDING,
    GL_COPY_WRITE_BUFFER_BINDING,
    GL_DISPATCH_INDIRECT_BUFFER_BINDING,
    GL_DRAW_INDIRECT_BUFFER_BINDING,
    GL_PIXEL_PACK_BUFFER_BINDING,
    GL_PIXEL_UNPACK_BUFFER_BINDING,
    GL_SHADER_STORAGE_BUFFER_BINDING,
    GL_UNIFORM_BUFFER_BINDING,
    GL_TRANSFORM_FEEDBACK_BUFFER_BINDING,
    GL_TEXTURE_BUFFER,
    GL_DRAW_FRAMEBUFFER_BINDING,
    GL_READ_FRAMEBUFFER_BINDING,
    GL_RENDERBUFFER_BINDING,
    GL_ACTIVE_TEXTURE,
    GL_DEPTH_FUNC,
    GL_DEPTH_WRITEMASK,
    GL_CULL_FACE_MODE,
    GL_FRONT_FACE,
    GL_PROVOKING_VERTEX,
    GL_LOGIC_OP_MODE,
    GL_STENCIL_FUNC,
    GL_STENCIL_REF,
    GL_STENCIL_FAIL,
    GL_STENCIL_WRITEMASK,
    GL_STENCIL_CLEAR_VALUE,
    GL_PRIMITIVE_RESTART_INDEX,
    GL_PATCH_VERTICES,
    GL_DRAW_BUFFER,
    GL_READ_BUFFER,
    GL_CLIP_ORIGIN,
    GL_CLIP_DEPTH_MODE,
    GL_PACK_SWAP_BYTES,
    GL_PACK_LSB_FIRST,
    GL_PACK_ROW_LENGTH,
    GL_PACK_IMAGE_HEIGHT,
    GL_PACK_SKIP_ROWS,
    GL_PACK_SKIP_PIXELS,
    GL_PACK_SKIP_IMAGES,
    GL_PACK_ALIGNMENT,
    GL_UNPACK_SWAP_BYTES,
    GL_UNPACK_LSB_FIRST,
    GL_UNPACK_ROW_LENGTH,
    GL_UNPACK_IMAGE_HEIGHT,
    GL_UNPACK_SKIP_ROWS,
    GL_UNPACK_SKIP_PIXELS,
    GL_UNPACK_SKIP_IMAGES,
    GL_UNPACK_ALIGNMENT,
};
constexpr GLenum kFloats[] = {
    GL_COLOR_CLEAR_VALUE, GL_DEPTH_CLEAR_VALUE,     GL_BLEND_COLOR,          GL_LINE_WIDTH,
    GL_POINT_SIZE,        GL_POLYGON_OFFSET_FACTOR, GL_POLYGON_OFFSET_UNITS, GL_SAMPLE_COVERAGE_VALUE,
};
constexpr GLenum kSwitches[] = {
    GL_COLOR_LOGIC_OP,
    GL_CULL_FACE,
    GL_DEPTH_CLAMP,
    GL_DEPTH_TEST,
    GL_DITHER,
    GL_FRAMEBUFFER_SRGB,
    GL_LINE_SMOOTH,
    GL_MULTISAMPLE,
    GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_OFFSET_LINE,
    GL_POLYGON_OFFSET_POINT,
    GL_POLYGON_SMOOTH,
    GL_PRIMITIVE_RESTART,
    GL_PRIMITIVE_RESTART_FIXED_INDEX,
    GL_PROGRAM_POINT_SIZE,
    GL_RASTERIZER_DISCARD,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_MASK,
    GL_STENCIL_TEST,
    GL_TEXTURE_CUBE_MAP_SEAMLESS,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE7,
};
constexpr GLuint kBlocks = 16, kUnits = 32, kViewports = 16, kDrawBuffers = 8;

class StateDump {
public:
    StateDump() {
        for (const GLenum name : kIntegers) {
            GLint values[4] = {};
            glGetIntegerv(name, values);
            add(name, 0, values);
        }
        for (const GLenum name : kFloats) {
            GLfloat values[4] = {};
            glGetFloatv(name, values);
            add(name, 0, values);
        }
        for (const GLenum name : kSwitches) add(name, 0, std::array{glIsEnabled(name)});
        GLint modes[2] = {};
        glGetIntegerv(GL_POLYGON_MODE, modes);
        add(GL_POLYGON_MODE, 0, std::array{modes[0]});
        for (GLuint b = 0; b < kBlocks; ++b) add_block(b);
        for (GLuint v = 0; v < kViewports; ++v) add_viewport(v);
        for (GLuint d = 0; d < kDrawBuffers; ++d) add_draw_buffer(d);
        add_units();
        add_vertex_attributes();
    }

    std::vector<std::string> lines;

private:
    template <class Values>
    void add(GLenum name, GLuint index, const Values& values) {
        std::string line = fmt::format("0x{:04x}[{}] =", name, index);
        for (const auto value : values) line += fmt::format(" {}", static_cast<double>(value));
        lines.push_back(line);
    }
    void add_block(GLuint b) {
        GLint64 values[3] = {};
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_BINDING, b, &values[0]);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, b, &values[1]);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, b, &values[2]);
        add(GL_SHADER_STORAGE_BUFFER_BINDING, b, values);
        GLint uniforms = 0;
        glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, b, &uniforms);
        add(GL_UNIFORM_BUFFER_BINDING, b, std::array{uniforms});
    }
    void add_viewport(GLuint v) {
        GLfloat area[4] = {};
        glGetFloati_v(GL_VIEWPORT, v, area);
        add(GL_VIEWPORT, v, area);
        GLdouble depths[2] = {};
        glGetDoublei_v(GL_DEPTH_RANGE, v, depths);
        add(GL_DEPTH_RANGE, v, depths);
        GLint box[4] = {};
        glGetIntegeri_v(GL_SCISSOR_BOX, v, box);
        add(GL_SCISSOR_BOX, v, box);
        add(GL_SCISSOR_TEST, v, std::array{glIsEnabledi(GL_SCISSOR_TEST, v)});
    }
    void add_draw_buffer(GLuint d) {
        for (const GLenum name : {GL_BLEND_SRC_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_RGB, GL_BLEND_DST_ALPHA,
                                  GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA}) {
            GLint value = 0;
            glGetIntegeri_v(name, d, &value);
            add(name, d, std::array{value});
        }
        GLboolean mask[4] = {};
        glGetBooleani_v(GL_COLOR_WRITEMASK, d, mask);
        add(GL_COLOR_WRITEMASK, d, mask);
        add(GL_BLEND, d, std::array{glIsEnabledi(GL_BLEND, d)});
    }
    void add_units() {
        GLint active = 0;
        glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
        for (GLuint u = 0; u < kUnits; ++u) {
            glActiveTexture(GL_TEXTURE0 + u);
            for (const GLenum name :
                 {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_BUFFER, GL_TEXTURE_BINDING_3D,
                  GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP, GL_SAMPLER_BINDING}) {
                GLint value = 0;
                glGetIntegerv(name, &value);
                add(name, u, std::array{value});
            }
        }
        glActiveTexture(static_cast<GLenum>(active));
    }
    void add_vertex_attributes() {
        for (GLuint a = 0; a < 16; ++a) {
            GLint values[3] = {};
            glGetVertexAttribiv(a, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &values[0]);
            glGetVertexAttribiv(a, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &values[1]);
            glGetVertexAttribiv(a, GL_VERTEX_ATTRIB_ARRAY_STRIDE, &values[2]);
            add(GL_VERTEX_ATTRIB_ARRAY_ENABLED, a, values);
        }
    }
};

// Draws a triangle whose colour comes from a storage block and a texture, and sets all state to unusual
// values.
class Host {
public:
    static constexpr int kSize = 32;

    Host() {
        make_program();
        make_objects();
        make_target();
        set_state();
    }
    ~Host() {
        glDeleteProgram(program_);
        glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
        glDeleteTextures(2, textures_);
        glDeleteSamplers(1, &sampler_);
        glDeleteVertexArrays(1, &vertex_array_);
        glDeleteFramebuffers(2, framebuffers_);
        glDeleteRenderbuffers(2, renderbuffers_);
        reset();
    }

    // With the state as it is.
    std::vector<std::uint8_t> draw() const {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        glDrawElements(GL_TRIANGLE_STRIP, 5, GL_UNSIGNED_INT, nullptr);
        // Through the host's own pixel buffer, rows and skips.
        glReadPixels(0, 0, kSize, kSize, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        std::vector<std::uint8_t> pixels(kPixelBytes);
        glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, kPixelBytes, pixels.data());
        return pixels;
    }

private:
    static constexpr GLsizeiptr kPixelBytes = 16384;

    static GLuint compile(GLenum kind, const char* text) {
        const GLuint shader = glCreateShader(kind);
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        GLint done = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
        EXPECT_TRUE(done);
        return shader;
    }
    void make_program() {
        program_ = glCreateProgram();
        const GLuint vertex = compile(GL_VERTEX_SHADER, R"(#version 430
            layout(location = 3) in vec4 corner;
            out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[4]; };
            void main() { gl_Position = corner; gl_ClipDistance[3] = corner.x + 0.7; })");
        const GLuint fragment = compile(GL_FRAGMENT_SHADER, R"(#version 430
            layout(std430, binding = 5) readonly buffer Colors { vec4 color; };
            layout(binding = 3) uniform sampler2D picture;
            layout(binding = 4) uniform samplerBuffer numbers;
            out vec4 result;
            void main() { result = color + texture(picture, vec2(1.25)) + texelFetch(numbers, 1); })");
        for (const GLuint shader : {vertex, fragment}) {
            glAttachShader(program_, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(program_);
    }
    GLuint make_buffer(GLenum target, GLsizeiptr bytes, const void* data) {
        GLuint buffer = 0;
        glGenBuffers(1, &buffer);
        glBindBuffer(target, buffer);
        glBufferData(target, bytes, data, GL_STATIC_DRAW);
        buffers_.push_back(buffer);
        return buffer;
    }
    void make_objects() {
        glGenVertexArrays(1, &vertex_array_);
        glBindVertexArray(vertex_array_);
        const float corners[] = {-1, -1, 0.3f, 1, 1, -1, 0.6f, 1, -1, 1, 0.2f, 1, 1, 1, 0.8f, 1};
        make_buffer(GL_ARRAY_BUFFER, sizeof(corners), corners);
        glVertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
        glEnableVertexAttribArray(3);
        const GLuint indices[] = {0, 1, 2, 77, 3};
        make_buffer(GL_ELEMENT_ARRAY_BUFFER, sizeof(indices), indices);
        std::vector<float> numbers(4096, 0.05f);
        for (const GLenum target : {GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_DISPATCH_INDIRECT_BUFFER,
                                    GL_DRAW_INDIRECT_BUFFER, GL_UNIFORM_BUFFER, GL_PIXEL_UNPACK_BUFFER})
            make_buffer(target, 16384, numbers.data());
        const GLuint storage = make_buffer(GL_SHADER_STORAGE_BUFFER, 16384, numbers.data());
        for (GLuint b = 0; b < kBlocks; ++b) {
            if (b % 3 == 2) {
                glBindBufferRange(GL_SHADER_STORAGE_BUFFER, b, storage, 256 * b, 256);
            } else if (b % 3 == 1) {
                glBindBufferBase(GL_SHADER_STORAGE_BUFFER, b, storage);
            }
        }
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers_[3]);
        glGenTextures(2, textures_);
        glGenSamplers(1, &sampler_);
        glSamplerParameteri(sampler_, GL_TEXTURE_WRAP_S, GL_MIRRORED_REPEAT);
        glSamplerParameteri(sampler_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        glBindTexture(GL_TEXTURE_2D, textures_[0]);
        const std::uint8_t texels[] = {10, 20, 30, 255, 60, 50, 40, 255, 90, 100, 110, 255, 5, 15, 25, 255};
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers_[7]);
        glBindTexture(GL_TEXTURE_BUFFER, textures_[1]);
        glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, storage);
        for (GLuint u = 0; u < kUnits; ++u) {
            glActiveTexture(GL_TEXTURE0 + u);
            glBindTexture(GL_TEXTURE_2D, textures_[0]);
            if (u % 2 == 0) glBindTexture(GL_TEXTURE_BUFFER, textures_[1]);
            glBindSampler(u, sampler_);
        }
        glActiveTexture(GL_TEXTURE0 + 7);
        glBindBuffer(GL_TEXTURE_BUFFER, storage);
        make_buffer(GL_PIXEL_PACK_BUFFER, kPixelBytes, nullptr);
    }
    void make_target() {
        glGenFramebuffers(2, framebuffers_);
        glGenRenderbuffers(2, renderbuffers_);
        for (int f = 0; f < 2; ++f) {
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[f]);
            glBindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[0]);
            if (f == 0) glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kSize, kSize);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                      renderbuffers_[0]);
        }
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[0]);
        glBindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[1]);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, kSize, kSize);
        glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                  renderbuffers_[1]);
    }
    void set_state() const {
        glUseProgram(program_);
        for (const GLenum each : {GL_DEPTH_TEST, GL_CULL_FACE, GL_PRIMITIVE_RESTART, GL_STENCIL_TEST,
                                  GL_CLIP_DISTANCE3, GL_FRAMEBUFFER_SRGB, GL_POLYGON_OFFSET_FILL,
                                  GL_DEPTH_CLAMP, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_PROGRAM_POINT_SIZE})
            glEnable(each);
        glDisable(GL_DITHER);
        glDisable(GL_MULTISAMPLE);
        glPrimitiveRestartIndex(77);
        for (GLuint v = 0; v < kViewports; ++v) {
            glViewportIndexedf(v, 1.0f, 2.0f, 28.0f - static_cast<float>(v), 27.0f);
            glDepthRangeIndexed(v, 0.9, 0.1 + 0.01 * v);
            glScissorIndexed(v, 3, static_cast<GLint>(v), 25, 20);
            if (v % 2 == 0) glEnablei(GL_SCISSOR_TEST, v);
        }
        for (GLuint d = 0; d < kDrawBuffers; ++d) {
            glBlendFuncSeparatei(d, GL_SRC_ALPHA, GL_ONE, GL_ZERO, GL_DST_ALPHA);
            glBlendEquationSeparatei(d, GL_FUNC_REVERSE_SUBTRACT, d % 2 == 0 ? GL_MAX : GL_FUNC_ADD);
            glColorMaski(d, GL_TRUE, d % 2 == 0, GL_TRUE, GL_FALSE);
            if (d % 2 == 0) glEnablei(GL_BLEND, d);
        }
        glDepthFunc(GL_GREATER);
        glDepthMask(GL_TRUE);
        glClearDepth(0.2);
        glClearColor(0.9f, 0.8f, 0.7f, 0.6f);
        glClearStencil(3);
        glStencilFunc(GL_EQUAL, 3, 0xFF);
        glStencilOp(GL_INCR, GL_DECR, GL_KEEP);
        glCullFace(GL_FRONT);
        glFrontFace(GL_CW);
        glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glPolygonOffset(-0.5f, -2.0f);
        glLogicOp(GL_XOR);
        if (epoxy_gl_version() >= 45) glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        glPixelStorei(GL_PACK_ALIGNMENT, 8);
        glPixelStorei(GL_PACK_ROW_LENGTH, kSize + 5);
        glPixelStorei(GL_PACK_SKIP_ROWS, 2);
        glPixelStorei(GL_PACK_SKIP_PIXELS, 1);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 19);
        glPixelStorei(GL_UNPACK_SKIP_PIXELS, 2);
    }
    // For the tests that come after.
    static void reset() {
        for (const GLenum each : kSwitches) glDisable(each);
        glEnable(GL_DITHER);
        glEnable(GL_MULTISAMPLE);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_BLEND);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthRange(0.0, 1.0);
        glDepthFunc(GL_LESS);
        glClearDepth(1.0);
        glCullFace(GL_BACK);
        glFrontFace(GL_CCW);
        glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        if (epoxy_gl_version() >= 45) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        for (const GLenum each : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
                                  GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS})
            glPixelStorei(each, 0);
        glPixelStorei(GL_PACK_ALIGNMENT, 4);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    }

    GLuint program_ = 0, sampler_ = 0, vertex_array_ = 0;
    GLuint textures_[2] = {}, framebuffers_[2] = {}, renderbuffers_[2] = {};
    std::vector<GLuint> buffers_;
};

Overlays many_overlays() {
    Overlays overlays;
    overlays.box_levels = 1;
    overlays.faces = true;
    overlays.arrow_time = 0.1f;
    overlays.objects = true;
    overlays.cut = CutPlane{};
    overlays.color_map = ColorMap{};
    return overlays;
}

Scene scene_of(SolverKind solver, BroadPhase broad_phase) {
    Scene scene = test::falling_balls();
    scene.simulation.solver = solver;
    scene.collision.broad_phase = broad_phase;
    if (broad_phase == BroadPhase::depth) scene.collision.response = CollisionResponse::restore;
    return scene;
}

/// All that a simulator does with OpenGL, one thing after the other.
struct Outcome {
    HostFrame frame;
    Picture picture, overlaid;
};

template <class AfterEach>
Outcome use_gelatin(const Scene& scene, const SimulatorOptions& options, const AfterEach& after) {
    Simulator simulator(scene, options);
    after("the constructor");
    for (int f = 0; f < 3; ++f) simulator.advance_frame();
    after("steps");
    simulator.begin_statistics();
    after("begin_statistics");
    simulator.take_statistics();
    after("take_statistics");
    simulator.render_view(many_overlays());
    after("render_view");
    simulator.positions();
    after("positions");
    std::vector<glm::vec3> velocities(simulator.object(0).nodes.count, glm::vec3(0.5f));
    simulator.set_velocities(0, velocities);
    after("set_velocities");
    simulator.set_forces(0, velocities);
    after("set_forces");
    simulator.pin(1, std::vector<std::uint32_t>{0, 1, 2});
    after("pin");
    simulator.advance_frame();
    after("another step");
    PictureOptions picture;
    picture.width = 96;
    picture.height = 64;
    PicturePainter painter(simulator, picture);
    after("a painter");
    Outcome outcome{simulator.read_frame(), painter.paint(), {}};
    after("a picture");
    painter.set_overlays(many_overlays());
    outcome.overlaid = painter.paint();
    after("a picture with overlays");
    simulator.reset();
    after("reset");
    return outcome;
}

class HostApplicationTest : public test::SimulatorFixture {
protected:
    void expect_that_neither_notices(const Scene& scene, Backend backend) {
        const Outcome expected = use_gelatin(scene, on(backend), [](const char*) {});
        const Host host;
        const StateDump state;
        const std::vector<std::uint8_t> picture = host.draw();
        EXPECT_GT(std::set<std::uint8_t>(picture.begin(), picture.end()).size(),
                  3u);  // there is something to see
        const auto check = [&](const char* what) {
            EXPECT_EQ(StateDump().lines, state.lines) << "after " << what;
            EXPECT_EQ(host.draw(), picture) << "after " << what;
        };
        const Outcome outcome = use_gelatin(scene, on(backend), check);
        check("the destructor");
        EXPECT_EQ(outcome.frame.positions, expected.frame.positions);
        EXPECT_EQ(outcome.picture.pixels, expected.picture.pixels);
        EXPECT_EQ(outcome.overlaid.pixels, expected.overlaid.pixels);
    }
};

TEST_F(HostApplicationTest, DoesNotNoticeImplicitSteps) {
    expect_that_neither_notices(scene_of(SolverKind::implicit, BroadPhase::hierarchy), Backend::gl);
}

TEST_F(HostApplicationTest, DoesNotNoticeCullingByDepth) {
    expect_that_neither_notices(scene_of(SolverKind::semi_implicit_euler, BroadPhase::depth), Backend::gl);
}

TEST_F(HostApplicationTest, DoesNotNoticeDrawingWhatTheCpuSimulates) {
    expect_that_neither_notices(scene_of(SolverKind::implicit, BroadPhase::hierarchy), Backend::cpu);
}

TEST_F(HostApplicationTest, MayBindBuffersThatGelatinDeletesLater) {
    const Scene scene = scene_of(SolverKind::implicit, BroadPhase::hierarchy);
    Simulator simulator(scene, on(Backend::gl));
    const RenderView view = simulator.render_view();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, view.node_positions);
    glBindBuffer(GL_COPY_READ_BUFFER, view.vertex_normals);
    simulator.set_material(scene.materials[0]);
    simulator.render_view();
    GLint bound = -1;
    glGetIntegerv(GL_COPY_READ_BUFFER_BINDING, &bound);
    EXPECT_EQ(bound, 0);
}

TEST_F(HostApplicationTest, IsToldOfItsOwnErrorInsteadOfTakingItForGelatins) {
    Simulator simulator(test::falling_balls(), on(Backend::gl));
    std::vector<std::string> lines;
    set_log_callback([&](Severity, std::string_view line) { lines.emplace_back(line); });
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBufferData(GL_ARRAY_BUFFER, 1, nullptr, GL_STATIC_DRAW);  // to no buffer
    simulator.step();
    set_log_callback({});
    ignore_debug_messages();
    EXPECT_THAT(lines, testing::Contains("the application left OpenGL error 0x0502 pending"));
}

}  // namespace
}  // namespace gelatin
