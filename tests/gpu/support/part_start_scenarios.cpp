#include "gpu/support/part_start_scenarios.h"

#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "gpu/support/part_start_on_gpu.h"
#include "gpu/support/part_start_reference.h"
#include "gpu/support/start_errors.h"
#include "model/assembly/build_model.h"
#include "support/contact_scenes.h"
#include "support/elastic_cases.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

// Rows for which there is no place are left out, and counted.
double capacity_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs);
    const bool is_untouched = gpu.run();
    const StartResult actual = gpu.result();
    StartErrors errors;
    errors.require(is_untouched);
    errors.require(actual.clock.row_count == at.capacity);
    errors.require(actual.clock.dropped_rows + at.capacity == expected.rows.size());
    errors.require(actual.paces[1].row_end == at.capacity && actual.paces[0].first_row == 0);
    for (const glm::dvec3& d : actual.solved) errors.add(glm::length(d), 0.0, 0.1);
    return errors.worst();
}

// After the step is over nothing is done.
double over_error(const StartCase& at) {
    StartOnGpu gpu(at, part_start_reference(at).first);
    gpu.run();
    StepClock clock = gpu.read_clock();
    clock.is_over = 1;
    gpu.state.tries.set_clock(clock);
    gpu.run();
    return error_if(gpu.read_clock().tries != clock.tries || gpu.read_clock().goes_on != 0);
}

struct Bodies {
    glm::dvec3 velocity{0.3, -0.8, 0.1};  // of the first [m/s]
    bool is_held = false, has_loads = false, has_solids = false, has_planes = true, has_fast_node = false;
    float height = 0.0f;  // above planes; 0: some nodes are inside [m]
};

std::vector<ColliderDescription> colliders_of(const Bodies& at) {
    std::vector<ColliderDescription> colliders;
    const auto add = [&](const auto& shape, const glm::dvec3& position, double friction) {
        ColliderDescription& collider = colliders.emplace_back();
        collider.shape = shape;
        collider.position = position;
        collider.friction = friction;
    };
    if (at.has_planes) {
        add(PlaneCollider{{0, 1, 0}, 0.0}, {}, 0.4);
        add(PlaneCollider{glm::normalize(glm::dvec3(1, 0.1, 0)), -0.002}, {}, 0.2);
    }
    if (at.has_solids) {
        add(Shape(BoxShape{{0.2, 0.1, 0.2}}), {0.15, -0.051, 0.15}, 0.5);
        add(Shape(SphereShape{0.2}), {1.1, -0.201, 0.1}, 0.3);
        add(Shape(CapsuleShape{0.1, 0.3}), {-0.101, 0.15, 0.1}, 0.1);
    }
    return colliders;
}

// A soft body of two chunks and springs, and a small stiff one of neo-Hookean tets; some nodes are inside.
std::shared_ptr<const Model> make_bodies(const Bodies& at) {
    std::vector<Body> bodies;
    Body body = make_body(make_block({6, 6, 7}, {0.3, 0.3, 0.35}, 0.15, 1));
    body.velocity = at.velocity;
    body.spin = {1.0, 2.0, -1.5};
    body.material.youngs_modulus = 2e4;
    body.material.damping = 0.002;
    if (at.is_held) body.pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.24}};
    if (at.has_loads) body.loads = {{HalfSpaceRegion{{0.0, 0.0, 1.0}, 0.3}, ForceLoad{{5.0, 2.0, -8.0}}}};
    bodies.push_back(body);
    Body small = make_body(make_block({2, 2, 2}, glm::dvec3(0.2), 0.15, 2));
    small.velocity = {0.0, -0.2, 0.1};
    small.spin = {-3.0, 1.0, 0.5};
    for (glm::dvec3& p : small.mesh.positions) p += glm::dvec3(1.0, 0.0, 0.0);
    small.material.model = MaterialModel::neo_hookean;
    small.material.springs.reset();
    small.material.youngs_modulus = 5e6;
    bodies.push_back(small);
    Model model = pack_bodies(bodies, colliders_of(at), {0.5, -9.81, 0.0});
    shake_nodes(model, 0.0003f);
    for (glm::vec4& x : model.positions) x += glm::vec4(at.height, at.height, 0.0f, 0.0f);
    for (std::uint32_t n = 0; n < model.node_count(); ++n)  // of handles
        if (model.positions[n].w == 0.0f) model.velocities[n] = glm::vec4(0.2f, -0.1f, 0.05f, 0.0f);
    if (at.has_fast_node) model.velocities[5].z = 12.0f;  // of the first chunk
    return std::make_shared<const Model>(std::move(model));
}

