#include "gpu/collision_stages.h"

#include <gtest/gtest.h>

#include <random>

#include "cpu/collision/collision.h"
#include "gpu/collision_stages.h"
#include "gpu/measure/measure.h"
#include "gpu/support/collision_scenarios.h"
#include "support/crowd.h"
#include "support/draw_vector.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr BroadPhase kBroadPhases[] = {BroadPhase::none, BroadPhase::boxes, BroadPhase::hierarchy,
                                       BroadPhase::depth};

class CollisionOnGpuTest : public test::GlTest {};

void expect_boxes_of_the_cpu(const Model& model, CollisionDetection detection) {
    const gpu::ModelBuffers model_buffers(model);
    const std::vector<glm::vec4> before = test::positions_before(model, 0.1);
    const gpu::NodeBuffers nodes(model.positions, model.velocities), previous(before, model.velocities);
    const gpu::CollisionBuffers buffers(model);
    const gpu::UpdateBoxes stage(detection);
    stage.run(model_buffers, buffers, previous, nodes);
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<BoundingBox> boxes(model.objects.size());
    buffers.bounding_boxes.download(boxes);

    cpu::Collision<float> expected(std::make_shared<const Model>(model), BroadPhase::boxes, detection);
    expected.update_boxes(model.positions, before);
    for (std::size_t o = 0; o < boxes.size(); ++o) {
        EXPECT_EQ(glm::vec3(boxes[o].min), expected.bounding_boxes()[o].min);
        EXPECT_EQ(glm::vec3(boxes[o].max), expected.bounding_boxes()[o].max);
        EXPECT_EQ(boxes[o].object, o);
        EXPECT_EQ(boxes[o].node_count, model.objects[o].nodes.count);
        EXPECT_EQ(boxes[o].face_count, model.objects[o].faces.count);
        EXPECT_EQ(boxes[o].first_face, model.objects[o].faces.first);
    }
}

TEST_F(CollisionOnGpuTest, BoxesAreThoseOfTheCpu) {
    const Model model = test::make_crowd(70);  // more objects than lanes
    for (const auto detection : {CollisionDetection::discrete, CollisionDetection::continuous})
        expect_boxes_of_the_cpu(model, detection);
}

class CollisionParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, CollisionParityTest, ::testing::ValuesIn(test::collision_scenarios()),
                         test::name_of_scenario);

TEST_P(CollisionParityTest, CollidesAsOnTheCpu) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class ContinuousCollisionParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, ContinuousCollisionParityTest,
                         ::testing::ValuesIn(test::continuous_collision_scenarios()), test::name_of_scenario);

TEST_P(ContinuousCollisionParityTest, CollidesOnTheWayAsOnTheCpu) {
    EXPECT_LE(GetParam().error(), 1.0);
}

// A body as large as the paper's against many small ones: blocks of candidates longer than one.
TEST_F(CollisionOnGpuTest, ObjectsOfDifferentSizesCollideAsOnTheCpu) {
    std::vector<Body> bodies{test::make_body(test::make_block({16, 16, 16}, {1.6, 1.6, 1.6}, 0.2))};
    for (int i = 0; i < 9; ++i) {
        Body small = test::make_body(test::make_block({2, 1, 3}, {0.3, 0.2, 0.3}));
        for (glm::dvec3& p : small.mesh.positions) p += glm::dvec3(0.2 * i - 0.2, 0.17 * i, 1.45 - 0.1 * i);
        bodies.push_back(small);
    }
    const Model model = pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
    const test::FaceCollisions expected =
        test::find_collisions_on_cpu<float>(model, {.broad_phase = BroadPhase::none});
    EXPECT_GT(expected.size(), 50u);
    for (const BroadPhase broad_phase : kBroadPhases) {
        EXPECT_EQ(test::find_collisions_on_gpu(model, {.broad_phase = broad_phase}), expected);
    }
}

// What is measured of a model's start.
Measurement detect_and_measure(const Model& model) {
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    gpu::Collision collision(model, {});
    collision.update_boxes.run(buffers, collision.buffers, nodes, nodes);
    collision.find_object_pairs.run(buffers, collision.buffers, nodes);
    collision.find_face_collisions.run(buffers, collision.buffers, nodes, nodes);
    gpu::Measure measure(model);
    measure.begin(buffers, nodes, &collision.buffers);
    return measure.end();
}

TEST_F(CollisionOnGpuTest, CountsCollidingFaces) {
    const auto model = std::make_shared<const Model>(test::make_crowd(20));
    const auto expected = test::find_collisions_on_cpu<float>(*model, {});
    std::vector<std::uint32_t> counts(model->objects.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        if (k == 0 || expected[k].face != expected[k - 1].face)
            ++counts[model->faces[expected[k].face].object];
    }
    const Measurement measured = detect_and_measure(*model);
    for (std::size_t o = 0; o < counts.size(); ++o)
        EXPECT_EQ(measured.objects[o].colliding_faces, counts[o]) << o;
    EXPECT_EQ(measured.lost_pairs, 0u);
}

// Faces torn so far apart that all their boxes meet, more than there is room for: counted, not forgotten.
TEST_F(CollisionOnGpuTest, SaysHowManyPairsAreLost) {
    Model tangle = pack_bodies({test::make_body(test::make_block({6, 6, 6}, {1, 1, 1})),
                                test::make_body(test::make_block({6, 6, 6}, {1, 1, 1}))},
                               {}, {0.0, 0.0, 0.0});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (glm::vec4& p : tangle.positions) p = glm::vec4(test::draw_vector<glm::vec3>(unit, random), p.w);
    EXPECT_GT(detect_and_measure(tangle).lost_pairs, 0u);
}

}  // namespace
}  // namespace gelatin
