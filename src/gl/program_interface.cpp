#include "gl/program_interface.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <regex>
#include <set>
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

GLint count_of(GLuint program, GLenum interface) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return count;
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

// Names that the source gives a number to.
std::set<std::string> numbered_names(const std::string& source) {
    static const std::regex pattern(R"(binding\s*=\s*\d+[^;{]*?(\w+)\s*(?:\[\w*\])?\s*[;{])");
    std::set<std::string> names;
    for (std::sregex_iterator match(source.begin(), source.end(), pattern), end; match != end; ++match)
        names.insert((*match)[1]);
    return names;
}

bool is_word_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

}  // namespace

ProgramInterface::ProgramInterface(unsigned program, std::string source) {
    const std::set<std::string> numbered = numbered_names(source);
    for (GLuint u = 0; u < static_cast<GLuint>(count_of(program, GL_UNIFORM)); ++u) {
        const std::string name = name_of(program, GL_UNIFORM, u);
        const auto [type, location, size] = properties_of<3>(
            program, GL_UNIFORM, u, std::array<GLenum, 3>{GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE});
        if (location < 0) continue;  // in a block
        if (is_unsupported(type)) throw GlError("uniform " + name + " is of a type that cannot be bound");
        if (const std::optional<GLenum> target = texture_target(type)) {
            samplers_.push_back({.name = name,
                                 .unit = 0,
                                 .target = *target,
                                 .texture = nullptr,
                                 .is_numbered = numbered.contains(name)});
            continue;
        }
        uniforms_.push_back({name, location});
        for (GLint i = 0; i < size && size > 1; ++i) {
            const std::string element = name + "[" + std::to_string(i) + "]";
            uniforms_.push_back({element, glGetUniformLocation(program, element.c_str())});
        }
    }
    for (GLuint b = 0; b < static_cast<GLuint>(count_of(program, GL_SHADER_STORAGE_BLOCK)); ++b) {
        const std::string name = name_of(program, GL_SHADER_STORAGE_BLOCK, b);
        blocks_.push_back({name, 0, nullptr, numbered.contains(name)});
    }
    for (GLuint i = 0; i < static_cast<GLuint>(count_of(program, GL_PROGRAM_INPUT)); ++i) {
        const std::string name = name_of(program, GL_PROGRAM_INPUT, i);
        const auto [location] =
            properties_of<1>(program, GL_PROGRAM_INPUT, i, std::array<GLenum, 1>{GL_LOCATION});
        if (location >= 0) inputs_.push_back({name, static_cast<unsigned>(location), nullptr, false});
    }
    sort_by_name(uniforms_);
    sort_by_name(blocks_);
    sort_by_name(samplers_);
    sort_by_name(inputs_);

    std::set<GLint> taken;
    for (Block& block : blocks_) {
        if (!block.is_numbered) continue;
        const GLuint index = glGetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, block.name.c_str());
        const auto [binding] = properties_of<1>(program, GL_SHADER_STORAGE_BLOCK, index,
                                                std::array<GLenum, 1>{GL_BUFFER_BINDING});
        block.index = static_cast<unsigned>(binding);
        taken.insert(binding);
    }
    GLint next = 0;
    for (Block& block : blocks_) {
        if (block.is_numbered) continue;
        while (taken.contains(next)) ++next;
        block.index = static_cast<unsigned>(next++);
        glShaderStorageBlockBinding(
            program, glGetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, block.name.c_str()),
            block.index);
    }
    taken.clear();
    for (Sampler& sampler : samplers_) {
        if (!sampler.is_numbered) continue;
        GLint unit = 0;
        glGetUniformiv(program, glGetUniformLocation(program, sampler.name.c_str()), &unit);
        sampler.unit = static_cast<unsigned>(unit);
        taken.insert(unit);
    }
    next = 0;
    for (Sampler& sampler : samplers_) {
        if (sampler.is_numbered) continue;
        while (taken.contains(next)) ++next;
        sampler.unit = static_cast<unsigned>(next++);
        glProgramUniform1i(program, glGetUniformLocation(program, sampler.name.c_str()),
                           static_cast<GLint>(sampler.unit));
    }
#ifndef NDEBUG
    source_ = std::move(source);
#endif
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
        if (!block.is_numbered && id_of(block.buffer) == 0) return "storage block " + block.name;
    }
    for (const Sampler& sampler : samplers_) {
        if (!sampler.is_numbered && sampler.id() == 0) return "sampler " + sampler.name;
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