// Between two planes; some touch neither.
std::shared_ptr<const Model> make_many_bodies() {
    std::vector<ColliderDescription> planes(2);
    planes[0].shape = PlaneCollider{{0, 1, 0}, 0.0};
    planes[1].shape = PlaneCollider{{0, -1, 0}, -0.102};
    std::vector<Block> blocks;
    for (int k = 0; k < 270; ++k) {
        const bool is_small = k % 3 == 0;
        blocks.push_back({.place = {0.2 * k, is_small ? 0.03 : 0.001, 0.0},
                          .velocity = {0.0, k % 2 == 0 ? -0.6 : 0.6, 0.0},
                          .cells = {1, 1, 1},
                          .size = glm::dvec3(is_small ? 0.05 : 0.1)});
    }
    return make_blocks(blocks, {0, -9.81, 0}, planes);
}

constexpr float kPart = 1.0f / 240.0f;

}  // namespace

Scenarios part_start_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, const Bodies& bodies, StartCase at) {
        scenarios.push_back({name, [bodies, at] {
                                 StartCase with_model = at;
                                 with_model.model = make_bodies(bodies);
                                 return start_error(with_model);
                             }});
    };
    // Those that find most errors come first.
    add("all_kinds_of_colliders", {.has_solids = true}, {.last_step = 0.9f * kPart, .has_memory = true});
    add("loads_and_hands", {.is_held = true, .has_loads = true}, {.last_step = kPart, .has_pulls = true});
    add("divided", {}, {.size = 4.0f * kPart, .divides = true, .last_step = kPart, .has_memory = true});
    add("still_bodies_are_damped", {.height = 0.001f},
        {.last_step = kPart, .has_memory = true, .paces = {2, 2}});
    add("held_and_divided", {.is_held = true}, {.size = 4.0f * kPart, .divides = true, .last_step = kPart});
    add("second_part", {.is_held = true}, {.size = 4.0f * kPart, .left = 1.5f * kPart, .last_step = kPart});
    add("first_part", {}, {});
    add("no_colliders", {.has_planes = false}, {.last_step = 0.9f * kPart});
    add("known_contacts", {}, {.last_step = 0.9f * kPart, .has_memory = true});
    add("fast_node", {.has_fast_node = true}, {});
    add("divided_in_two", {.height = 0.001f},
        {.size = 4.0f * kPart, .divides = true, .last_step = kPart, .has_memory = true, .paces = {1, 2}});
    add("not_divided_at_rest", {.height = 0.001f},
        {.size = 4.0f * kPart, .divides = true, .last_step = kPart, .has_memory = true, .paces = {2, 2}});
    add("too_deep", {.velocity = {0.0, -20.0, 0.0}},
        {.size = 4.0f * kPart, .last_step = kPart, .damps = true});
    add("damped", {}, {.last_step = kPart, .damps = true});
    add("struck", {}, {.last_step = kPart, .struck = {1, 0}});
    add("held", {.is_held = true}, {.last_step = kPart});
    add("carried", {.is_held = true, .has_planes = false}, {.last_step = kPart});
    add("loads", {.has_loads = true, .has_planes = false}, {.last_step = kPart});
    add("hands", {.has_planes = false}, {.last_step = kPart, .has_pulls = true});
    scenarios.push_back({"many_bodies", [] {
                             StartCase at{make_many_bodies()};
                             at.paces.assign(at.model->body_count(), 0);
                             at.struck = at.paces;
                             return start_error(at);
                         }});
    scenarios.push_back(
        {"too_many_rows", [] { return capacity_error({.model = make_bodies({}), .capacity = 70}); }});
    scenarios.push_back({"over", [] { return over_error({make_bodies({})}); }});
    return scenarios;
}

void run_part_start() {
    start_error({.model = make_bodies({.has_loads = true}), .size = 4.0f * kPart, .divides = true});
}

}  // namespace gelatin::test
