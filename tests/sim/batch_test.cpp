#include "gelatin/batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "gelatin/error.h"

namespace gelatin {
namespace {

// Three objects that meet a floor and each other, with a handle: much that a step could share by mistake.
Scene busy_scene() {
    Scene scene;
    Material& jelly = scene.materials.emplace_back();
    jelly.name = "jelly";
    jelly.youngs_modulus = 2e4;
    const auto add = [&](const char* name, const Shape& shape,
                         const glm::dvec3& position) -> ObjectDescription& {
        ObjectDescription& object = scene.objects.emplace_back();
        object.name = name;
        object.shape = shape;
        object.material = "jelly";
        object.position = position;
        return object;
    };
    add("ball", SphereShape{0.3, 3}, {0.0, 0.35, 0.0});
    add("upper", SphereShape{0.3, 3}, {0.05, 1.1, 0.0});
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{0.0, -1.0, 0.0}, -2.1};
    handle.keyframes = {{0.0}, {0.5, {0.0, -0.4, 0.0}}};
    add("press", BoxShape{{1.0, 0.3, 1.0}, {2, 1, 2}}, {0.0, 2.0, 0.0}).handles.push_back(handle);
    scene.colliders.emplace_back().shape = PlaneCollider{};
    return scene;
}

void expect_same(const HostFrame& actual, const HostFrame& expected) {
    EXPECT_EQ(actual.frame, expected.frame);
    EXPECT_EQ(actual.time, expected.time);
    EXPECT_EQ(actual.positions, expected.positions);
    EXPECT_EQ(actual.velocities, expected.velocities);
    EXPECT_EQ(actual.contact_forces, expected.contact_forces);
}

TEST(BatchTest, WorldsInAnyStateHaveTheBitsOfSimulatorsOfTheirOwn) {
    const Scene scene = busy_scene();
    Batch batch(scene, 3);
    for (std::size_t w = 0; w < batch.size(); ++w)
        for (std::size_t s = 0; s < 5 * w; ++s) batch[w].step();
    batch.advance(15);
    for (std::size_t w = 0; w < batch.size(); ++w) {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        Simulator alone(scene, options);
        for (std::size_t s = 0; s < 5 * w; ++s) alone.step();
        for (int f = 0; f < 15; ++f) alone.advance_frame();
        expect_same(batch[w].read_frame(), alone.read_frame());
    }
    EXPECT_NE(batch[0].read_frame().positions, batch[1].read_frame().positions);
}

TEST(BatchTest, ResetsWhatTheMaskNames) {
    Batch batch(busy_scene(), 3);
    const HostFrame start = batch[1].read_frame();
    batch.advance(8);
    const HostFrame later = batch[1].read_frame();
    batch.reset(std::vector<std::uint8_t>{0, 1, 0});
    expect_same(batch[1].read_frame(), start);
    expect_same(batch[0].read_frame(), later);
    expect_same(batch[2].read_frame(), later);
    batch.advance(8);
    expect_same(batch[1].read_frame(), later);
}

TEST(BatchTest, MovesAndNeedsAWorld) {
    Batch batch(busy_scene(), 2);
    Batch moved = std::move(batch);
    moved.step();
    EXPECT_GT(moved[1].time(), 0.0);
    EXPECT_THROW(Batch(busy_scene(), 0), InvalidInput);
    Scene scene = busy_scene();
    scene.simulation.solver = SolverKind::rk4;
    scene.collision.broad_phase = BroadPhase::depth;
    EXPECT_THROW(Batch(scene, 2), InvalidInput) << "which needs OpenGL";
}

}  // namespace
}  // namespace gelatin
