#include "gl/program.h"

#include <epoxy/gl.h>

#include <cassert>
#include <glm/gtc/type_ptr.hpp>

#include "gelatin/error.h"
#include "gl/debug.h"
#include "gl/hazards.h"
#include "gl/shader_source.h"

namespace gelatin::gl {
namespace {

// What OpenGL promises for each dimension; more fails without a word on some drivers.
constexpr std::size_t kMaxGroups = 65'535;

// Owns a shader object until its program is linked.
class Shader {
public:
    Shader(GLenum stage, const std::string& file, const Defines& defines)
        : file_(file), source_(load_shader(file, defines)), id_(glCreateShader(stage)) {
        dump_shader(file_, source_);
        const char* text = source_.text.c_str();
        glShaderSource(id_, 1, &text, nullptr);
        glCompileShader(id_);
        GLint compiled = GL_FALSE;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled) return;
        const std::string message = file_ + " does not compile:\n" + source_.translate_log(log());
        glDeleteShader(id_);
        throw GlError(message);
    }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(id_); }

    GLuint id() const { return id_; }
    const ShaderSource& source() const { return source_; }

private:
    std::string log() const {
        GLint length = 0;
        glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
        std::string text(static_cast<std::size_t>(length) + 1, '\0');
        glGetShaderInfoLog(id_, length + 1, &length, text.data());
        text.resize(static_cast<std::size_t>(length));
        return text;
    }

    std::string file_;
    ShaderSource source_;
    GLuint id_;
};

std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(length) + 1, '\0');
    glGetProgramInfoLog(program, length + 1, &length, text.data());
    text.resize(static_cast<std::size_t>(length));
    return text;
}

void note_link(GLuint program, std::initializer_list<const Shader*> shaders, const std::string& name) {
    std::vector<const ShaderSource*> sources;
    for (const Shader* shader : shaders) sources.push_back(&shader->source());
    hazard_probe->linked(program, name, sources);
}

GLuint link(std::initializer_list<const Shader*> shaders, const std::string& name) {
    const GLuint program = glCreateProgram();
    for (const Shader* shader : shaders) glAttachShader(program, shader->id());
    glLinkProgram(program);
    for (const Shader* shader : shaders) glDetachShader(program, shader->id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) {
        if (hazard_probe != nullptr) note_link(program, shaders, name);
        return program;
    }
    const std::string message = name + " does not link:\n" + program_log(program);
    glDeleteProgram(program);
    throw GlError(message);
}

[[maybe_unused]] std::uint32_t group_size_of(GLuint program) {
    GLint size[3] = {};
    glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, size);
    return static_cast<std::uint32_t>(size[0] * size[1] * size[2]);
}

}  // namespace

Program Program::compute(const std::string& file, const Defines& defines) {
    const Shader shader(GL_COMPUTE_SHADER, file, defines);
    Program program;
    program.id_ = link({&shader}, file);
    return program;
}

Program Program::graphics(const std::string& vertex_file, const std::string& fragment_file,
                          const Defines& defines) {
    const Shader vertex(GL_VERTEX_SHADER, vertex_file, defines);
    const Shader fragment(GL_FRAGMENT_SHADER, fragment_file, defines);
    Program program;
    program.id_ = link({&vertex, &fragment}, vertex_file + " with " + fragment_file);
    return program;
}

Program Program::graphics_with_geometry(const std::string& vertex_file, const std::string& geometry_file,
                                        const std::string& fragment_file, const Defines& defines) {
    const Shader vertex(GL_VERTEX_SHADER, vertex_file, defines);
    const Shader geometry(GL_GEOMETRY_SHADER, geometry_file, defines);
    const Shader fragment(GL_FRAGMENT_SHADER, fragment_file, defines);
    Program program;
    program.id_ =
        link({&vertex, &geometry, &fragment}, vertex_file + ", " + geometry_file + " and " + fragment_file);
    return program;
}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(id_, other.id_);
    Program old(std::move(other));  // frees what this one held now, not when `other` ends
    return *this;
}

Program::~Program() {
    if (id_ != 0) glDeleteProgram(id_);
}

void Program::use() const {
    glUseProgram(id_);
}

void Program::set(const char* name, float value) const {
    glProgramUniform1f(id_, glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, int value) const {
    glProgramUniform1i(id_, glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, std::uint32_t value) const {
    glProgramUniform1ui(id_, glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, const glm::ivec2& value) const {
    glProgramUniform2iv(id_, glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec2& value) const {
    glProgramUniform2fv(id_, glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec3& value) const {
    glProgramUniform3fv(id_, glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::vec4& value) const {
    glProgramUniform4fv(id_, glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::uvec4& value) const {
    glProgramUniform4uiv(id_, glGetUniformLocation(id_, name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id_, glGetUniformLocation(id_, name), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::dispatch(std::size_t invocations, std::uint32_t group_size) const {
    if (invocations == 0) return;
    assert(group_size == group_size_of(id_));
    const std::size_t groups = (invocations + group_size - 1) / group_size;
    const std::size_t rows = (groups + kMaxGroups - 1) / kMaxGroups;
    if (rows > kMaxGroups) {
        throw GlError("a dispatch of " + std::to_string(groups) +
                      " work groups is more than OpenGL's limit of " + std::to_string(kMaxGroups) +
                      " in each of two dimensions");
    }
    // Rows of equal length leave fewer groups over than full rows and a rest.
    const std::size_t columns = (groups + rows - 1) / rows;
    glUseProgram(id_);
    if (hazard_probe != nullptr) hazard_probe->dispatches(id_);
    glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>(rows), 1);
    check_errors("glDispatchCompute");
}

void Program::dispatch_indirect(unsigned arguments, std::size_t offset) const {
    glUseProgram(id_);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments);
    if (hazard_probe != nullptr) hazard_probe->dispatches_indirectly(id_, arguments);
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
    check_errors("glDispatchComputeIndirect");
}

void finish() {
    glFinish();
}

}  // namespace gelatin::gl
