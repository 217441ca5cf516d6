// A window of one's own, in whose OpenGL context Gelatin simulates; drawn from the simulation's buffers by a
// shader of one's own. embed [FRAMES [FILE.png]]: without FRAMES, until the window is closed.
#include <epoxy/gl.h>

#include <GLFW/glfw3.h>

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "gelatin/error.h"
#include "gelatin/picture.h"
#include "gelatin/scene.h"
#include "gelatin/simulator.h"

namespace {

constexpr int kWidth = 640, kHeight = 480;

// gelatin/views.h says what the buffers hold.
constexpr const char* kVertexShader = R"(#version 430
struct SurfaceVertex { uint node, object, first_face, face_count; };
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Vertices { SurfaceVertex vertices[]; };
layout(std430, binding = 2) readonly buffer Normals { vec4 normals[]; };
uniform mat4 camera;
out vec3 normal;
void main() {
    normal = normals[gl_VertexID].xyz;
    gl_Position = camera * vec4(positions[vertices[gl_VertexID].node].xyz, 1.0);
})";
constexpr const char* kFragmentShader = R"(#version 430
in vec3 normal;
out vec4 color;
void main() { color = vec4((0.35 + 0.65 * max(normalize(normal).y, 0.0)) * vec3(1.0, 0.5, 0.2), 1.0); })";

void attach_shader(GLuint program, GLenum kind, const char* text) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
}

void draw(const gelatin::RenderView& view, GLuint program, GLuint vertex_array) {
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.1f, 0.12f, 0.15f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(program);
    const glm::mat4 camera =
        glm::perspective(0.7f, static_cast<float>(kWidth) / kHeight, 0.1f, 100.0f) *
        glm::lookAt(glm::vec3(2.0f, 2.0f, 4.0f), glm::vec3(0.0f, 0.6f, 0.0f), glm::vec3(0, 1, 0));
    glUniformMatrix4fv(glGetUniformLocation(program, "camera"), 1, GL_FALSE, glm::value_ptr(camera));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, view.node_positions);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, view.surface_vertices);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, view.vertex_normals);
    glBindVertexArray(vertex_array);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, view.triangles);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * view.face_count), GL_UNSIGNED_INT, nullptr);
}

gelatin::Picture read_window() {
    gelatin::Picture picture{kWidth, kHeight, std::vector<std::uint8_t>(3 * kWidth * kHeight)};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (int row = 0; row < kHeight; ++row)  // OpenGL's begin at the bottom
        glReadPixels(0, kHeight - 1 - row, kWidth, 1, GL_RGB, GL_UNSIGNED_BYTE,
                     &picture.pixels[static_cast<std::size_t>(3 * kWidth * row)]);
    return picture;
}

gelatin::Scene make_scene() {
    gelatin::Scene scene;
    gelatin::Material& jelly = scene.materials.emplace_back();
    jelly.name = "jelly";
    jelly.youngs_modulus = 1e5;  // [Pa]
    jelly.damping = 0.01;        // [s]
    gelatin::ObjectDescription ball;
    ball.name = "ball";
    ball.shape = gelatin::SphereShape{};
    ball.material = "jelly";
    ball.position = {0.0, 1.5, 0.0};
    scene.objects.push_back(ball);
    scene.colliders.emplace_back().shape = gelatin::PlaneCollider{};
    return scene;
}

void run(GLFWwindow* window, int frames, const char* picture) {
    gelatin::SimulatorOptions options;
    options.use_current_context = true;
    gelatin::Simulator simulator(make_scene(), options);
    std::printf("simulating on %s\n", simulator.device().c_str());
    const GLuint program = glCreateProgram();
    attach_shader(program, GL_VERTEX_SHADER, kVertexShader);
    attach_shader(program, GL_FRAGMENT_SHADER, kFragmentShader);
    glLinkProgram(program);
    GLuint vertex_array = 0;
    glGenVertexArrays(1, &vertex_array);
    while (!glfwWindowShouldClose(window) && (frames == 0 || simulator.frame() < frames)) {
        simulator.advance_frame();
        draw(simulator.render_view(), program, vertex_array);
        if (picture != nullptr && simulator.frame() == frames) gelatin::save_picture(picture, read_window());
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
}  // the simulator's buffers are deleted while its context is current

}  // namespace

int main(int argc, char** argv) {
    if (!glfwInit()) return 1;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
    GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, "jelly", nullptr, nullptr);
    if (window == nullptr) return 1;
    glfwMakeContextCurrent(window);
    try {
        run(window, argc > 1 ? std::atoi(argv[1]) : 0, argc > 2 ? argv[2] : nullptr);
    } catch (const gelatin::Error& error) {
        std::fprintf(stderr, "embed: %s\n", error.what());
        return 1;
    }
    glfwTerminate();
}
