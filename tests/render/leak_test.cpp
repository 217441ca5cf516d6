#include <epoxy/gl.h>

#include "render/renderer_fixture.h"

namespace gelatin::render {
namespace {

using IsObject = GLboolean (*)(GLuint);

// Objects of OpenGL that are alive. Drivers give names out from 1 and take the lowest that are free, or
// nearly so.
int living(IsObject is_object) {
    constexpr GLuint kNames = 4'000;
    int count = 0;
    for (GLuint name = 1; name < kNames; ++name) count += is_object(name) == GL_TRUE;
    return count;
}

struct Living {
    int textures, buffers, framebuffers, renderbuffers, programs, shaders, samplers, vertex_arrays;
    bool operator==(const Living&) const = default;
    static Living now() {
        glUseProgram(0);
        return {living([](GLuint n) { return glIsTexture(n); }),
                living([](GLuint n) { return glIsBuffer(n); }),
                living([](GLuint n) { return glIsFramebuffer(n); }),
                living([](GLuint n) { return glIsRenderbuffer(n); }),
                living([](GLuint n) { return glIsProgram(n); }),
                living([](GLuint n) { return glIsShader(n); }),
                living([](GLuint n) { return glIsSampler(n); }),
                living([](GLuint n) { return glIsVertexArray(n); })};
    }
};

std::ostream& operator<<(std::ostream& out, const Living& l) {
    return out << l.textures << " textures, " << l.buffers << " buffers, " << l.framebuffers
               << " framebuffers, " << l.renderbuffers << " renderbuffers, " << l.programs << " programs, "
               << l.shaders << " shaders, " << l.samplers << " samplers, " << l.vertex_arrays
               << " vertex arrays";
}

class LeakTest : public RendererTest {
protected:
    // Renderers of every kind, drawn with and resized.
    static void use(const Studio& studio) {
        const StaticMesh bodies(studio.bodies);
        Renderer renderer(studio.options);
        renderer.set_surroundings(studio.surroundings);
        renderer.draw(bodies.view(), studio.camera);
        for (const auto& [width, height] : {std::pair(40, 30), std::pair(200, 90)}) {
            renderer.resize(width, height);
            renderer.draw(bodies.view(), studio.camera);
        }
    }
};

TEST_F(LeakTest, NothingOfARendererIsLeft) {
    Studio studio;
    studio.surroundings.props = {make_box({glm::dvec3(0.4), glm::ivec3(1)})};
    for (const Quality quality : {Quality::high, Quality::fast}) {
        for (const Smoothing smoothing : {Smoothing::samples, Smoothing::filter, Smoothing::none}) {
            if (quality == Quality::fast && smoothing != Smoothing::none) continue;
            studio.options.quality = quality;
            studio.options.smoothing = smoothing;
            use(studio);  // drivers keep the program that drew last
            const Living before = Living::now();
            use(studio);
            EXPECT_EQ(Living::now(), before);
        }
    }
    const Living before = Living::now();
    Renderer alive(studio.options);
    EXPECT_GT(Living::now().programs, before.programs) << "or nothing was counted";
}

}  // namespace
}  // namespace gelatin::render
