#include "sim/draw_source.h"

#include <gtest/gtest.h>

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

// A fine ball over a coarse lattice, which falls onto a floor, and a box, which has no skin.
Scene ball_and_box() {
    Scene scene = test::falling_balls();
    scene.objects[0].shape = SphereShape{0.3, 16};
    scene.objects[0].mesher.kind = MesherKind::lattice;
    scene.objects[0].mesher.nodes = 150;
    scene.objects[1].shape = BoxShape{glm::dvec3(0.4)};
    scene.objects[1].mesher.kind = MesherKind::tetgen;
    return scene;
}

std::vector<glm::vec4> download(unsigned buffer, std::size_t count) {
    std::vector<glm::vec4> values(count, glm::vec4(NAN));
    gl::barrier(gl::Barrier::buffer_update);
    glBindBuffer(GL_COPY_READ_BUFFER, buffer);
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(16 * count), values.data());
    return values;
}

class DrawSourceTest : public test::SimulatorFixture, public ::testing::WithParamInterface<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, DrawSourceTest, ::testing::Values(Backend::gl, Backend::cpu),
                         [](const auto& test) { return test.param == Backend::gl ? "Gl" : "Cpu"; });

TEST_P(DrawSourceTest, DrawsTheSkinWhereTheNodesCarryIt) {
    Simulator simulator(ball_and_box(), on(GetParam()));
    const Model& model = model_of(simulator);
    ASSERT_FALSE(model.skin.is_empty());
    for (int f = 0; f < 20; ++f) simulator.advance_frame();
    const RenderView view = simulator.render_view();
    ASSERT_EQ(view.node_count, model.skin.points.size());
    EXPECT_EQ(view.face_count, model.skin.faces.size());
    EXPECT_EQ(view.vertex_count, model.skin.surface.vertices.size());
    EXPECT_EQ(view.object_count, 2u);

    const HostFrame frame = simulator.read_frame();
    const std::vector<float> expected =
        carry_skin(model.skin.points, std::span<const float>(frame.positions));
    const std::vector<glm::vec4> points = download(view.node_positions, view.node_count);
    const std::vector<glm::vec4> normals = download(view.vertex_normals, view.vertex_count);
    glm::vec3 low(points[0]), high(low);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const glm::vec3 at(expected[3 * p], expected[3 * p + 1], expected[3 * p + 2]);
        EXPECT_LT(glm::distance(glm::vec3(points[p]), at), 1e-6f);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    for (const glm::vec4& n : normals) EXPECT_NEAR(glm::length(glm::vec3(n)), 1.0f, 1e-5f);
    if (GetParam() == Backend::gl) return;  // its box is late
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(view.box_min[k], low[k]);
        EXPECT_EQ(view.box_max[k], high[k]);
    }
}

TEST_P(DrawSourceTest, WhatBelongsToNodesIsShownOnTheHull) {
    Simulator simulator(ball_and_box(), on(GetParam()));
    const Model& model = model_of(simulator);
    for (const Overlays& overlays : {Overlays{.color_map = ColorMap{}}, Overlays{.faces = true}}) {
        const RenderView view = simulator.render_view(overlays);
        EXPECT_EQ(view.node_count, model.node_count());
        EXPECT_EQ(view.face_count, model.faces.size());
        EXPECT_EQ(view.node_positions, view.overlay.node_positions);
        EXPECT_EQ(simulator.render_view().face_count, model.skin.faces.size()) << "and gone with it";
    }
}

TEST_P(DrawSourceTest, OtherOverlaysHaveTheNodesBesideTheSkin) {
    Simulator simulator(ball_and_box(), on(GetParam()));
    const Model& model = model_of(simulator);
    simulator.advance_frame();
    const HostFrame frame = simulator.read_frame();
    for (const Overlays& overlays :
         {Overlays{.cut = CutPlane{}}, Overlays{.full_strain = 0.1f}, Overlays{.arrow_time = 0.1f}}) {
        const RenderView view = simulator.render_view(overlays);
        EXPECT_EQ(view.face_count, model.skin.faces.size());
        ASSERT_EQ(view.overlay.node_count, model.node_count());
        const std::vector<glm::vec4> nodes = download(view.overlay.node_positions, view.overlay.node_count);
        for (std::size_t n = 0; n < nodes.size(); ++n) EXPECT_EQ(nodes[n].y, frame.positions[3 * n + 1]);
    }
}

}  // namespace
}  // namespace gelatin
