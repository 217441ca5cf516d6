// Rigid bodies outside the solver: what is read, changed, saved and continued.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/file.h"
#include "gelatin/batch.h"
#include "gelatin/error.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kCushion = 0, kCrate = 1;

// A crate of 38.4 kg above a cushion.
Scene crate_and_cushion(const glm::dvec3& gravity) {
    Scene scene;
    scene.simulation.gravity = gravity;
    scene.materials.resize(2);
    scene.materials[0].name = "foam";
    scene.materials[0].damping = 0.02;
    scene.materials[1].name = "wood";
    scene.materials[1].density = 600.0;
    ObjectDescription& cushion = scene.objects.emplace_back();
    cushion.name = "cushion";
    cushion.material = "foam";
    cushion.shape = BoxShape{{1.0, 0.3, 1.0}, {4, 1, 4}};
    cushion.position.y = 0.15;
    ObjectDescription& crate = scene.objects.emplace_back();
    crate.name = "crate";
    crate.material = "wood";
    crate.rigid.emplace();
    crate.shape = BoxShape{glm::dvec3(0.4), glm::ivec3(1)};
    crate.position = {0.1, 0.6, 0.0};
    crate.rotation = {20.0, 0.0, 10.0};
    scene.colliders.emplace_back().shape = PlaneCollider{};
    return scene;
}

Scene floating() {
    Scene scene = crate_and_cushion(glm::dvec3(0.0));
    scene.objects[kCrate].position.y = 3.0;
    return scene;
}

struct Motion {
    double mass = 0.0;
    glm::dvec3 center{0.0}, momentum{0.0}, angular{0.0};
};

Motion motion_of(const Simulator& simulator, std::size_t object) {
    const Range& nodes = model_of(simulator).objects[object].nodes;
    Motion motion;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const double mass = 1.0 / static_cast<double>(simulator.positions()[n].w);
        motion.mass += mass;
        motion.center += mass * glm::dvec3(simulator.positions()[n]);
        motion.momentum += mass * glm::dvec3(simulator.velocities()[n]);
    }
    motion.center /= motion.mass;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        motion.angular += 1.0 / static_cast<double>(simulator.positions()[n].w) *
                          glm::cross(glm::dvec3(simulator.positions()[n]) - motion.center,
                                     glm::dvec3(simulator.velocities()[n]));
    return motion;
}

// Of a body's nodes, from where its rotation has them [m].
double distance_to_rigid(const Simulator& simulator, std::size_t object) {
    const Model& model = model_of(simulator);
    const Range& nodes = model.objects[object].nodes;
    const glm::dquat rotation = simulator.rotation(object);
    const glm::dvec3 now(simulator.positions()[nodes.first]), start(model.positions[nodes.first]);
    double farthest = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        farthest = std::max(farthest, glm::distance(glm::dvec3(simulator.positions()[n]) - now,
                                                    rotation * (glm::dvec3(model.positions[n]) - start)));
    return farthest;
}

std::vector<glm::vec3> part(std::span<const glm::vec4> all, const IndexRange& range) {
    const auto own = all.subspan(range.first, range.count);
    return {own.begin(), own.end()};
}

void advance(Simulator& simulator, int frames) {
    for (int f = 0; f < frames; ++f) {
        simulator.advance_frame();
        simulator.begin_statistics();
        simulator.take_statistics();  // which checks the energy
    }
}

class RigidBodiesTest : public test::SimulatorFixture, public ::testing::WithParamInterface<Backend> {
protected:
    Simulator make(const Scene& scene) { return Simulator(scene, on(GetParam())); }
};
INSTANTIATE_TEST_SUITE_P(Backends, RigidBodiesTest, ::testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& backend) { return backend.param == Backend::cpu ? "Cpu" : "Gl"; });

