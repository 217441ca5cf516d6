#include "gl/program_interface.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "gelatin/error.h"

namespace gelatin::gl {
namespace {

// What textures a sampler of this type reads; none for what is no sampler.
std::optional<GLenum> texture_target(GLint type) {
    switch (type) {
        case GL_SAMPLER_BUFFER:
        case GL_INT_SAMPLER_BUFFER:
        case GL_UNSIGNED_INT_SAMPLER_BUFFER:
            return GL_TEXTURE_BUFFER;
        case GL_SAMPLER_2D:
        case GL_SAMPLER_2D_SHADOW:
        case GL_INT_SAMPLER_2D:
        case GL_UNSIGNED_INT_SAMPLER_2D:
            return GL_TEXTURE_2D;
        default:
            return std::nullopt;
    }
}

// What this layer cannot bind would be left unbound without a word.
bool is_unsupported(GLint type) {
    const bool is_value = type == GL_FLOAT || type == GL_INT || type == GL_UNSIGNED_INT || type == GL_BOOL ||
                          (type >= GL_FLOAT_VEC2 && type <= GL_FLOAT_MAT4) ||
                          (type >= GL_UNSIGNED_INT_VEC2 && type <= GL_UNSIGNED_INT_VEC4);
    return !is_value && !texture_target(type);
}

GLuint count_of(GLuint program, GLenum interface) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return static_cast<GLuint>(count);
}

// Without the "[0]" of an array.
std::string name_of(GLuint program, GLenum interface, GLuint index) {
    GLint longest = 0;
    glGetProgramInterfaceiv(program, interface, GL_MAX_NAME_LENGTH, &longest);
    std::string name(static_cast<std::size_t>(longest), '\0');
    GLsizei length = 0;
    glGetProgramResourceName(program, interface, index, longest, &length, name.data());
    name.resize(static_cast<std::size_t>(length));
    if (name.ends_with("[0]")) name.resize(name.size() - 3);
    return name;
}

template <std::size_t Count>
std::array<GLint, Count> properties_of(GLuint program, GLenum interface, GLuint index,
                                       const std::array<GLenum, Count>& properties) {
    std::array<GLint, Count> values{};
    glGetProgramResourceiv(program, interface, index, Count, properties.data(), Count, nullptr,
                           values.data());
    return values;
}

template <class T>
void sort_by_name(std::vector<T>& named) {
    std::sort(named.begin(), named.end(), [](const T& a, const T& b) { return a.name < b.name; });
}

template <class Vector>
auto* find_in(Vector& sorted, std::string_view name) {
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), name,
                                        [](const auto& a, std::string_view b) { return a.name < b; });
    return found != sorted.end() && found->name == name ? &*found : nullptr;
}

bool is_word_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

}  // namespace

ProgramInterface::ProgramInterface(unsigned program, [[maybe_unused]] std::string source) {
    reflect_uniforms(program);
    reflect_blocks(program);
    reflect_inputs(program);
#ifndef NDEBUG
    source_ = std::move(source);
#endif
}

void ProgramInterface::reflect_uniforms(unsigned program) {
    for (GLuint u = 0; u < count_of(program, GL_UNIFORM); ++u) {
        const std::string name = name_of(program, GL_UNIFORM, u);
        const auto [type, location, size] = properties_of<3>(
            program, GL_UNIFORM, u, std::array<GLenum, 3>{GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE});
        if (location < 0) continue;  // in a block
        if (is_unsupported(type)) throw GlError("uniform " + name + " is of a type that cannot be bound");
        if (const std::optional<GLenum> target = texture_target(type)) {
            const auto unit = static_cast<unsigned>(samplers_.size());
            glProgramUniform1i(program, location, static_cast<GLint>(unit));
            samplers_.push_back({name, unit, *target});
            continue;
        }
        uniforms_.push_back({name, location});
        for (GLint i = 0; i < size && size > 1; ++i) {
            const std::string element = name + "[" + std::to_string(i) + "]";
            uniforms_.push_back({element, glGetUniformLocation(program, element.c_str())});
        }
    }
    sort_by_name(uniforms_);
    sort_by_name(samplers_);
}

void ProgramInterface::reflect_blocks(unsigned program) {
    for (GLuint b = 0; b < count_of(program, GL_SHADER_STORAGE_BLOCK); ++b) {
        glShaderStorageBlockBinding(program, b, b);
        blocks_.push_back({name_of(program, GL_SHADER_STORAGE_BLOCK, b), b});
    }
    sort_by_name(blocks_);
}

void ProgramInterface::reflect_inputs(unsigned program) {
    for (GLuint i = 0; i < count_of(program, GL_PROGRAM_INPUT); ++i) {
        const auto [location] =
            properties_of<1>(program, GL_PROGRAM_INPUT, i, std::array<GLenum, 1>{GL_LOCATION});
        if (location < 0) continue;  // the language's own
        inputs_.push_back({name_of(program, GL_PROGRAM_INPUT, i), static_cast<unsigned>(location)});
    }
    sort_by_name(inputs_);
}

const ProgramInterface::Uniform* ProgramInterface::find_uniform(std::string_view name) const {
    return find_in(uniforms_, name);
}
ProgramInterface::Block* ProgramInterface::find_block(std::string_view name) {
    return find_in(blocks_, name);
}
ProgramInterface::Sampler* ProgramInterface::find_sampler(std::string_view name) {
    return find_in(samplers_, name);
}
ProgramInterface::Input* ProgramInterface::find_input(std::string_view name) {
    return find_in(inputs_, name);
}

std::string ProgramInterface::unbound() const {
    for (const Block& block : blocks_) {
        if (id_of(block.buffer) == 0) return "storage block " + block.name;
    }
    for (const Sampler& sampler : samplers_) {
        if (sampler.id() == 0) return "sampler " + sampler.name;
    }
    for (const Input& input : inputs_) {
        if (id_of(input.buffer) == 0) return "vertex input " + input.name;
    }
    return {};
}

bool ProgramInterface::declares(std::string_view name) const {
    if (source_.empty()) return true;
    name = name.substr(0, name.find('['));
    for (std::size_t at = source_.find(name); at != std::string::npos; at = source_.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_word_part(source_[at - 1])) &&
            (end == source_.size() || !is_word_part(source_[end])))
            return true;
    }
    return false;
}

}  // namespace gelatin::gl
