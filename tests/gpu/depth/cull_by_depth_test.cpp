#include "gpu/depth/cull_by_depth.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <random>

#include "gpu/collision_stages.h"
#include "gpu/support/collision_scenarios.h"
#include "support/crowd.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using Move = glm::dvec3 (*)(glm::dvec3);

Body moved(Body body, const glm::dvec3& by) {
    for (glm::dvec3& p : body.mesh.positions) p += by;
    return body;
}

Body block(glm::ivec3 cells, glm::dvec3 size, glm::dvec3 place = {}) {
    return moved(test::make_body(test::make_block(cells, size)), place);
}

Model make_still(const std::vector<Body>& bodies) {
    return pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
}

// What the stage leaves, and how many pairs of objects come of it.
struct Left {
    std::vector<std::uint32_t> faces, objects;
    std::uint32_t pairs = 0;
};

Left find_left(const Model& model, BroadPhase broad_phase = BroadPhase::depth) {
    const gpu::ModelBuffers model_buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::Collision collision(model, {.broad_phase = broad_phase});
    collision.update_boxes.run(model_buffers, collision.buffers, nodes, nodes);
    collision.find_object_pairs.run(model_buffers, collision.buffers, nodes);
    gl::barrier(gl::Barrier::buffer_update);
    const auto hidden_in_all = [](const gl::Buffer<std::uint32_t>& views) {
        std::vector<std::uint32_t> values(views.size()), found;
        views.download(values);
        for (std::uint32_t k = 0; k < values.size(); ++k)
            if (values[k] == gpu::CullByDepth::kViews) found.push_back(k);
        return found;
    };
    std::vector<PairRow> rows(model.objects.size());
    collision.buffers.pair_rows.download(rows);
    Left left;
    if (const gpu::CullByDepth* stage = collision.cull_by_depth.get())
        left = {hidden_in_all(stage->face_views), hidden_in_all(stage->object_views)};
    for (const PairRow& row : rows) left.pairs += row.pair_count;
    return left;
}

class FarPairParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, FarPairParityTest, ::testing::ValuesIn(test::far_pair_scenarios()),
                         test::name_of_scenario);

TEST_P(FarPairParityTest, LosesNothing) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class CullByDepthTest : public test::GlTest {
protected:
    static void expect_nothing_lost(const Model& model, std::size_t least = 1) {
        const test::FaceCollisions expected = test::find_collisions_on_cpu<float>(model, {});
        EXPECT_GE(expected.size(), least) << "too few collisions to test anything";
        EXPECT_EQ(test::find_collisions_on_gpu(model, {.broad_phase = BroadPhase::depth}), expected);
    }
};

struct HardPlace {
    const char* name;
    Move move;
    int objects = 12;
};

// The crowd where single precision is coarse, where it is flat, seen from its edge, or nearly a point.
constexpr HardPlace kHardPlaces[] = {
    {"far_from_the_origin", [](glm::dvec3 p) { return p + glm::dvec3(3e4, -2e4, 1e4); }},
    {"as_small_as_dust", [](glm::dvec3 p) { return 1e-6 * p; }},
    {"dust_far_from_the_origin", [](glm::dvec3 p) { return 1e-3 * p + glm::dvec3(100.0, 50.0, 30.0); }},
    {"as_large_as_a_moon", [](glm::dvec3 p) { return 1e6 * p; }},
    {"flat", [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 0.0); }},
    {"flat_and_slanted", [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 0.3 * p.x + 0.7 * p.y); }},
    {"a_line", [](glm::dvec3 p) { return glm::dvec3(0.0, p.y, 0.0); }, 4},  // of more, pairs would be lost
    {"thin_as_a_hair", [](glm::dvec3 p) { return glm::dvec3(1e-5, 1.0, 1e-4) * p; }},
};