TEST_P(RigidBodiesTest, AreDescribedAndMeasured) {
    Simulator simulator = make(crate_and_cushion({0.0, -9.81, 0.0}));
    EXPECT_FALSE(simulator.object(kCushion).is_rigid);
    const ObjectInfo crate = simulator.object(kCrate);
    EXPECT_TRUE(crate.is_rigid);
    EXPECT_EQ(crate.tets.count, 0u);
    EXPECT_NEAR(crate.mass, 38.4, 1e-9);
    EXPECT_NEAR(crate.rest_volume, 0.064, 1e-9);
    advance(simulator, 30);
    EXPECT_LT(distance_to_rigid(simulator, kCrate), 1e-6);
    simulator.begin_statistics();
    const FrameStatistics statistics = simulator.take_statistics();
    EXPECT_NEAR(statistics.volume_ratio[kCrate], 1.0, 1e-5);
    EXPECT_EQ(statistics.deepest_penetration, 0.0);
    EXPECT_FALSE(statistics.contact_forces.empty());
}

TEST_P(RigidBodiesTest, RotationsAreRead) {
    Scene scene = floating();
    scene.objects[kCushion].spin = scene.objects[kCrate].spin = {0.0, 90.0, 0.0};
    scene.objects[kCushion].position.y = 1.5;
    scene.objects[kCrate].rotation = {0.0, 30.0, 0.0};
    Simulator simulator = make(scene);
    EXPECT_NEAR(glm::angle(simulator.rotation(kCrate)), 0.0, 1e-6);
    advance(simulator, 60);
    for (const std::size_t object : {kCushion, kCrate}) {
        const glm::dvec3 x = simulator.rotation(object) * glm::dvec3(1.0, 0.0, 0.0);
        EXPECT_LT(glm::distance(x, glm::dvec3(0.0, 0.0, -1.0)), object == kCrate ? 1e-2 : 5e-2) << object;
    }
    EXPECT_THROW(simulator.rotation(2), InvalidInput);
}

TEST_P(RigidBodiesTest, SetPositionsTakeTheNearestPose) {
    Scene scene = floating();
    scene.objects[kCrate].spin = {0.0, 0.0, 180.0};
    scene.objects[kCrate].velocity = {1.0, 0.0, 0.0};
    Simulator simulator = make(scene);
    simulator.advance_frame();
    const Motion before = motion_of(simulator, kCrate);
    const glm::dquat turn = glm::angleAxis(1.2, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));
    std::vector<glm::vec3> places = part(simulator.positions(), simulator.object(kCrate).nodes);
    const glm::dquat expected = turn * simulator.rotation(kCrate);
    for (glm::vec3& p : places)  // also larger
        p = glm::vec3(glm::dvec3(0.0, 5.0, 0.0) + turn * (1.1 * (glm::dvec3(p) - before.center)));
    simulator.set_positions(kCrate, places);
    EXPECT_LT(distance_to_rigid(simulator, kCrate), 2e-6);
    EXPECT_NEAR(std::abs(glm::dot(simulator.rotation(kCrate), expected)), 1.0, 1e-6);
    const Motion after = motion_of(simulator, kCrate);
    EXPECT_LT(glm::distance(after.center, glm::dvec3(0.0, 5.0, 0.0)), 1e-5);
    EXPECT_LT(glm::distance(after.momentum, before.momentum), 1e-4);
    EXPECT_LT(glm::distance(after.angular, before.angular), 1e-4)
        << "a cube's inertia is the same about any axis";
    advance(simulator, 60);
    EXPECT_LT(distance_to_rigid(simulator, kCrate), 2e-6);
    EXPECT_LT(glm::distance(motion_of(simulator, kCrate).momentum, before.momentum), 1e-3);
    EXPECT_LT(glm::distance(motion_of(simulator, kCrate).angular, before.angular), 1e-2);
}

TEST_P(RigidBodiesTest, SetVelocitiesTakeTheNearestMotion) {
    Simulator simulator = make(floating());
    const IndexRange nodes = simulator.object(kCrate).nodes;
    std::vector<glm::vec3> velocities(nodes.count, glm::vec3(0.0f));
    const auto node = nodes.first;
    velocities[0] = {3.0f, 1.0f, -2.0f};
    const double mass = 1.0 / static_cast<double>(simulator.positions()[node].w);
    const glm::dvec3 arm = glm::dvec3(simulator.positions()[node]) - motion_of(simulator, kCrate).center,
                     momentum = mass * glm::dvec3(velocities[0]);
    simulator.set_velocities(kCrate, velocities);
    const auto expect_motion = [&](double tolerance) {
        EXPECT_LT(glm::distance(motion_of(simulator, kCrate).momentum, momentum), tolerance);
        EXPECT_LT(glm::distance(motion_of(simulator, kCrate).angular, glm::cross(arm, momentum)), tolerance);
    };
    expect_motion(1e-5);
    EXPECT_NE(simulator.velocities()[nodes.first + 1], glm::vec4(0.0f)) << "all nodes move";
    advance(simulator, 30);
    expect_motion(1e-3);
}

