#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gl/barrier.h"

namespace gelatin::gl {

/// "NAME" or "NAME VALUE", inserted as #define after the version line.
using Defines = std::vector<std::string>;

/// Owns a linked program made of files below shaders/ (shader_source.h). Move-only.
class Program {
public:
    Program() = default;
    /// @throws GlError with the driver's log, its positions translated to true file names and lines.
    static Program compute(const std::string& file, const Defines& defines = {});
    static Program graphics(const std::string& vertex_file, const std::string& fragment_file,
                            const Defines& defines = {});
    static Program graphics_with_geometry(const std::string& vertex_file, const std::string& geometry_file,
                                          const std::string& fragment_file, const Defines& defines = {});
    Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Program& operator=(Program&& other) noexcept;
    ~Program();

    unsigned id() const { return id_; }
    void use() const;

    /// Uniforms keep their value until set again; the program need not be in use. A name that the linker
    /// optimised away is ignored.
    void set(const char* name, float value) const;
    void set(const char* name, int value) const;
    void set(const char* name, std::uint32_t value) const;
    void set(const char* name, const glm::ivec2& value) const;
    void set(const char* name, const glm::vec2& value) const;
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::vec4& value) const;
    void set(const char* name, const glm::uvec4& value) const;
    void set(const char* name, const glm::mat4& value) const;

    /// Uses the program and runs ceil(invocations / group_size) work groups, folded into two dimensions where
    /// one is not enough; shaders take their index from include/global_index.glsl. Nothing runs for 0
    /// invocations.
    void dispatch(std::size_t invocations, std::uint32_t group_size = 64) const;

    /// Uses the program and runs as many work groups as three uints at `offset` [bytes] in GL buffer
    /// `arguments` say, each at most 65,535. Needs barrier(command) since they were written.
    void dispatch_indirect(unsigned arguments, std::size_t offset) const;

private:
    unsigned id_ = 0;
};

/// Waits until the GPU has done everything it was told.
void finish();

}  // namespace gelatin::gl