class CullHardPlacesTest : public CullByDepthTest, public ::testing::WithParamInterface<HardPlace> {};
INSTANTIATE_TEST_SUITE_P(All, CullHardPlacesTest, ::testing::ValuesIn(kHardPlaces),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(CullHardPlacesTest, LosesNothing) {
    Model model = test::make_crowd(GetParam().objects, 5);
    for (glm::vec4& p : model.positions) p = glm::vec4(GetParam().move(glm::dvec3(p)), p.w);
    expect_nothing_lost(model, 50);
}

TEST_F(CullByDepthTest, LosesNothingBetweenLargeAndSmall) {
    std::vector<Body> bodies{block({1, 1, 1}, {100.0, 100.0, 100.0})};
    for (int i = 0; i < 20; ++i)
        bodies.push_back(block({1, 1, 1}, glm::dvec3(0.01), {5.0 * i + 0.3, 3.1 * i + 0.2, 99.995}));
    expect_nothing_lost(make_still(bodies), 40);
}

TEST_F(CullByDepthTest, LosesNothingOfManyInOnePlace) {
    std::vector<Body> bodies;
    for (int i = 0; i < 30; ++i)
        bodies.push_back(block({2, 2, 2}, glm::dvec3(1.0), glm::dvec3(0.013, 0.017, 0.011) * double(i)));
    expect_nothing_lost(make_still(bodies), 500);
}

// Sides, edges and corners of blocks that only touch; the third block, far away, makes pixels larger than
// they are.
TEST_F(CullByDepthTest, KeepsWhatOnlyJustTouches) {
    for (const glm::dvec3 offset : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1),
                                    glm::dvec3(1, 1, 0), glm::dvec3(-1, 1, 1)}) {
        for (const double distance : {3.0, 1000.0}) {
            expect_nothing_lost(
                make_still({block({1, 1, 1}, glm::dvec3(1.0)), block({1, 1, 1}, glm::dvec3(1.0), offset),
                            block({1, 1, 1}, glm::dvec3(1.0), glm::dvec3(distance))}));
        }
    }
}

TEST_F(CullByDepthTest, LeavesNoneOfObjectsWhoseBoxesAloneMeet) {
    std::vector<Body> bodies;
    for (const double side : {0.0, 0.6}) {
        Body bar = block({1, 8, 1}, {0.3, 4.0, 0.3}, {-0.15 + side, -2.0, -0.15});
        const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 0.3, 0.8)));
        for (glm::dvec3& p : bar.mesh.positions) p = turn * p;
        bodies.push_back(bar);
    }
    const Model model = make_still(bodies);
    ASSERT_EQ(find_left(model, BroadPhase::boxes).pairs, 2u) << "boxes separate them";
    const Left left = find_left(model);
    EXPECT_EQ(left.faces.size(), 0u);
    EXPECT_EQ(left.objects.size(), 0u);
    EXPECT_EQ(left.pairs, 0u);
}

// No direction sees all of 27 blocks. The views peel them off from six sides, down to the last.
TEST_F(CullByDepthTest, PeelsALatticeFromAllSides) {
    std::vector<Body> bodies;
    for (int i = 0; i < 27; ++i)
        bodies.push_back(block({2, 2, 2}, glm::dvec3(1.0), 1.2 * glm::dvec3(i % 3, i / 3 % 3, i / 9)));
    const Left left = find_left(make_still(bodies));
    EXPECT_LE(left.objects.size(), 1u);
    EXPECT_EQ(left.pairs, 0u);
}

TEST_F(CullByDepthTest, LeavesTheFacesNearAContactAlone) {
    const Model model = make_still(
        {block({12, 12, 12}, glm::dvec3(1.0)), block({12, 12, 12}, glm::dvec3(1.0), {0.95, 0.93, 0.9})});
    const Left left = find_left(model);
    EXPECT_EQ(left.objects.size(), 2u);
    EXPECT_LT(left.faces.size(), model.faces.size() / 10);
    for (const auto& [face, other, touch] : test::find_collisions_on_cpu<float>(model, {}))
        EXPECT_TRUE(std::binary_search(left.faces.begin(), left.faces.end(), face)) << face;
}