// F = m a, and the moment about the centre.
TEST_P(RigidBodiesTest, LoadsAccelerateAndSpin) {
    Scene scene = floating();
    ObjectDescription& crate = scene.objects[kCrate];
    crate.rotation = glm::dvec3(0.0);
    crate.loads = {{SphereRegion{crate.position, 1.0}, ForceLoad{{0.0, 0.0, 20.0}}}};
    const double time = 0.5;
    const auto end_of = [&](const Scene& of) {
        Simulator simulator = make(of);
        advance(simulator, 30);
        EXPECT_LT(distance_to_rigid(simulator, kCrate), 2e-6);
        return motion_of(simulator, kCrate);
    };
    Motion end = end_of(scene);
    EXPECT_LT(glm::distance(end.momentum, glm::dvec3(0.0, 0.0, 20.0 * time)), 1e-3);
    EXPECT_LT(glm::length(end.angular), 1e-3);
    // At one corner, for a moment.
    crate.loads[0] = {SphereRegion{crate.position + glm::dvec3(0.2), 0.05}, ForceLoad{{0.0, 0.0, 20.0}}};
    crate.loads[0].until = 0.05;
    end = end_of(scene);
    EXPECT_LT(glm::distance(end.momentum, glm::dvec3(0.0, 0.0, 1.0)), 1e-2);
    EXPECT_LT(glm::distance(end.angular, glm::dvec3(0.2, -0.2, 0.0)), 1e-2);
    // A traction on the top, and a pressure on it.
    const Region top = HalfSpaceRegion{{0.0, -1.0, 0.0}, -3.19};
    crate.loads = {{top, TractionLoad{{0.0, 0.0, 30.0}}}, {top, PressureLoad{100.0}}};
    for (LoadDescription& load : crate.loads) load.until = 0.05;
    end = end_of(scene);
    EXPECT_LT(glm::distance(end.momentum, 0.05 * 0.16 * glm::dvec3(0.0, -100.0, 30.0)), 1e-2);
    EXPECT_LT(glm::distance(end.angular, glm::dvec3(0.05 * 0.16 * 30.0 * 0.2, 0.0, 0.0)), 1e-2);
}

// By all nodes, to hang 2 cm below where it is pulled to; then by a corner.
TEST_P(RigidBodiesTest, HandsPullAndPinsAreRefused) {
    Simulator simulator = make(crate_and_cushion({0.0, -9.81, 0.0}));
    const IndexRange nodes = simulator.object(kCrate).nodes;
    const double stiffness = 38.4 * 9.81 / 0.02;
    const Motion start = motion_of(simulator, kCrate);
    Pull pull;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::vec4& p = simulator.positions()[n];
        pull.nodes.push_back(
            {n, glm::vec3(glm::dvec3(p) - start.center), static_cast<float>(stiffness / 38.4) / p.w});
    }
    pull.target = start.center + glm::dvec3(0.0, 1.0, 0.5);
    pull.damping_time = 2.0 * std::sqrt(38.4 / stiffness);
    simulator.set_pulls({pull});
    advance(simulator, 120);
    EXPECT_LT(distance_to_rigid(simulator, kCrate), 2e-6);
    const Motion now = motion_of(simulator, kCrate);
    EXPECT_LT(glm::length(now.momentum) / now.mass, 1e-2);
    EXPECT_LT(glm::distance(now.center, pull.target - glm::dvec3(0.0, 0.02, 0.0)), 1e-3);
    pull.nodes = {{nodes.first, glm::vec3(0.0f), 2e4f}};
    pull.target = glm::dvec3(simulator.positions()[nodes.first]);
    simulator.set_pulls({pull});
    advance(simulator, 300);
    EXPECT_LT(distance_to_rigid(simulator, kCrate), 2e-6);
    EXPECT_LT(glm::distance(motion_of(simulator, kCrate).center, pull.target), 1.0) << "it swings";
    simulator.set_pulls({});
    try {
        simulator.pin(kCrate, std::vector<std::uint32_t>{0});
        ADD_FAILURE() << "it was not refused";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("object 'crate' is rigid"));
    }
    advance(simulator, 10);
}

