#include "gl/program.h"

#include <epoxy/gl.h>

#include <atomic>
#include <bit>
#include <bitset>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>
#include <utility>

#include "gelatin/error.h"
#include "gl/debug.h"
#include "gl/dispatch_counter.h"
#include "gl/group_grid.h"
#include "gl/hazards.h"
#include "gl/program_interface.h"
#include "gl/shader_source.h"

namespace gelatin::gl {
namespace {

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
    const std::string& text() const { return source_.text; }

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

// The serial number of the program that is in use on this thread with all that is bound to it; 0: unknown.
thread_local std::uint64_t applied_program = 0;

thread_local std::bitset<32> units_with_samplers;

std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
}

GLenum mode_of(Primitive primitive) {
    switch (primitive) {
        case Primitive::points:
            return GL_POINTS;
        case Primitive::triangles:
            return GL_TRIANGLES;
        case Primitive::triangle_strip:
            break;
    }
    return GL_TRIANGLE_STRIP;
}

void apply(const ProgramInterface::Block& block) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, block.index, id_of(block.buffer));
}

void apply(const ProgramInterface::Sampler& sampler) {
    glActiveTexture(GL_TEXTURE0 + sampler.unit);
    glBindTexture(sampler.target, sampler.id());
    // A buffer texture ignores samplers, but drivers warn of one for shadows that is left on its unit.
    if (sampler.target == GL_TEXTURE_BUFFER && !units_with_samplers[sampler.unit]) return;
    glBindSampler(sampler.unit, sampler.sampler_id);
    units_with_samplers[sampler.unit] = sampler.sampler_id != 0;
}

// Feeds a program's vertex inputs while it lives, from the vertex array object that is bound.
class VertexInputs {
public:
    explicit VertexInputs(const std::vector<ProgramInterface::Input>& inputs) : inputs_(inputs) {
        if (inputs_.empty()) return;
        for (const ProgramInterface::Input& input : inputs_) {
            glBindBuffer(GL_ARRAY_BUFFER, id_of(input.buffer));
            glVertexAttribPointer(input.location, 4, input.is_color ? GL_UNSIGNED_BYTE : GL_FLOAT,
                                  input.is_color ? GL_TRUE : GL_FALSE, 0, nullptr);
            glEnableVertexAttribArray(input.location);
        }
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }
    VertexInputs(const VertexInputs&) = delete;
    VertexInputs& operator=(const VertexInputs&) = delete;
    ~VertexInputs() {
        for (const ProgramInterface::Input& input : inputs_) glDisableVertexAttribArray(input.location);
    }

private:
    const std::vector<ProgramInterface::Input>& inputs_;
};

GLuint link(std::initializer_list<const Shader*> shaders, const std::string& name) {
    const GLuint program = glCreateProgram();
    for (const Shader* shader : shaders) glAttachShader(program, shader->id());
    glLinkProgram(program);
    for (const Shader* shader : shaders) glDetachShader(program, shader->id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return program;
    const std::string message = name + " does not link:\n" + program_log(program);
    glDeleteProgram(program);
    throw GlError(message);
}

std::size_t group_size_of(GLuint compute_program) {
    GLint size[3] = {};
    glGetProgramiv(compute_program, GL_COMPUTE_WORK_GROUP_SIZE, size);
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
}
}  // namespace

void forget_state() {
    applied_program = 0;
}

struct Program::State {
    State(std::initializer_list<const Shader*> shaders, std::string files)
        : name(std::move(files)), id(link(shaders, name)) {
        std::string source;
        for (const Shader* shader : shaders) source += shader->text();
        if (hazard_probe != nullptr) hazard_probe->linked(id, name, source);
        try {
            interface = ProgramInterface(id, std::move(source));
        } catch (const GlError& error) {
            glDeleteProgram(id);
            throw GlError(name + ": " + error.what());
        }
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        glDeleteProgram(id);
        if (is_applied()) forget_state();
    }

    bool is_applied() const { return applied_program == serial; }

