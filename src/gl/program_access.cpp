#include "gl/program_access.h"

#include <epoxy/gl.h>

#include <map>

#include "gl/block_access.h"
#include "gl/get_integer.h"

namespace gelatin::gl {
namespace {

// "Lights[0]" is an element of an array of blocks.
std::string without_index(const std::string& name) {
    return name.substr(0, name.find('['));
}

template <class Use>
void for_each_block(GLuint program, const Use& use) {
    GLint count = 0, longest = 0;
    glGetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    glGetProgramInterfaceiv(program, GL_SHADER_STORAGE_BLOCK, GL_MAX_NAME_LENGTH, &longest);
    std::string name(static_cast<std::size_t>(longest) + 1, '\0');
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        GLsizei length = 0;
        glGetProgramResourceName(program, GL_SHADER_STORAGE_BLOCK, i, longest + 1, &length, name.data());
        use(i, name.substr(0, static_cast<std::size_t>(length)));
    }
}

bool is_buffer_sampler(GLint type) {
    return type == GL_SAMPLER_BUFFER || type == GL_INT_SAMPLER_BUFFER ||
           type == GL_UNSIGNED_INT_SAMPLER_BUFFER;
}

template <class Use>
void for_each_buffer_sampler(GLuint program, const Use& use) {
    GLint count = 0, longest = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_MAX_NAME_LENGTH, &longest);
    std::string name(static_cast<std::size_t>(longest) + 1, '\0');
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        constexpr GLenum kWanted[] = {GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE};
        GLint values[3] = {};
        glGetProgramResourceiv(program, GL_UNIFORM, i, 3, kWanted, 3, nullptr, values);
        if (!is_buffer_sampler(values[0]) || values[1] < 0) continue;
        GLsizei length = 0;
        glGetProgramResourceName(program, GL_UNIFORM, i, longest + 1, &length, name.data());
        for (GLint element = 0; element < values[2]; ++element)
            use(name.substr(0, static_cast<std::size_t>(length)), values[1] + element);
    }
}

unsigned buffer_of_block(GLuint program, GLuint block) {
    constexpr GLenum kBinding = GL_BUFFER_BINDING;
    GLint binding = 0, buffer = 0;
    glGetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, block, 1, &kBinding, 1, nullptr, &binding);
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, static_cast<GLuint>(binding), &buffer);
    return static_cast<unsigned>(buffer);
}

// With the texture unit of the sampler active.
unsigned buffer_of_texture() {
    if (get_integer(GL_TEXTURE_BINDING_BUFFER) == 0) return 0;
    GLint buffer = 0;
    glGetTexLevelParameteriv(GL_TEXTURE_BUFFER, 0, GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
    return static_cast<unsigned>(buffer);
}

}  // namespace

ProgramAccess reflect_accesses(unsigned program, const std::string& name, const std::string& source) {
    ProgramAccess access;
    access.name = name;
    const std::map<std::string, BlockAccess> declared = block_accesses(source);
    for_each_block(program, [&](GLuint index, const std::string& block) {
        const auto found = declared.find(without_index(block));
        const BlockAccess modes = found == declared.end() ? BlockAccess() : found->second;
        access.blocks.push_back({block, modes.reads, modes.writes, index});
    });
    for_each_buffer_sampler(program, [&](const std::string& sampler, GLint location) {
        access.texels.push_back({sampler, location});
    });
    return access;
}

std::vector<BoundBuffer> bound_buffers(unsigned program, const ProgramAccess& access) {
    std::vector<BoundBuffer> bound;
    for (const ProgramAccess::Block& block : access.blocks) {
        const unsigned buffer = buffer_of_block(program, block.index);
        if (buffer != 0)
            bound.push_back({buffer, Barrier::storage, block.reads, block.writes, "block " + block.name});
    }
    if (access.texels.empty()) return bound;
    const GLint active_unit = get_integer(GL_ACTIVE_TEXTURE);
    for (const ProgramAccess::Texels& texels : access.texels) {
        GLint unit = 0;
        glGetUniformiv(program, texels.location, &unit);
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        const unsigned buffer = buffer_of_texture();
        if (buffer != 0)
            bound.push_back({buffer, Barrier::texture_fetch, true, false, "samplerBuffer " + texels.name});
    }
    glActiveTexture(static_cast<GLenum>(active_unit));
    return bound;
}

std::vector<BoundBuffer> bound_vertex_buffers(bool has_elements) {
    std::vector<BoundBuffer> bound;
    const GLint count = get_integer(GL_MAX_VERTEX_ATTRIBS);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        GLint enabled = 0, buffer = 0;
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &buffer);
        if (enabled != 0 && buffer != 0)
            bound.push_back({static_cast<unsigned>(buffer), Barrier::vertex_pull, true, false,
                             "vertex attribute " + std::to_string(i)});
    }
    const GLint elements = has_elements ? get_integer(GL_ELEMENT_ARRAY_BUFFER_BINDING) : 0;
    if (elements != 0)
        bound.push_back({static_cast<unsigned>(elements), Barrier::vertex_pull, true, false, "indices"});
    return bound;
}

}  // namespace gelatin::gl
