#include "sim/overlay_source.h"

#include <gtest/gtest.h>

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "gelatin/simulator.h"
#include "sim/simulator_internals.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

// Balls so near one another that they touch after a few frames.
Scene balls(int count) {
    Scene scene;
    scene.simulation.frame_rate = 500.0;
    scene.simulation.gravity = {0.0, 0.0, 0.0};
    scene.collision.response = CollisionResponse::restore;
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
    EXPECT_FALSE(view.color_map || view.cut || view.arrows || view.contact_forces || view.objects ||
                 view.wireframe);
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
                const Range nodes = model_of(simulator).objects[o].nodes;
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
    // 320 faces a ball are parts of 256 and 64, and these of four parts each (model/collision/box_tree.h).
    EXPECT_EQ(counts, (std::vector<std::size_t>{2, 4, 16}));
}

TEST_P(OverlaySourceTest, ALevelOfBoxesMayStandAlone) {
    Simulator simulator = simulate(balls(2));
    const auto shown_of = [&](const Overlays& overlays) {
        const OverlayView view = simulator.render_view(overlays).overlay;
        return download<glm::uvec2>(view.shown_boxes, view.shown_box_count);
    };
    const auto all = shown_of({.box_levels = 2});
    std::vector<std::uint32_t> lowest;
    for (const glm::uvec2& shown : all)
        if (shown.y == 2) lowest.push_back(shown.x);
    std::vector<std::uint32_t> alone;
    for (const glm::uvec2& shown : shown_of({.box_levels = 2, .lowest_boxes_alone = true})) {
        EXPECT_EQ(shown.y, 0u) << "the first that is shown does not fade";
        alone.push_back(shown.x);
    }
    EXPECT_EQ(alone, lowest);
    EXPECT_EQ(shown_of({.box_levels = 2}).size(), all.size());
}

// A body that starts stretched, of springs or neo-Hookean, has the stress of that at each tet and node.
TEST_P(OverlaySourceTest, ColorsShowTheStressOfABodyOutOfShape) {
    for (const MaterialModel model : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        Scene scene = balls(1);
        scene.materials[0].model = model;
        scene.materials[0].youngs_modulus = 1e5;
        scene.materials[0].poisson_ratio = 0.25;
        scene.objects[0].start.scale = {1.05, 1.0, 1.0};
        Simulator simulator = simulate(scene);
        for (const auto& [quantity, right, end] : {std::tuple(Quantity::stress, 1e5 / 1.25 * 0.05, 5e3),
                                                   std::tuple(Quantity::stretch, 1.05, 1.07)}) {
            const OverlayView view = simulator.render_view({.color_map = ColorMap{quantity, {}}}).overlay;
            ASSERT_TRUE(view.color_map);
            EXPECT_EQ(view.color_map->quantity, quantity);
            EXPECT_NEAR(view.color_map->full, end, 1e-5 * end);
            for (const float v : download<float>(view.color_map->tet_values, simulator.counts().tets))
                EXPECT_NEAR(v, right, 1e-3 * right);
            for (const float v : download<float>(view.color_map->node_values, simulator.counts().nodes))
                EXPECT_NEAR(v, right, 1e-3 * right);
        }
        const Overlays set{.color_map = ColorMap{Quantity::stress, 1234.0f}};
        EXPECT_EQ(simulator.render_view(set).overlay.color_map->full, 1234.0f);
    }
}

TEST_P(OverlaySourceTest, SpeedsAndArrowsAreTheNodes) {
    Simulator simulator = simulate(balls(2));
    simulator.advance_frame();
    const OverlayView view =
        simulator.render_view({.color_map = ColorMap{Quantity::speed, {}}, .arrow_time = 0.2f}).overlay;
    const HostFrame frame = simulator.read_frame();
    const auto values = download<float>(view.color_map->node_values, simulator.counts().nodes);
    ASSERT_TRUE(view.arrows);
    EXPECT_EQ(view.arrows->scale, 0.2f);
    const auto velocities = download<glm::vec4>(view.arrows->vectors, simulator.counts().nodes);
    for (std::size_t n = 0; n < values.size(); ++n) {
        const glm::vec3 v(frame.velocities[3 * n], frame.velocities[3 * n + 1], frame.velocities[3 * n + 2]);
        EXPECT_NEAR(values[n], glm::length(v), 1e-6f);
        EXPECT_EQ(glm::vec3(velocities[n]), v);
    }
    const auto nodes = download<std::uint32_t>(view.arrows->nodes, view.arrows->count);
    EXPECT_GT(nodes.size(), 50u);
    for (const std::uint32_t node : nodes) EXPECT_LT(node, values.size());
}