TEST_P(RigidBodiesTest, CheckpointsGoOnBitForBit) {
    Scene scene = crate_and_cushion({0.0, -9.81, 0.0});
    scene.objects[kCrate].spin = {50.0, 200.0, 10.0};
    const TemporaryFolder folder;
    Simulator whole = make(scene);
    std::vector<Simulator> others;
    for (int f = 0; f < 120; ++f) {
        if (f == 3 || f == 17 || f == 60) {
            whole.save_checkpoint(folder.path() / "a.ckpt");
            others.push_back(make(scene));
            others.back().load_checkpoint(folder.path() / "a.ckpt");
        }
        whole.advance_frame();
        for (Simulator& other : others) other.advance_frame();
    }
    for (const Simulator& other : others) {
        EXPECT_EQ(other.read_frame().positions, whole.read_frame().positions);
        EXPECT_EQ(other.read_frame().velocities, whole.read_frame().velocities);
    }
    whole.reset();
    EXPECT_EQ(whole.read_frame().positions, make(scene).read_frame().positions);
}

TEST_P(RigidBodiesTest, GoOnWhenTheModelChanges) {
    Scene scene = floating();
    scene.objects[kCrate].spin = {90.0, 0.0, 0.0};
    scene.objects[kCrate].velocity = {0.0, 1.0, 0.0};
    scene.objects[kCrate].shape = BoxShape{{0.4, 0.2, 0.6}, glm::ivec3(1)};
    Simulator simulator = make(scene);
    advance(simulator, 10);
    const HostFrame before = simulator.read_frame();
    simulator.pin(kCushion, std::vector<std::uint32_t>{0, 1});
    const IndexRange nodes = simulator.object(kCrate).nodes;
    for (std::size_t k = 3 * nodes.first; k < 3 * nodes.end(); ++k)
        ASSERT_EQ(simulator.read_frame().positions[k], before.positions[k]);
    simulator.unpin(kCushion);

    const Motion light = motion_of(simulator, kCrate);
    const glm::dquat rotation = simulator.rotation(kCrate);
    Material wood = scene.materials[1];
    wood.density = 1200.0;
    simulator.set_material(wood);
    const Motion heavy = motion_of(simulator, kCrate);
    EXPECT_NEAR(heavy.mass, 2.0 * light.mass, 1e-4);
    EXPECT_NEAR(simulator.object(kCrate).mass, 2.0 * light.mass, 1e-4);
    EXPECT_LT(glm::distance(heavy.center, light.center), 1e-6);
    EXPECT_LT(glm::distance(heavy.momentum, 2.0 * light.momentum), 1e-3);
    EXPECT_LT(glm::distance(heavy.angular, 2.0 * light.angular), 1e-4);

    // With another inertia and place at the start.
    scene.objects[kCrate].rigid->inertia = glm::dvec3(2.0, 3.0, 4.0);
    scene.objects[kCrate].position.x += 3.0;
    scene.objects[kCrate].rotation = glm::dvec3(0.0);
    Simulator other = make(scene);
    other.go_on_from(simulator);
    EXPECT_LT(distance_to_rigid(other, kCrate), 2e-6);
    const Model &from = model_of(simulator), &to = model_of(other);
    ASSERT_GT(glm::distance(from.positions[nodes.end() - 1] - from.positions[nodes.first],
                            to.positions[nodes.end() - 1] - to.positions[nodes.first]),
              0.05f)
        << "its nodes inside are elsewhere";
    for (std::uint32_t n = nodes.first; n + 4 < nodes.end(); ++n)
        EXPECT_LT(glm::distance(glm::vec3(other.positions()[n]), glm::vec3(simulator.positions()[n])), 2e-6f);
    EXPECT_LT(glm::distance(motion_of(other, kCrate).center, heavy.center), 2e-6);
    EXPECT_LT(glm::distance(motion_of(other, kCrate).momentum, light.momentum), 1e-3);
    EXPECT_GT(glm::angle(other.rotation(kCrate) * glm::conjugate(rotation)), 0.1) << "from another start";
    advance(other, 30);
    EXPECT_LT(distance_to_rigid(other, kCrate), 2e-6);
}

