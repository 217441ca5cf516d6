// Contacts between bodies in whole steps on the device: that nothing crosses, in however little room; what
// passes through checkpoints; forces to read, and handles that are blocked.
#include "gpu/implicit/body_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>

#include "gpu/implicit/implicit_solver.h"
#include "gpu/support/body_contact_runs.h"
#include "model/drive/handle_arms.h"
#include "model/drive/handles.h"
#include "support/contact_scenes.h"
#include "support/gl_fixture.h"
#include "support/overlaps.h"

namespace gelatin {
namespace {

using test::kFrame;
using test::make_device_solver;
using test::scattered;
using SharedModel = std::shared_ptr<const Model>;

// Two blocks on top of each other and a floor.
SharedModel make_stack() {
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    return test::make_blocks({{.place = {0, 0.002, 0}, .cells = {2, 2, 2}, .size = glm::dvec3(0.2)},
                              {.place = {0.02, 0.206, 0}, .cells = {2, 2, 2}, .size = glm::dvec3(0.2)}},
                             {0, -9.81, 0}, {floor});
}

class BodyContactsTest : public test::GlTest {};
class BodyContactsLong : public test::GlTest {};

// @param is_short_of_room at first
void fuzz(unsigned first, unsigned count, int steps, bool is_short_of_room) {
    for (unsigned seed = first; seed < first + count; ++seed) {
        const test::ViolentScene scene = test::violent_scene(seed);
        test::DeviceContacts settings{.iterations = scene.iterations, .divides_steps = scene.divides_steps};
        if (is_short_of_room) settings.room = gpu::PairCapacity{1, 8, 8, 40};
        gpu::ImplicitSolver solver = make_device_solver(scene.model, settings);
        const auto energy_of = [&] {
            const State state = solver.read_state();
            return test::sum_bodies<float>(*scene.model, {state.positions, state.velocities});
        };
        const test::BodySums energy = energy_of();
        for (int step = 0; step < steps; ++step) {
            solver.advance({scene.step});
            ASSERT_EQ(test::count_overlaps(*scene.model,
                                           std::span<const cpu::Vec4<float>>(solver.read_state().positions)),
                      0u)
                << "scene " << seed << ", step " << step;
            ASSERT_LE(energy_of().sum(), energy.sum() + 0.2 * energy.kinetic)
                << "scene " << seed << ", step " << step;
        }
    }
}

TEST_F(BodyContactsTest, NothingPassesThroughAnything) {
    fuzz(1, 2, 12, false);
}

TEST_F(BodyContactsTest, NothingPassesThroughAnythingInNoRoom) {
    fuzz(3, 1, 12, true);
}

TEST_F(BodyContactsLong, NothingPassesThroughAnything) {
    fuzz(100, 150, 15, false);
    fuzz(300, 50, 15, true);
}

State state_after(gpu::ImplicitSolver& solver, int frames) {
    for (int frame = 0; frame < frames; ++frame) solver.advance({kFrame});
    return solver.read_state();
}

// What had no room is made again when it has.
TEST_F(BodyContactsTest, RoomDoesNotMatter) {
    const SharedModel model = make_stack();
    gpu::ImplicitSolver narrow = make_device_solver(model, {.room = gpu::PairCapacity{1, 8, 8, 10}}),
                        wide = make_device_solver(model);
    EXPECT_EQ(state_after(narrow, 8).positions, state_after(wide, 8).positions);
}

TEST_F(BodyContactsTest, RepeatsBitForBitAndStartsAgain) {
    const SharedModel model = make_stack();
    gpu::ImplicitSolver solver = make_device_solver(model), again = make_device_solver(model);
    const State start = solver.read_state(), end = state_after(solver, 10);
    EXPECT_EQ(state_after(again, 10).positions, end.positions);
    again.write_state(start);
    EXPECT_EQ(state_after(again, 10).positions, end.positions);
}

TEST_F(BodyContactsTest, GoOnFromACheckpoint) {
    const SharedModel model = make_stack();
    gpu::ImplicitSolver solver = make_device_solver(model);
    State state = state_after(solver, 10);
    state.memory = solver.memory();
    gpu::ImplicitSolver other = make_device_solver(model, {.room = gpu::PairCapacity{1, 8, 8, 10}});
    other.write_state(state);
    EXPECT_TRUE(other.contact_forces().between.empty());  // until a step finds them
    const State end = state_after(solver, 5);
    EXPECT_EQ(state_after(other, 5).positions, end.positions);
    State without = state;
    without.memory.clear();
    other.write_state(without);
    EXPECT_NE(state_after(other, 5).positions, end.positions);
}

TEST_F(BodyContactsTest, ForcesAreWeights) {
    const SharedModel model = make_stack();
    gpu::ImplicitSolver solver = make_device_solver(model);
    state_after(solver, 100);
    const double weight = 9.81 * (model->objects[0].mass + model->objects[1].mass);
    const ContactForces forces = solver.contact_forces();
    ASSERT_EQ(forces.between.size(), 2u);  // the upper one on the lower one, and that on the floor
    for (const ContactForces::Between& between : forces.between) {
        const double carried = between.is_plane ? weight : 9.81 * model->objects[1].mass;
        EXPECT_NEAR(std::abs(between.normal.y), carried, 0.02 * carried);
        EXPECT_GT(between.points, 0u);
    }
    glm::dvec3 on_nodes(0.0);
    for (const glm::dvec3& force : forces.normal) on_nodes += force;
    EXPECT_NEAR(on_nodes.y, weight, 0.02 * weight);
}

std::size_t points_of(const ContactForces& forces) {
    std::size_t points = 0;
    for (const ContactForces::Between& between : forces.between) points += between.points;
    return points;
}

// Rows that exert no force, of pairs that are only near, are no points. Rounding decides for a few.
TEST_F(BodyContactsTest, PointsAreThoseThatPress) {
    const SharedModel model = test::pushed_block();
    gpu::ImplicitSolver solver = make_device_solver(model);
    auto reference = test::make_solver<double>(model);
    double points = 0.0, expected = 0.0;
    for (int frame = 0; frame < 20; ++frame) {
        test::advance(solver, *model, frame);
        test::advance(reference, *model, frame);
        points += static_cast<double>(points_of(solver.contact_forces()));
        expected += static_cast<double>(points_of(reference.contact_forces()));
    }
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(points, expected, 0.05 * expected);
}

// [m]
double farthest_move(const State& from, const State& to) {
    double most = 0.0;
    for (std::size_t n = 0; n < from.positions.size(); ++n)
        most = std::max(most, glm::distance(glm::dvec3(from.positions[n]), glm::dvec3(to.positions[n])));
    return most;
}

// Bodies that rest stay where they are to the last bit, and have no speed.
bool is_asleep(gpu::ImplicitSolver& solver) {
    const State before = state_after(solver, 1), after = state_after(solver, 1);
    return before.positions == after.positions &&
           std::all_of(after.velocities.begin(), after.velocities.end(),
                       [](const glm::vec4& v) { return glm::vec3(v) == glm::vec3(0.0f); });
}

int frames_until_asleep(gpu::ImplicitSolver& solver) {
    int frames = 0;
    while (frames < 400 && !is_asleep(solver)) frames += 2;
    return frames;
}

TEST_F(BodyContactsTest, BodiesAtRestSleepAndWake) {
    const SharedModel model = make_stack();
    gpu::ImplicitSolver solver = make_device_solver(model, {.sleeps = true});
    const int frames = frames_until_asleep(solver);
    EXPECT_GT(frames, 30);  // half a second
    EXPECT_LT(frames, 400);
    const ContactForces forces = solver.contact_forces();
    EXPECT_EQ(forces.between.size(), 2u);  // as when they fell asleep
    const double weight = 9.81 * model->objects[1].mass;
    solver.set_forces(std::vector<glm::vec3>(model->node_count(), glm::vec3(0.0f, 1e-3f, 0.0f)));
    EXPECT_FALSE(is_asleep(solver));
    solver.set_forces({});
    EXPECT_FALSE(is_asleep(solver));
    EXPECT_NEAR(std::abs(solver.contact_forces().between[0].normal.y), weight, 0.05 * weight);
    EXPECT_LT(frames_until_asleep(solver), 60);
}

TEST_F(BodyContactsTest, BodiesThatMayNotSleepGoOn) {
    gpu::ImplicitSolver solver = make_device_solver(make_stack());
    state_after(solver, 200);
    EXPECT_FALSE(is_asleep(solver));
}

TEST_F(BodyContactsTest, HandlesWakeBodies) {
    const SharedModel model = test::blocked_block();
    gpu::ImplicitSolver solver = make_device_solver(model, {.sleeps = true}),
                        other = make_device_solver(model);
    ASSERT_LT(frames_until_asleep(solver), 40);
    for (int frame = 0; frame < 3; ++frame)
        for (gpu::ImplicitSolver* each : {&solver, &other}) test::advance(*each, *model, frame);
    EXPECT_LT(farthest_move(other.read_state(), solver.read_state()), 1e-6);
}

TEST_F(BodyContactsTest, SleepGoesOnFromACheckpoint) {
    const SharedModel model = make_stack();
    gpu::ImplicitSolver solver = make_device_solver(model, {.sleeps = true});
    ASSERT_LT(frames_until_asleep(solver), 400);
    State state = solver.read_state();
    state.memory = solver.memory();
    gpu::ImplicitSolver other = make_device_solver(model, {.sleeps = true});
    other.write_state(state);
    EXPECT_TRUE(is_asleep(other));
    state.memory.clear();
    other.write_state(state);
    EXPECT_FALSE(is_asleep(other));
}

// It waits where a body is in its way, and goes on from there. (On the CPU it catches up more slowly, and
// what it pushes is slower.)
TEST_F(BodyContactsTest, BlockedHandlesWait) {
    const SharedModel model = test::blocked_block();
    const HandleNode& held = model->handle_nodes[0];
    gpu::ImplicitSolver solver = make_device_solver(model);
    int waiting = 0;
    for (int frame = 0; frame < 26; ++frame) {
        test::advance(solver, *model, frame);
        const State state = solver.read_state();
        EXPECT_EQ(test::count_overlaps(*model, std::span<const cpu::Vec4<float>>(state.positions)), 0u);
        std::vector<HandlePose> poses;
        for (const Handle& handle : model->handles) poses.push_back(pose_at(handle, (frame + 1) * kFrame));
        const std::vector<double> times(poses.size());
        const std::vector<glm::dvec3> places = HandleArms(model).places(poses, times);
        const std::vector<std::uint32_t> held_up = solver.held_up(places);
        if (held_up.empty()) continue;
        EXPECT_EQ(held_up, std::vector<std::uint32_t>{0});
        ++waiting;
    }
    EXPECT_GE(waiting, 15);
    const glm::dvec3 end = pose_at(model->handles[0], 1.0).place(glm::dvec3(held.arm));
    EXPECT_LT(glm::distance(glm::dvec3(solver.read_state().positions[held.node]), end), 1e-6);
}

// Also with what handles exert, which depends on how they moved before.
TEST_F(BodyContactsTest, BlockedHandlesGoOnFromACheckpoint) {
    const SharedModel model = test::blocked_block();
    gpu::ImplicitSolver solver = make_device_solver(model), other = make_device_solver(model);
    int frame = 0;
    for (; frame < 10; ++frame) test::advance(solver, *model, frame);
    State state = solver.read_state();
    state.memory = solver.memory();
    other.write_state(state);
    for (; frame < 26; ++frame) {
        for (gpu::ImplicitSolver* each : {&solver, &other}) test::advance(*each, *model, frame);
        EXPECT_EQ(other.read_state().positions, solver.read_state().positions) << frame;
        EXPECT_EQ(other.holding_forces().by_handle, solver.holding_forces().by_handle) << frame;
    }
}

// What was set from outside did not come there through what is in between.
TEST_F(BodyContactsTest, HeldNodesBeginWhereHandlesHaveThem) {
    const SharedModel model = test::blocked_block(0.5);
    gpu::ImplicitSolver solver = make_device_solver(model);
    const State start = solver.read_state();
    for (int frame = 0; frame < 2; ++frame) test::advance(solver, *model, frame);
    solver.write_state(start);
    test::advance(solver, *model, 14);  // below the other block
    const HandleNode& held = model->handle_nodes[0];
    EXPECT_NEAR(solver.read_state().positions[held.node].y, start.positions[held.node].y - 0.5f, 1e-6f);
}

// Of the first body [m].
float extent_of(const Model& model, std::span<const glm::vec4> positions) {
    float most = 0.0f;
    for (const glm::vec4& x : positions.first(model.objects[0].nodes.count))
        most = std::max(most, glm::distance(glm::vec3(x), glm::vec3(positions[0])));
    return most;
}

TEST_F(BodyContactsTest, ShapesArePutBack) {
    const SharedModel model = test::make_blocks({{.youngs_modulus = 3e4}, {.place = {1, 0, 0}}});
    gpu::ImplicitSolver solver = make_device_solver(model);
    auto reference = test::make_solver<float>(model);
    solver.write_state(scattered(*model));
    reference.write_state(scattered(*model));
    const std::vector<glm::vec4> positions = state_after(solver, 3).positions;
    for (int frame = 0; frame < 3; ++frame) reference.advance({kFrame});
    double farthest = 0.0;
    for (std::uint32_t n = 0; n < model->node_count(); ++n)
        farthest = std::max<double>(
            farthest, glm::distance(glm::vec3(positions[n]), glm::vec3(reference.nodes().positions[n])));
    EXPECT_LT(farthest, 1e-3);
    EXPECT_GT(extent_of(*model, positions), 0.95f * extent_of(*model, model->positions));
}

// Of bodies without gravity, of which the first was scattered, after so short a step that nothing but its
// shape takes nodes anywhere.
State put_back(const glm::dvec3& place_of_other, const std::vector<ColliderDescription>& colliders = {}) {
    const SharedModel model =
        test::make_blocks({{.youngs_modulus = 3e4}, {.place = place_of_other}}, {0, 0, 0}, colliders);
    gpu::ImplicitSolver solver = make_device_solver(model);
    solver.write_state(scattered(*model));
    solver.advance({1e-4});
    return solver.read_state();
}

// Neither where there is no path for it, nor where the guard would let it go nearly all of it.
TEST_F(BodyContactsTest, ShapesStayLostIfAnythingIsInTheWay) {
    const glm::dvec3 far(1, 0, 0), near(0.05, 0.18, 0.05);
    const State lost = scattered(*test::make_blocks({{}, {.place = far}})), whole = put_back(far);
    EXPECT_GT(farthest_move(lost, whole), 0.1);
    float lowest = 0.0f;
    for (const glm::vec4& x : whole.positions) lowest = std::min(lowest, x.y);
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, static_cast<double>(lowest) + 0.002};
    EXPECT_LT(farthest_move(lost, put_back(far, {floor})), 1e-4);
    const State in_the_way = put_back(near);
    for (std::uint32_t n = 0; n < lost.positions.size() / 2; ++n)
        EXPECT_LT(glm::distance(in_the_way.positions[n], lost.positions[n]), 1e-4f) << n;
}

// Nodes are elsewhere than on the CPU, by centimetres: the guard projects what is scattered on the half
// spaces of many pairs, one after the other, and each backend lists pairs in an order of its own.
TEST_F(BodyContactsTest, ShapesAreNotPutBackThroughOthers) {
    const SharedModel model = test::make_blocks({{.youngs_modulus = 3e4}, {.place = {0.05, 0.18, 0.05}}});
    gpu::ImplicitSolver solver = make_device_solver(model);
    solver.write_state(scattered(*model));
    ASSERT_LT(extent_of(*model, state_after(solver, 1).positions),
              0.7f * extent_of(*model, model->positions));
    for (int frame = 0; frame < 8; ++frame) {
        solver.advance({kFrame});
        const State state = solver.read_state();
        ASSERT_EQ(test::count_overlaps(*model, std::span<const cpu::Vec4<float>>(state.positions),
                                       test::Overlaps::between),
                  0u)
            << frame;
    }
}

}  // namespace
}  // namespace gelatin