// A block that lies on a floor: arrows at the nodes below, and pressures that add up to its weight.
TEST_P(OverlaySourceTest, ContactForcesAreThoseOfTheFrame) {
    Scene scene = balls(1);
    scene.simulation.frame_rate = 60.0;
    scene.simulation.gravity = {0.0, -9.81, 0.0};
    scene.objects[0].shape = BoxShape{glm::dvec3(0.4), glm::ivec3(3)};
    scene.objects[0].position = {0.0, 0.2, 0.0};
    scene.objects[0].velocity = {0.0, 0.0, 0.0};
    scene.colliders.push_back({});
    scene.collision.response =
        GetParam() == Backend::cpu ? CollisionResponse::contact : CollisionResponse::restore;
    Simulator simulator = simulate(scene);
    for (int f = 0; f < 120; ++f) simulator.advance_frame();
    const Overlays both{.color_map = ColorMap{Quantity::pressure, {}}, .contact_forces = ForceArrows{0.01f}};
    const OverlayView view = simulator.render_view(both).overlay;
    ASSERT_TRUE(view.color_map);
    EXPECT_EQ(view.color_map->quantity, Quantity::pressure);
    const auto pressures = download<float>(view.color_map->node_values, simulator.counts().nodes);
    if (GetParam() == Backend::gl) {  // it does not find them
        EXPECT_FALSE(view.contact_forces);
        for (const float pressure : pressures) EXPECT_EQ(pressure, 0.0f);
        return;
    }
    ASSERT_TRUE(view.contact_forces);
    EXPECT_EQ(view.contact_forces->scale, 0.01f);
    const HostFrame frame = simulator.read_frame();
    const auto forces = download<glm::vec4>(view.contact_forces->vectors, simulator.counts().nodes);
    const auto nodes = download<std::uint32_t>(view.contact_forces->nodes, view.contact_forces->count);
    EXPECT_GT(nodes.size(), 10u);
    const Model& model = model_of(simulator);
    std::vector<glm::vec4> positions;
    for (std::size_t n = 0; n < forces.size(); ++n)
        positions.emplace_back(frame.positions[3 * n], frame.positions[3 * n + 1], frame.positions[3 * n + 2],
                               1.0f);
    const std::vector<float> areas = surface_areas(model, positions);
    glm::dvec3 shown(0.0);
    for (const std::uint32_t n : nodes) shown += glm::dvec3(forces[n]);
    double weight = 0.0, area = 0.0;
    for (std::size_t n = 0; n < forces.size(); ++n) {
        EXPECT_EQ(forces[n].y, frame.contact_forces[3 * n + 1]);
        weight += static_cast<double>(pressures[n] * areas[n]);
        area += static_cast<double>(areas[n]);
    }
    EXPECT_NEAR(shown.y, 64.0 * 9.81, 5.0);
    EXPECT_NEAR(weight, 64.0 * 9.81, 5.0);
    EXPECT_NEAR(area, 6 * 0.16, 0.05);
    EXPECT_GT(view.color_map->full, 3e3f);  // the mean is 4 kPa
    EXPECT_LT(view.color_map->full, 3e4f);
    // In a cut, tets beside the floor show theirs.
    const auto of_tets = download<float>(view.color_map->tet_values, simulator.counts().tets);
    for (std::size_t t = 0; t < of_tets.size(); ++t) {
        const glm::uvec4& tet = model.tets[t];
        const float sum = pressures[tet.x] + pressures[tet.y] + pressures[tet.z] + pressures[tet.w];
        EXPECT_FLOAT_EQ(of_tets[t], 0.25f * sum);
    }
    // The arrow of a usual force has half the block's length.
    const OverlayView adapted = simulator.render_view({.contact_forces = ForceArrows{}}).overlay;
    EXPECT_GT(adapted.contact_forces->scale * 64.0 * 9.81 / static_cast<double>(nodes.size()), 0.02);
    EXPECT_LT(adapted.contact_forces->scale * 64.0 * 9.81 / static_cast<double>(nodes.size()), 0.2);
}