    std::string name;  // of its files
    GLuint id;
    std::uint64_t serial = next_serial();
    ProgramInterface interface;
    std::size_t group_size = 0;  // invocations of a work group; 0 for programs that draw
};

Program::Program() = default;
Program::Program(Program&& other) noexcept = default;
Program& Program::operator=(Program&& other) noexcept = default;
Program::~Program() = default;

Program Program::compute(const std::string& file, const Defines& defines) {
    const Shader shader(GL_COMPUTE_SHADER, file, defines);
    Program program;
    program.state_ = std::make_unique<State>(std::initializer_list<const Shader*>{&shader}, file);
    program.state_->group_size = group_size_of(program.id());
    return program;
}

Program Program::graphics(const std::string& vertex_file, const std::string& fragment_file,
                          const Defines& defines) {
    const Shader vertex(GL_VERTEX_SHADER, vertex_file, defines);
    const Shader fragment(GL_FRAGMENT_SHADER, fragment_file, defines);
    Program program;
    program.state_ = std::make_unique<State>(std::initializer_list<const Shader*>{&vertex, &fragment},
                                             vertex_file + " with " + fragment_file);
    return program;
}

Program Program::graphics_with_geometry(const std::string& vertex_file, const std::string& geometry_file,
                                        const std::string& fragment_file, const Defines& defines) {
    const Shader vertex(GL_VERTEX_SHADER, vertex_file, defines);
    const Shader geometry(GL_GEOMETRY_SHADER, geometry_file, defines);
    const Shader fragment(GL_FRAGMENT_SHADER, fragment_file, defines);
    Program program;
    program.state_ =
        std::make_unique<State>(std::initializer_list<const Shader*>{&vertex, &geometry, &fragment},
                                vertex_file + ", " + geometry_file + " and " + fragment_file);
    return program;
}

unsigned Program::id() const {
    return state_ == nullptr ? 0 : state_->id;
}

void Program::use() const {
    assert(state_ != nullptr);
    if (state_->is_applied()) return;
    forget_state();
    if (const std::string what = state_->interface.unbound(); !what.empty())
        throw GlError(state_->name + ": nothing is bound to " + what);
    glUseProgram(state_->id);
    for (const ProgramInterface::Block& block : state_->interface.blocks()) apply(block);
    for (const ProgramInterface::Sampler& sampler : state_->interface.samplers()) apply(sampler);
    applied_program = state_->serial;
}

bool Program::declares(std::string_view name) const {
    return state_->interface.declares(name);
}

void Program::check_declared([[maybe_unused]] std::string_view name) const {
    assert(declares(name));
}

void Program::bind_block(std::string_view name, const ObjectName& buffer) const {
    ProgramInterface::Block* block = state_->interface.find_block(name);
    if (block == nullptr) return check_declared(name);
    if (block->buffer == buffer) return;
    block->buffer = buffer;
    if (id_of(buffer) == 0) {
        forget_state();
    } else if (state_->is_applied()) {
        apply(*block);
    }
}

void Program::bind_texels(std::string_view name, const ObjectName& texture) const {
    ProgramInterface::Sampler* sampler = state_->interface.find_sampler(name);
    if (sampler == nullptr) return check_declared(name);
    assert(sampler->target == GL_TEXTURE_BUFFER);
    if (sampler->texture == texture) return;
    sampler->texture = texture;
    if (id_of(texture) == 0) {
        forget_state();
    } else if (state_->is_applied()) {
        apply(*sampler);
    }
}

void Program::bind_texture(std::string_view name, unsigned texture, unsigned sampler_id) const {
    ProgramInterface::Sampler* sampler = state_->interface.find_sampler(name);
    if (sampler == nullptr) return check_declared(name);
    sampler->texture = nullptr;
    sampler->texture_id = texture;
    sampler->sampler_id = sampler_id;
    if (state_->is_applied()) forget_state();
}

void Program::bind_vertices(std::string_view name, const ObjectName& buffer, bool is_color) const {
    ProgramInterface::Input* input = state_->interface.find_input(name);
    if (input == nullptr) return check_declared(name);
    input->buffer = buffer;
    input->is_color = is_color;
    if (state_->is_applied()) forget_state();
}

