#include "gpu/support/body_contact_runs.h"

#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin::test {

gpu::ImplicitSolver make_device_solver(const std::shared_ptr<const Model>& model,
                                       const DeviceContacts& contacts) {
    return gpu::ImplicitSolver(
        model,
        {.response = CollisionResponse::contact, .self_collision = true, .friction = contacts.friction},
        {.iterations = contacts.iterations,
         .divides_steps = contacts.divides_steps,
         .sleeps = contacts.sleeps},
        contacts.room);
}

State scattered(const Model& model) {
    State state{model.positions, model.velocities, model.velocities, {}};
    RandomMaker random(3);
    for (std::uint32_t n = 0; n < model.objects[0].nodes.count; ++n)
        state.positions[n] =
            glm::vec4(glm::vec3(glm::dvec3(0.15) + random.point(0.015)), state.positions[n].w);
    return state;
}

std::shared_ptr<const Model> pushed_block() {
    HandleDescription side;
    side.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    side.interpolation = Interpolation::smooth;
    side.keyframes = {{0.0}, {0.3, {0.15, 0.0, 0.0}, {0.0, 0.0, 15.0}}};
    return make_blocks(
        {{.cells = {2, 2, 2}, .handles = {side}}, {.place = {0.31, 0.02, 0.01}, .cells = {2, 2, 2}}});
}

std::shared_ptr<const Model> blocked_block(double depth) {
    const Region all = SphereRegion{{0.1, 0.1, 0.1}, 1.0};
    HandleDescription handle;
    handle.region = all;
    handle.keyframes = {
        {0.0}, {0.2, {0.0, -depth, 0.0}}, {0.3, {0.0, -depth, 0.0}}, {0.4, {0.0, -0.02, 0.0}}};
    const glm::dvec3 size(0.2);
    return make_blocks({{.place = {0, 0.24, 0}, .cells = {2, 2, 2}, .size = size, .handles = {handle}},
                        {.place = {0.02, 0, 0.01}, .cells = {2, 2, 2}, .size = size, .pins = {all}}});
}

void run_body_contacts() {
    const auto model = make_blocks({{.cells = {1, 1, 1}}, {.place = {0, 0.302, 0}, .cells = {1, 1, 1}}});
    gpu::ImplicitSolver solver = make_device_solver(model, {.room = gpu::PairCapacity{1, 4, 4, 4}});
    for (int frame = 0; frame < 2; ++frame) solver.advance({kFrame});
    solver.contact_forces();
    const auto larger = make_blocks({{}});
    gpu::ImplicitSolver other = make_device_solver(larger);
    other.write_state(scattered(*larger));
    for (int frame = 0; frame < 2; ++frame) other.advance({kFrame});
    other.read_state();
}

}  // namespace gelatin::test
