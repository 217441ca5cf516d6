#include "gl/host_state.h"

#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/log.h"
#include "gl/get_integer.h"
#include "gl/object_name.h"

namespace gelatin::gl {
namespace {

// As many as this library's programs use at most, and room.
constexpr GLint kMostBlocks = 16, kMostUnits = 32, kMostViewports = 16, kMostDrawBuffers = 8;

struct Switch {
    GLenum name;
    bool usual;
};
constexpr Switch kHostSwitches[] = {
    {GL_COLOR_LOGIC_OP, false},
    {GL_CULL_FACE, false},
    {GL_DEPTH_CLAMP, false},
    {GL_DEPTH_TEST, false},
    {GL_DITHER, true},
    {GL_FRAMEBUFFER_SRGB, false},
    {GL_LINE_SMOOTH, false},
    {GL_MULTISAMPLE, true},
    {GL_POLYGON_OFFSET_FILL, false},
    {GL_POLYGON_OFFSET_LINE, false},
    {GL_POLYGON_OFFSET_POINT, false},
    {GL_POLYGON_SMOOTH, false},
    {GL_PRIMITIVE_RESTART, false},
    {GL_PRIMITIVE_RESTART_FIXED_INDEX, false},
    {GL_PROGRAM_POINT_SIZE, false},
    {GL_RASTERIZER_DISCARD, false},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, false},
    {GL_SAMPLE_ALPHA_TO_ONE, false},
    {GL_SAMPLE_COVERAGE, false},
    {GL_SAMPLE_MASK, false},
    {GL_STENCIL_TEST, false},
    {GL_TEXTURE_CUBE_MAP_SEAMLESS, false},
    {GL_CLIP_DISTANCE0, false},
    {GL_CLIP_DISTANCE1, false},
    {GL_CLIP_DISTANCE2, false},
    {GL_CLIP_DISTANCE3, false},
    {GL_CLIP_DISTANCE4, false},
    {GL_CLIP_DISTANCE5, false},
    {GL_CLIP_DISTANCE6, false},
    {GL_CLIP_DISTANCE7, false},
};

struct BufferTarget {
    GLenum target, binding;
};
constexpr BufferTarget kBuffers[] = {
    {GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
    {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING},
    {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING},
    {GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING},
    {GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
    {GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
    {GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
    {GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER},  // the binding of buffers, not of textures
};

struct PixelStorage {
    GLenum name;
    GLint usual;
};
constexpr PixelStorage kPixelStorage[] = {
    {GL_PACK_SWAP_BYTES, 0},   {GL_PACK_LSB_FIRST, 0},     {GL_PACK_ROW_LENGTH, 0},
    {GL_PACK_IMAGE_HEIGHT, 0}, {GL_PACK_SKIP_ROWS, 0},     {GL_PACK_SKIP_PIXELS, 0},
    {GL_PACK_SKIP_IMAGES, 0},  {GL_PACK_ALIGNMENT, 4},     {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_LSB_FIRST, 0},  {GL_UNPACK_ROW_LENGTH, 0},  {GL_UNPACK_IMAGE_HEIGHT, 0},
    {GL_UNPACK_SKIP_ROWS, 0},  {GL_UNPACK_SKIP_PIXELS, 0}, {GL_UNPACK_SKIP_IMAGES, 0},
    {GL_UNPACK_ALIGNMENT, 4},
};

GLuint get_name(GLenum name) {
    return static_cast<GLuint>(get_integer(name));
}

GLint at_most(GLint most, GLenum limit) {
    return std::min(most, get_integer(limit));
}

void set_switch(GLenum name, bool on) {
    (on ? glEnable : glDisable)(name);
}

// 0 for objects that have been deleted since: the application may have bound some of this library.
GLuint if_there(GLboolean is_there(GLuint), GLuint name) {
    return name != 0 && is_there(name) ? name : 0;
}
GLuint if_there(GLboolean is_there(GLuint), GLint name) {
    return if_there(is_there, static_cast<GLuint>(name));
}
GLboolean is_buffer(GLuint name) {
    return glIsBuffer(name);
}
GLboolean is_texture(GLuint name) {
    return glIsTexture(name);
}
GLboolean is_sampler(GLuint name) {
    return glIsSampler(name);
}

void report_pending_errors() {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
        log_warning(fmt::format("the application left OpenGL error 0x{:04x} pending", error));
}

struct Block {
    GLint buffer = 0;
    GLint64 start = 0, size = 0;
};

struct Unit {
    GLint texture_2d = 0, texture_buffer = 0, sampler = 0;
};

struct Viewport {
    std::array<GLfloat, 4> area{};
    std::array<GLdouble, 2> depths{};
    std::array<GLint, 4> scissor{};
    bool cuts = false;
};

// Of a draw buffer.
struct Blending {
    bool on = false;
    GLint source_rgb = 0, source_alpha = 0, target_rgb = 0, target_alpha = 0, equation_rgb = 0,
          equation_alpha = 0;
    std::array<GLboolean, 4> mask{};
};

bool has_clip_control() {
    return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
}

}  // namespace

struct HostState::Saved {
    GLuint program = get_name(GL_CURRENT_PROGRAM), vertex_array = get_name(GL_VERTEX_ARRAY_BINDING),
           draw_framebuffer = get_name(GL_DRAW_FRAMEBUFFER_BINDING),
           read_framebuffer = get_name(GL_READ_FRAMEBUFFER_BINDING),
           renderbuffer = get_name(GL_RENDERBUFFER_BINDING),
           storage = get_name(GL_SHADER_STORAGE_BUFFER_BINDING);
    std::array<GLuint, std::size(kBuffers)> buffers{};
    std::vector<Block> blocks;
    GLint active_unit = get_integer(GL_ACTIVE_TEXTURE);
    std::vector<Unit> units;
    std::array<bool, std::size(kHostSwitches)> switches{};
    std::array<GLint, std::size(kPixelStorage)> pixels{};
    std::vector<Viewport> viewports;
    std::vector<Blending> blending;
    GLint depth_function = get_integer(GL_DEPTH_FUNC), cull_face = get_integer(GL_CULL_FACE_MODE),
          front_face = get_integer(GL_FRONT_FACE), provoking_vertex = get_integer(GL_PROVOKING_VERTEX),
          polygon_mode = 0, clip_origin = 0, clip_depth = 0;
    GLboolean depth_mask = GL_TRUE;
    GLdouble clear_depth = 1.0;
    GLfloat offset_factor = 0.0f, offset_units = 0.0f;

    Saved();
    void set_defaults() const;
    void restore() const;

private:
    void save_bindings();
    void save_tests();
    void restore_bindings() const;
    void restore_tests() const;
};

HostState::Saved::Saved() {
    save_bindings();
    save_tests();
    for (std::size_t p = 0; p < pixels.size(); ++p) pixels[p] = get_integer(kPixelStorage[p].name);
}

void HostState::Saved::save_bindings() {
    for (std::size_t b = 0; b < buffers.size(); ++b) buffers[b] = get_name(kBuffers[b].binding);
    blocks.resize(static_cast<std::size_t>(at_most(kMostBlocks, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS)));
    for (GLuint b = 0; b < blocks.size(); ++b) {
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, b, &blocks[b].buffer);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, b, &blocks[b].start);
        glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, b, &blocks[b].size);
    }
    units.resize(static_cast<std::size_t>(at_most(kMostUnits, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS)));
    for (GLuint u = 0; u < units.size(); ++u) {
        glActiveTexture(GL_TEXTURE0 + u);
        units[u] = {get_integer(GL_TEXTURE_BINDING_2D), get_integer(GL_TEXTURE_BINDING_BUFFER),
                    get_integer(GL_SAMPLER_BINDING)};
    }
}

void HostState::Saved::save_tests() {
    for (std::size_t s = 0; s < switches.size(); ++s)
        switches[s] = glIsEnabled(kHostSwitches[s].name) == GL_TRUE;
    viewports.resize(static_cast<std::size_t>(at_most(kMostViewports, GL_MAX_VIEWPORTS)));
    for (GLuint v = 0; v < viewports.size(); ++v) {
        Viewport& viewport = viewports[v];
        glGetFloati_v(GL_VIEWPORT, v, viewport.area.data());
        glGetDoublei_v(GL_DEPTH_RANGE, v, viewport.depths.data());
        glGetIntegeri_v(GL_SCISSOR_BOX, v, viewport.scissor.data());
        viewport.cuts = glIsEnabledi(GL_SCISSOR_TEST, v) == GL_TRUE;
    }
    blending.resize(static_cast<std::size_t>(at_most(kMostDrawBuffers, GL_MAX_DRAW_BUFFERS)));
    for (GLuint d = 0; d < blending.size(); ++d) {
        Blending& of = blending[d];
        of.on = glIsEnabledi(GL_BLEND, d) == GL_TRUE;
        glGetIntegeri_v(GL_BLEND_SRC_RGB, d, &of.source_rgb);
        glGetIntegeri_v(GL_BLEND_SRC_ALPHA, d, &of.source_alpha);
        glGetIntegeri_v(GL_BLEND_DST_RGB, d, &of.target_rgb);
        glGetIntegeri_v(GL_BLEND_DST_ALPHA, d, &of.target_alpha);
        glGetIntegeri_v(GL_BLEND_EQUATION_RGB, d, &of.equation_rgb);
        glGetIntegeri_v(GL_BLEND_EQUATION_ALPHA, d, &of.equation_alpha);
        glGetBooleani_v(GL_COLOR_WRITEMASK, d, of.mask.data());
    }
    GLint modes[2] = {};  // some drivers return both sides
    glGetIntegerv(GL_POLYGON_MODE, modes);
    polygon_mode = modes[0];
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask);
    glGetDoublev(GL_DEPTH_CLEAR_VALUE, &clear_depth);
    glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &offset_factor);
    glGetFloatv(GL_POLYGON_OFFSET_UNITS, &offset_units);
    if (has_clip_control()) {
        clip_origin = get_integer(GL_CLIP_ORIGIN);
        clip_depth = get_integer(GL_CLIP_DEPTH_MODE);
    }
}