TEST_P(RigidBodiesTest, LieOnTheFloorAndStartWithinIt) {
    for (const double height : {0.2, 0.2001, 0.205, 0.1995, 0.1}) {
        Scene scene = floating();
        scene.objects[kCrate].position = {2.0, height, 0.0};
        scene.objects[kCrate].rotation = glm::dvec3(0.0);
        scene.simulation.gravity = {0.0, -9.81, 0.0};
        scene.objects.erase(scene.objects.begin());
        Simulator simulator = make(scene);
        for (int f = 0; f < 60; ++f) {
            advance(simulator, 1);
            const Motion motion = motion_of(simulator, 0);
            ASSERT_NEAR(motion.center.y, 0.2, 0.01) << height << " in frame " << f;
        }
        EXPECT_LT(glm::length(motion_of(simulator, 0).momentum), 0.01) << height;
    }
}

// Its nodes inside are outside of it.
TEST_P(RigidBodiesTest, MayHaveALargeInertia) {
    Scene scene = crate_and_cushion({0.0, -9.81, 0.0});
    scene.objects.erase(scene.objects.begin());
    scene.objects[0].rotation = glm::dvec3(0.0);
    scene.objects[0].position.y = 0.21;
    scene.objects[0].rigid->inertia = glm::dvec3(20.0);
    Simulator simulator = make(scene);
    EXPECT_NEAR(motion_of(simulator, 0).center.y, 0.21, 1e-6) << "it is not within the floor";
    advance(simulator, 30);
    EXPECT_NEAR(motion_of(simulator, 0).center.y, 0.2, 0.005);
}

TEST_P(RigidBodiesTest, AreMovedApartAsWholes) {
    Scene scene = floating();
    scene.objects[kCrate].position = {0.3, 0.35, 0.1};
    scene.objects.push_back(scene.objects[kCrate]);
    scene.objects[2].name = "second";
    scene.objects[2].position.x += 0.2;
    scene.objects[2].rigid->mass = 1.0;
    Simulator simulator = make(scene);
    for (const std::size_t object : {kCrate, std::size_t{2}}) {
        EXPECT_LT(distance_to_rigid(simulator, object), 1e-6);
        EXPECT_NEAR(glm::angle(simulator.rotation(object)), 0.0, 1e-5);
    }
    advance(simulator, 30);
}

TEST(RigidBodies, RunInBatches) {
    const Scene scene = crate_and_cushion({0.0, -9.81, 0.0});
    Batch batch(scene, 3);
    const IndexRange nodes = batch[1].object(kCrate).nodes;
    batch[1].set_velocities(kCrate, std::vector<glm::vec3>(nodes.count, {1.0f, 0.0f, 0.0f}));
    batch.advance(20);
    EXPECT_EQ(batch[0].read_frame().positions, batch[2].read_frame().positions);
    EXPECT_GT(motion_of(batch[1], kCrate).center.x, motion_of(batch[0], kCrate).center.x + 0.1);
    batch.reset({std::vector<std::uint8_t>{0, 1, 0}});
    EXPECT_EQ(batch[1].frame(), 0);
}

class RigidBodiesOnBothTest : public test::SimulatorFixture {};

// The host makes the steps.
TEST_F(RigidBodiesOnBothTest, GiveTheSameBits) {
    const Scene scene = crate_and_cushion({0.0, -9.81, 0.0});
    Simulator host(scene, on(Backend::cpu)), device(scene, on(Backend::gl));
    advance(host, 30);
    advance(device, 30);
    EXPECT_EQ(host.read_frame().positions, device.read_frame().positions);
    EXPECT_EQ(host.read_frame().velocities, device.read_frame().velocities);
}

}  // namespace
}  // namespace gelatin
