#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gl/barrier.h"
#include "gl/buffer.h"

namespace gelatin::gl {

class ProgramInterface;

/// "NAME" or "NAME VALUE", inserted as #define after the version line.
using Defines = std::vector<std::string>;

/// What vertices are joined to.
enum class Primitive { points, triangles, triangle_strip };

/// Owns a linked program made of files below shaders/ (shader_source.h), and knows what is bound to it: every
/// storage block and sampler is found by its name in the shader, and keeps what is bound to it, as uniforms
/// keep their values, until it is bound again. Shaders number none of them.
///
/// A dispatch or draw checks that everything that the program uses has a resource that still lives. It binds
/// nothing where the same program ran last. After OpenGL calls that are not this layer's, call forget_state.
///
/// Move-only. Owns nothing of what is bound to it.
class Program {
public:
    Program();
    /// @throws GlError with the driver's log, its positions translated to true file names and lines.
    static Program compute(const std::string& file, const Defines& defines = {});
    static Program graphics(const std::string& vertex_file, const std::string& fragment_file,
                            const Defines& defines = {});
    static Program graphics_with_geometry(const std::string& vertex_file, const std::string& geometry_file,
                                          const std::string& fragment_file, const Defines& defines = {});
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    unsigned id() const;

    /// @name What the program reads and writes
    /// The program need not be in use. A uniform that it does not have is ignored, since programs share what
    /// sets them. So is a block or sampler that the linker optimised away, which no std430 block is; one that
    /// is nowhere in the source asserts.
    /// @{
    void set(std::string_view uniform, float value) const;
    void set(std::string_view uniform, int value) const;
    void set(std::string_view uniform, std::uint32_t value) const;
    void set(std::string_view uniform, const glm::ivec2& value) const;
    void set(std::string_view uniform, const glm::vec2& value) const;
    void set(std::string_view uniform, const glm::vec3& value) const;
    void set(std::string_view uniform, const glm::vec4& value) const;
    void set(std::string_view uniform, const glm::uvec4& value) const;
    void set(std::string_view uniform, const glm::mat4& value) const;

    /// Whether its source has the name of a block or sampler: for lists of what several programs share.
    bool declares(std::string_view name) const;
    template <class T>
    void bind(std::string_view block, const Buffer<T>& buffer) const {
        bind_block(block, buffer.name());
    }
    /// To a samplerBuffer.
    void bind(std::string_view sampler, const BufferTexture& texels) const {
        bind_texels(sampler, texels.name());
    }
    template <class T>
    void bind(std::string_view sampler, const TexelTable<T>& table) const {
        bind_texels(sampler, table.texels().name());
    }
    /// Any of these, if its source has the name.
    template <class Resource>
    void bind_declared(std::string_view name, const Resource& resource) const {
        if (declares(name)) bind(name, resource);
    }
    /// To a sampler of any kind. Whether the texture is deleted meanwhile is not noticed.
    /// @param sampler_id a sampler object; 0: the texture's own parameters
    void bind_texture(std::string_view name, unsigned texture, unsigned sampler_id = 0) const;
    /// To an input of the vertex shader, of which it is read in order.
    void bind_input(std::string_view input, const Buffer<glm::vec4>& vertices) const;
    /// The same; each value is four bytes, red first, that stand for 0 to 1.
    void bind_input(std::string_view input, const Buffer<std::uint32_t>& colors) const;
    /// @}

    /// Runs as many work groups as hold that many invocations. Nothing runs for 0.
    /// @throws GlError if something is not bound, naming program and block; so do all that follow
    void dispatch(std::size_t invocations) const;
    /// Runs `groups` work groups, folded into two dimensions where one is not enough; shaders take their
    /// index from include/global_index.glsl.
    void dispatch_groups(std::size_t groups) const;

    /// Runs as many work groups as three uints at `offset` [bytes] in GL buffer
    /// `arguments` say, each at most 65,535. Needs barrier(command) since they were written.
    void dispatch_indirect(unsigned arguments, std::size_t offset) const;

    /// Draws `count` vertices, of which nothing but their number is known where the program has no inputs.
    /// Nothing is drawn for 0. @pre a vertex array object is bound; the same for those that follow
    void draw_arrays(Primitive primitive, std::size_t count) const;
    /// Draws the vertices that `count` uints of GL buffer `indices` name, from its `first` on.
    void draw_elements(Primitive primitive, unsigned indices, std::size_t count, std::size_t first = 0) const;
    /// Draws what four uints at `offset` [bytes] in GL buffer `arguments` say. Needs barrier(command) since
    /// they were written.
    void draw_arrays_indirect(Primitive primitive, unsigned arguments, std::size_t offset) const;

    /// Uses the program and binds its resources, for a dispatch or draw that the caller issues.
    void use() const;

private:
    struct State;

    void bind_block(std::string_view name, const ObjectName& buffer) const;
    void bind_texels(std::string_view name, const ObjectName& texture) const;
    void bind_vertices(std::string_view name, const ObjectName& buffer, bool is_color) const;
    int location(std::string_view name) const;
    void check_declared(std::string_view name) const;

    std::unique_ptr<State> state_;  // null for a default-made program
};

/// Unbinds the sampler objects that programs have left bound to texture units on this thread, where they
/// would decide how the textures of the application around this library are read.
void release_samplers();

/// Waits until the GPU has completed all commands.
void finish();

}  // namespace gelatin::gl