// What this library sets by itself whenever it needs it is left as it is.
void HostState::Saved::set_defaults() const {
    for (const Switch& each : kHostSwitches) set_switch(each.name, each.usual);
    for (const PixelStorage& each : kPixelStorage) glPixelStorei(each.name, each.usual);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);
    glBlendEquation(GL_FUNC_ADD);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthRange(0.0, 1.0);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glClearDepth(1.0);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    if (has_clip_control()) glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

void HostState::Saved::restore() const {
    restore_bindings();
    restore_tests();
    for (std::size_t p = 0; p < pixels.size(); ++p) glPixelStorei(kPixelStorage[p].name, pixels[p]);
}

void HostState::Saved::restore_bindings() const {
    for (GLuint u = 0; u < units.size(); ++u) {
        glActiveTexture(GL_TEXTURE0 + u);
        glBindTexture(GL_TEXTURE_2D, if_there(is_texture, units[u].texture_2d));
        glBindTexture(GL_TEXTURE_BUFFER, if_there(is_texture, units[u].texture_buffer));
        glBindSampler(u, if_there(is_sampler, units[u].sampler));
    }
    glActiveTexture(static_cast<GLenum>(active_unit));
    for (GLuint b = 0; b < blocks.size(); ++b) {
        const GLuint buffer = if_there(is_buffer, blocks[b].buffer);
        if (buffer != 0 && blocks[b].size > 0) {
            glBindBufferRange(GL_SHADER_STORAGE_BUFFER, b, buffer, static_cast<GLintptr>(blocks[b].start),
                              static_cast<GLsizeiptr>(blocks[b].size));
        } else {
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, b, buffer);
        }
    }
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, if_there(is_buffer, storage));
    for (std::size_t b = 0; b < buffers.size(); ++b)
        glBindBuffer(kBuffers[b].target, if_there(is_buffer, buffers[b]));
    glBindVertexArray(glIsVertexArray(vertex_array) ? vertex_array : 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, glIsFramebuffer(draw_framebuffer) ? draw_framebuffer : 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, glIsFramebuffer(read_framebuffer) ? read_framebuffer : 0);
    glBindRenderbuffer(GL_RENDERBUFFER, glIsRenderbuffer(renderbuffer) ? renderbuffer : 0);
    glUseProgram(glIsProgram(program) ? program : 0);
}