void Program::bind_input(std::string_view input, const Buffer<glm::vec4>& vertices) const {
    bind_vertices(input, vertices.name(), false);
}

void Program::bind_input(std::string_view input, const Buffer<std::uint32_t>& colors) const {
    bind_vertices(input, colors.name(), true);
}

int Program::location(std::string_view name) const {
    const ProgramInterface::Uniform* uniform = state_->interface.find_uniform(name);
    return uniform != nullptr ? uniform->location : -1;  // which OpenGL ignores
}

void Program::set(std::string_view uniform, float value) const {
    glProgramUniform1f(id(), location(uniform), value);
}
void Program::set(std::string_view uniform, int value) const {
    glProgramUniform1i(id(), location(uniform), value);
}
void Program::set(std::string_view uniform, std::uint32_t value) const {
    glProgramUniform1ui(id(), location(uniform), value);
}
void Program::set(std::string_view uniform, const glm::ivec2& value) const {
    glProgramUniform2iv(id(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec2& value) const {
    glProgramUniform2fv(id(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec3& value) const {
    glProgramUniform3fv(id(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec4& value) const {
    glProgramUniform4fv(id(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::uvec4& value) const {
    glProgramUniform4uiv(id(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::dispatch(std::size_t invocations) const {
    const std::size_t group_size = state_->group_size;
    dispatch_groups((invocations + group_size - 1) / group_size);
}

void Program::dispatch_groups(std::size_t groups) const {
    if (groups == 0) return;
    const GroupGrid grid(groups);
    if (grid.rows > kMostGroups) {
        throw GlError("a dispatch of " + std::to_string(groups) +
                      " work groups is more than OpenGL's limit of " + std::to_string(kMostGroups) +
                      " in each of two dimensions");
    }
    use();
    if (hazard_probe != nullptr) hazard_probe->dispatches(id());
    if (dispatch_counter != nullptr) dispatch_counter->count(state_->name);
    glDispatchCompute(static_cast<GLuint>(grid.columns), static_cast<GLuint>(grid.rows), 1);
    check_errors("glDispatchCompute");
}

void Program::dispatch_indirect(unsigned arguments, std::size_t offset) const {
    use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments);
    if (hazard_probe != nullptr) hazard_probe->dispatches_indirectly(id(), arguments);
    if (dispatch_counter != nullptr) dispatch_counter->count_indirect(state_->name, arguments, offset);
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
    check_errors("glDispatchComputeIndirect");
}

void Program::draw_arrays(Primitive primitive, std::size_t count) const {
    if (count == 0) return;
    use();
    const VertexInputs inputs(state_->interface.inputs());
    if (hazard_probe != nullptr) hazard_probe->draws(false);
    glDrawArrays(mode_of(primitive), 0, static_cast<GLsizei>(count));
}

void Program::draw_elements(Primitive primitive, unsigned indices, std::size_t count,
                            std::size_t first) const {
    if (count == 0) return;
    use();
    const VertexInputs inputs(state_->interface.inputs());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    if (hazard_probe != nullptr) hazard_probe->draws(true);
    glDrawElements(mode_of(primitive), static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                   std::bit_cast<const void*>(first * sizeof(GLuint)));
}

void Program::draw_arrays_indirect(Primitive primitive, unsigned arguments, std::size_t offset) const {
    use();
    const VertexInputs inputs(state_->interface.inputs());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, arguments);
    if (hazard_probe != nullptr) hazard_probe->draws(false, arguments);
    glDrawArraysIndirect(mode_of(primitive), std::bit_cast<const void*>(offset));
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void release_samplers() {
    for (unsigned unit = 0; unit < units_with_samplers.size(); ++unit)
        if (units_with_samplers[unit]) glBindSampler(unit, 0);
    units_with_samplers.reset();
    forget_state();
}

void finish() {
    glFinish();
}

}  // namespace gelatin::gl
