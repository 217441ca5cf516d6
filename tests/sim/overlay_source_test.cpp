#include "sim/overlay_source.h"

#include <gtest/gtest.h>

#include <epoxy/gl.h>
#include <glm/common.hpp>

#include "gelatin/simulator.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

// Balls so near one another that they touch after a few frames.
Scene balls(int count) {
    Scene scene;
    scene.simulation.frame_rate = 500.0;
    scene.simulation.gravity = {0.0, 0.0, 0.0};
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    for (int i = 0; i < count; ++i) {
        ObjectDescription ball;
        ball.name = "ball " + std::to_string(i);
        ball.shape = SphereShape{0.3, 4};
        ball.material = "jelly";
        ball.position = {0.61 * i, 0.1 * i, 0.0};
        ball.velocity = {-0.5 * i, 0.0, 0.0};
        scene.objects.push_back(ball);
    }
    return scene;
}

template <class T>
std::vector<T> download(unsigned buffer, std::size_t count) {
    std::vector<T> values(count);
    gl::barrier(gl::Barrier::buffer_update);
    glBindBuffer(GL_COPY_READ_BUFFER, buffer);
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(T)), values.data());
    return values;
}

class OverlaySourceTest : public test::GlTest, public ::testing::WithParamInterface<Backend> {
protected:
    static Simulator simulate(const Scene& scene, Backend backend = GetParam()) {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        return Simulator(scene, options);
    }
};
INSTANTIATE_TEST_SUITE_P(Backends, OverlaySourceTest, ::testing::Values(Backend::gl, Backend::cpu),
                         [](const auto& test) { return test.param == Backend::gl ? "Gl" : "Cpu"; });

TEST_P(OverlaySourceTest, GivesNothingThatIsNotAskedFor) {
    Simulator simulator = simulate(balls(2));
    const OverlayView view = simulator.render_view().overlay;
    EXPECT_EQ(view.boxes + view.shown_boxes + view.face_marks + view.springs, 0u);
}

// At the start, after steps, and of a body that has none to collide with.
TEST_P(OverlaySourceTest, BoxesHoldTheirBodiesExactly) {
    for (const int count : {1, 2}) {
        Simulator simulator = simulate(balls(count));
        for (const int frames : {0, 5}) {
            for (int f = 0; f < frames; ++f) simulator.advance_frame();
            const OverlayView view = simulator.render_view({.box_levels = 0}).overlay;
            ASSERT_EQ(view.shown_box_count, static_cast<std::uint32_t>(count));
            const auto boxes = download<Box>(view.boxes, view.box_count);
            const auto shown = download<glm::uvec2>(view.shown_boxes, view.shown_box_count);
            const HostFrame frame = simulator.read_frame();
            for (std::size_t o = 0; o < shown.size(); ++o) {
                const Range nodes = simulator.model().objects[o].nodes;
                glm::vec3 low(1e9f), high(-1e9f);
                for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
                    const glm::vec3 p(frame.positions[3 * n], frame.positions[3 * n + 1],
                                      frame.positions[3 * n + 2]);
                    low = glm::min(low, p);
                    high = glm::max(high, p);
                }
                EXPECT_EQ(glm::vec3(boxes[shown[o].x].min), low);
                EXPECT_EQ(glm::vec3(boxes[shown[o].x].max), high);
                EXPECT_EQ(shown[o].y, 0u);
            }
        }
    }
}

TEST_P(OverlaySourceTest, LevelsOfBoxesLieInOneAnother) {
    Simulator simulator = simulate(balls(2));
    const OverlayView view = simulator.render_view({.box_levels = 2}).overlay;
    const auto boxes = download<Box>(view.boxes, view.box_count);
    std::vector<std::size_t> counts(3);
    Box parents[3];
    for (const glm::uvec2& shown : download<glm::uvec2>(view.shown_boxes, view.shown_box_count)) {
        ASSERT_LT(shown.y, 3u);
        const Box& box = parents[shown.y] = boxes[shown.x];
        ++counts[shown.y];
        if (shown.y == 0) continue;
        EXPECT_EQ(glm::min(box.min, parents[shown.y - 1].min), parents[shown.y - 1].min);
        EXPECT_EQ(glm::max(box.max, parents[shown.y - 1].max), parents[shown.y - 1].max);
    }
    // 320 faces a ball are parts of 256 and 64, and these of four parts each (model/box_tree.h).
    EXPECT_EQ(counts, (std::vector<std::size_t>{2, 4, 16}));
}

TEST_P(OverlaySourceTest, MarksAsManyFacesAsCollide) {
    Simulator simulator = simulate(balls(2));
    const auto marked = [&] {
        const unsigned marks = simulator.render_view({.faces = true}).overlay.face_marks;
        std::size_t count = 0;
        for (const std::uint32_t mark : download<std::uint32_t>(marks, simulator.counts().faces))
            count += mark;
        return count;
    };
    EXPECT_EQ(marked(), 0u) << "nothing has been looked for yet";
    std::size_t most = 0;
    for (int f = 0; f < 40; ++f) {
        simulator.advance_frame();
        simulator.begin_statistics();
        const std::size_t colliding = simulator.take_statistics().colliding_faces;
        EXPECT_EQ(marked(), colliding);
        most = std::max(most, colliding);
    }
    EXPECT_GT(most, 4u) << "the balls never met";
}

TEST_P(OverlaySourceTest, OneBodyTouchesNothing) {
    Simulator simulator = simulate(balls(1));
    simulator.advance_frame();
    const OverlayView view = simulator.render_view({.box_levels = 0, .faces = true}).overlay;
    for (const std::uint32_t mark : download<std::uint32_t>(view.face_marks, simulator.counts().faces))
        EXPECT_EQ(mark, 0u);
}

TEST_P(OverlaySourceTest, SpringsAreTheModels) {
    Simulator simulator = simulate(balls(2));
    const OverlayView view = simulator.render_view({.full_strain = 0.25f}).overlay;
    EXPECT_EQ(view.full_strain, 0.25f);
    ASSERT_EQ(view.spring_count, simulator.counts().springs);
    const auto springs = download<Spring>(view.springs, view.spring_count);
    for (std::size_t s = 0; s < springs.size(); ++s) {
        EXPECT_EQ(springs[s].i, simulator.model().springs[s].i);
        EXPECT_EQ(springs[s].rest_length, simulator.model().springs[s].rest_length);
    }
}

// Looking changes nothing, not a bit.
TEST_P(OverlaySourceTest, LeavesTheSimulationAsItWas) {
    Simulator watched = simulate(balls(3)), alone = simulate(balls(3));
    for (int f = 0; f < 40; ++f) {
        watched.render_view({.box_levels = 1, .faces = true, .full_strain = 0.1f});
        watched.advance_frame();
        alone.advance_frame();
    }
    EXPECT_EQ(watched.read_frame().positions, alone.read_frame().positions);
}

}  // namespace
}  // namespace gelatin