void HostState::Saved::restore_tests() const {
    for (std::size_t s = 0; s < switches.size(); ++s) set_switch(kHostSwitches[s].name, switches[s]);
    for (GLuint v = 0; v < viewports.size(); ++v) {
        const Viewport& viewport = viewports[v];
        glViewportIndexedfv(v, viewport.area.data());
        glDepthRangeIndexed(v, viewport.depths[0], viewport.depths[1]);
        glScissorIndexedv(v, viewport.scissor.data());
        (viewport.cuts ? glEnablei : glDisablei)(GL_SCISSOR_TEST, v);
    }
    for (GLuint d = 0; d < blending.size(); ++d) {
        const Blending& of = blending[d];
        const auto as_enum = [](GLint value) { return static_cast<GLenum>(value); };
        (of.on ? glEnablei : glDisablei)(GL_BLEND, d);
        glBlendFuncSeparatei(d, as_enum(of.source_rgb), as_enum(of.target_rgb), as_enum(of.source_alpha),
                             as_enum(of.target_alpha));
        glBlendEquationSeparatei(d, as_enum(of.equation_rgb), as_enum(of.equation_alpha));
        glColorMaski(d, of.mask[0], of.mask[1], of.mask[2], of.mask[3]);
    }
    glDepthFunc(static_cast<GLenum>(depth_function));
    glDepthMask(depth_mask);
    glClearDepth(clear_depth);
    glPolygonOffset(offset_factor, offset_units);
    glCullFace(static_cast<GLenum>(cull_face));
    glFrontFace(static_cast<GLenum>(front_face));
    glProvokingVertex(static_cast<GLenum>(provoking_vertex));
    glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(polygon_mode));
    if (has_clip_control()) glClipControl(static_cast<GLenum>(clip_origin), static_cast<GLenum>(clip_depth));
}

HostState::HostState() {
    report_pending_errors();
    saved_ = std::make_unique<Saved>();
    saved_->set_defaults();
    forget_state();
}

HostState::~HostState() {
    saved_->restore();
    forget_state();
}

}  // namespace gelatin::gl