TEST_P(OverlaySourceTest, ACutWithoutAnOffsetGoesThroughTheMiddle) {
    Simulator simulator = simulate(balls(2));
    simulator.advance_frame();
    const CutPlane free{.normal = {0.0f, 3.0f, 4.0f}};
    const RenderView view = simulator.render_view({.cut = free});
    ASSERT_TRUE(view.overlay.cut);
    const float* plane = view.overlay.cut->plane;
    EXPECT_NEAR(plane[0], 0.0f, 1e-6f);
    EXPECT_NEAR(plane[1], 0.6f, 1e-6f);
    EXPECT_NEAR(plane[2], 0.8f, 1e-6f);
    const glm::vec3 middle(0.305f, 0.05f, 0.0f);
    EXPECT_NEAR(0.6f * middle.y + 0.8f * middle.z + plane[3], 0.0f, 2e-3f);
    EXPECT_EQ(simulator.render_view({.cut = CutPlane{{0.0f, 0.0f, 2.0f}, 0.3f}}).overlay.cut->plane[3],
              -0.3f);

    const auto tets = download<glm::uvec4>(view.overlay.cut->tets, view.overlay.cut->tet_count);
    EXPECT_EQ(tets, model_of(simulator).tets);
    const auto objects = download<std::uint32_t>(view.overlay.cut->tet_objects, view.overlay.cut->tet_count);
    for (std::uint32_t o = 0; o < 2; ++o) {
        const Range range = model_of(simulator).objects[o].tets;
        for (std::uint32_t t = range.first; t < range.end(); ++t) EXPECT_EQ(objects[t], o);
    }
}

TEST_P(OverlaySourceTest, ObjectsAreNamedByTheirBoxes) {
    Simulator simulator = simulate(balls(3));
    const OverlayView view = simulator.render_view({.objects = true}).overlay;
    ASSERT_TRUE(view.objects);
    EXPECT_EQ(view.shown_boxes, 0u) << "which are not shown for that";
    ASSERT_EQ(view.objects->names.size(), 3u);
    EXPECT_EQ(view.objects->names[2], "ball 2");
    const auto boxes = download<Box>(view.boxes, view.box_count);
    const auto roots = download<std::uint32_t>(view.objects->roots, 3);
    for (std::size_t o = 0; o < 3; ++o)
        EXPECT_NEAR(0.5f * (boxes[roots[o]].min.x + boxes[roots[o]].max.x), 0.61f * static_cast<float>(o),
                    0.01f);
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
    EXPECT_EQ(marked(), 0u) << "nothing has been searched yet";
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
        EXPECT_EQ(springs[s].i, model_of(simulator).springs[s].i);
        EXPECT_EQ(springs[s].rest_length, model_of(simulator).springs[s].rest_length);
    }
}

// Looking changes nothing, not a bit.
TEST_P(OverlaySourceTest, LeavesTheSimulationAsItWas) {
    Simulator watched = simulate(balls(3)), alone = simulate(balls(3));
    for (int f = 0; f < 40; ++f) {
        watched.render_view({.box_levels = 1, .faces = true, .full_strain = 0.1f});
        watched.render_view(
            {.color_map = ColorMap{}, .cut = CutPlane{}, .arrow_time = 0.1f, .objects = true});
        watched.advance_frame();
        alone.advance_frame();
    }
    EXPECT_EQ(watched.read_frame().positions, alone.read_frame().positions);
}

}  // namespace
}  // namespace gelatin