// An application may have set anything for its own drawing.
class HostState {
public:
    HostState() {
        for (const GLenum s : kSwitches) glEnable(s);
        glGenVertexArrays(1, &vertex_array_);
        glBindVertexArray(vertex_array_);
        glGenFramebuffers(1, &framebuffer_);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
        glViewport(3, 5, 70, 110);
        glScissor(0, 0, 1, 1);
        glCullFace(GL_FRONT_AND_BACK);
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glDepthFunc(GL_NEVER);
        glDepthMask(GL_FALSE);
        glDepthRange(0.9, 0.2);
        glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
        glStencilFunc(GL_NEVER, 0, 0xFF);
        glLogicOp(GL_CLEAR);
    }
    HostState(const HostState&) = delete;
    HostState& operator=(const HostState&) = delete;
    ~HostState() {
        for (const GLenum s : kSwitches) glDisable(s);
        glBindVertexArray(0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glDeleteVertexArrays(1, &vertex_array_);
        glDeleteFramebuffers(1, &framebuffer_);
        glCullFace(GL_BACK);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glStencilFunc(GL_ALWAYS, 0, 0xFF);
        glLogicOp(GL_COPY);
    }

    static std::vector<double> read() {
        std::vector<double> values;
        for (const GLenum s : kSwitches) values.push_back(glIsEnabled(s));
        for (const GLenum name :
             {GL_VERTEX_ARRAY_BINDING, GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_VIEWPORT,
              GL_SCISSOR_BOX, GL_POLYGON_MODE, GL_DEPTH_FUNC, GL_DEPTH_WRITEMASK, GL_DEPTH_RANGE,
              GL_COLOR_WRITEMASK, GL_DRAW_INDIRECT_BUFFER_BINDING}) {
            double found[4] = {};
            glGetDoublev(name, found);
            values.insert(values.end(), found, found + 4);
        }
        return values;
    }

private:
    static constexpr GLenum kSwitches[] = {GL_BLEND,        GL_COLOR_LOGIC_OP,     GL_CULL_FACE,
                                           GL_DEPTH_CLAMP,  GL_DEPTH_TEST,         GL_SCISSOR_TEST,
                                           GL_STENCIL_TEST, GL_RASTERIZER_DISCARD, GL_CLIP_DISTANCE0};
    GLuint vertex_array_ = 0, framebuffer_ = 0;
};

TEST_F(CullByDepthTest, NeitherHeedsNorChangesWhatAnApplicationHasSet) {
    const Model model = test::make_crowd(12, 5);
    const Left usual = find_left(model);
    const HostState host;
    const std::vector<double> before = HostState::read();
    const Left left = find_left(model);
    EXPECT_EQ(HostState::read(), before);
    EXPECT_EQ(left.faces, usual.faces);
    EXPECT_EQ(left.objects, usual.objects);
}

TEST_F(CullByDepthTest, ForgetsTheStepBefore) {
    Model model =
        make_still({block({2, 2, 2}, glm::dvec3(1.0)), block({2, 2, 2}, glm::dvec3(1.0), glm::dvec3(0.5))});
    const gpu::ModelBuffers model_buffers(model);
    gpu::NodeBuffers nodes(model.positions, model.velocities);
    const gpu::CollisionBuffers buffers(model);
    const gpu::UpdateBoxes update_boxes(CollisionDetection::discrete);
    gpu::CullByDepth stage(model);
    const auto count_left = [&] {
        update_boxes.run(model_buffers, buffers, nodes, nodes);
        stage.run(model_buffers, buffers, nodes);
        gl::barrier(gl::Barrier::buffer_update);
        std::vector<std::uint32_t> views(stage.object_views.size());
        stage.object_views.download(views);
        return std::count(views.begin(), views.end(), gpu::CullByDepth::kViews);
    };
    EXPECT_EQ(count_left(), 2);
    const Range& second = model.objects[1].nodes;
    for (std::uint32_t n = second.first; n < second.end(); ++n) model.positions[n].x += 5.0f;
    nodes.positions.upload(model.positions);
    EXPECT_EQ(count_left(), 0);
}

}  // namespace
}  // namespace gelatin
