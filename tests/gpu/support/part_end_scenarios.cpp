#include "gpu/support/part_end_scenarios.h"

#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/support/end_of_parts.h"
#include "support/contact_scenes.h"
#include "support/elastic_cases.h"

namespace gelatin::test {
namespace {

using Outcome = EndReference::Outcome;

const ColliderDescription kFloor{.shape = PlaneCollider{{0.0, 1.0, 0.0}, 0.0}, .friction = 0.4};

// Two blocks over a floor: one that turns and falls on it, one beside it.
std::shared_ptr<const Model> two_blocks(const Block& first, double restitution = 0.0) {
    ColliderDescription floor = kFloor;
    floor.restitution = restitution;
    Block second{.place = {1.0, 0.6, 0.0}, .velocity = {0.0, 1.0, 0.3}, .cells = {2, 3, 2}};
    return make_blocks({first, second}, {0.0, -10.0, 0.0}, {floor});
}

// The first hangs from held nodes, which move.
std::shared_ptr<const Model> held_blocks() {
    Model model = *two_blocks({.place = {0, 0.3, 0}, .pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.55}}});
    for (std::size_t n = 0; n < model.velocities.size(); ++n)
        if (model.positions[n].w == 0.0f) model.velocities[n] = glm::vec4(0.3f, 0.8f, -0.2f, 0.0f);
    return std::make_shared<const Model>(std::move(model));
}

std::shared_ptr<const Model> loaded_blocks() {
    Model model = *two_blocks({.place = {0, 0.004, 0}, .velocity = {0.0, -0.5, 0.0}});
    model.loads.spans.emplace_back();
    for (std::uint32_t n = 1; n < model.objects[0].nodes.count; n += 3) {
        const auto entry = static_cast<std::uint32_t>(model.loads.entries.size());
        model.loads.nodes.push_back({n, entry, entry + 1, 0});
        model.loads.entries.push_back(
            {model.masses[n] * glm::vec4(20.0f, -10.0f + static_cast<float>(n % 7), 5.0f, 0.0f), 0, n, n, 0});
    }
    return std::make_shared<const Model>(std::move(model));
}

// By one radian and more in a part.
std::shared_ptr<const Model> rotating_blocks() {
    Model model = *two_blocks({.place = {0, 1.0, 0}, .velocity = {0.2, 1.0, 0.0}, .youngs_modulus = 1e7});
    for (const ModelObject& body : model.bodies()) {
        const glm::vec3 spin = &body == &model.objects[0] ? glm::vec3(10.0f, 70.0f, -20.0f) : glm::vec3(5.0f);
        glm::vec3 center(0.0f);
        for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n)
            center += glm::vec3(model.positions[n]) / static_cast<float>(body.nodes.count);
        for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n)
            model.velocities[n] += glm::vec4(glm::cross(spin, glm::vec3(model.positions[n]) - center), 0.0f);
    }
    return std::make_shared<const Model>(std::move(model));
}

// A block on the floor between a box, a sphere and a capsule.
std::shared_ptr<const Model> among_colliders() {
    Model model = *two_blocks({.place = {0, 0.004, 0}, .velocity = {0.6, -1.0, 0.4}}, 0.3);
    const glm::vec4 upright(0.0f, 0.0f, 0.0f, 1.0f);
    const auto add = [&](std::uint32_t kind, const glm::vec4& center, const glm::vec4& axis) {
        model.colliders.push_back({center, axis, upright, kind, 0.3f, 0.2f, 0});
    };
    add(1, {0.41f, 0.1f, 0.15f, 0.0f}, {0.1f, 0.1f, 0.4f, 0.0f});
    add(2, {0.15f, 0.15f, 0.51f, 0.2f}, {0.0f, 0.0f, 0.0f, 0.0f});
    add(3, {-0.11f, 0.1f, 0.1f, 0.1f}, {0.0f, 0.0f, 0.2f, 0.0f});
    return std::make_shared<const Model>(std::move(model));
}

// A block that falls on another.
std::shared_ptr<const Model> meeting_blocks(const Block& upper = {}, const Block& lower = {}) {
    Block falls = upper;
    falls.place += glm::dvec3(0.03, 0.303, 0.02);
    falls.velocity += glm::dvec3(0.3, -1.0, 0.1);
    return make_blocks({lower, falls}, {0.0, -10.0, 0.0});
}

// Two lie side by side on a third, whose lowest nodes are held and move; one more is beside them.
std::shared_ptr<const Model> held_pile(double youngs_modulus = 1e5) {
    std::vector<Block> blocks{
        {.cells = {4, 2, 2}, .size = {0.7, 0.2, 0.3}, .pins = {HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.01}}},
        {.place = {0.01, 0.203, 0.01}, .velocity = {0.1, -0.5, 0.0}, .cells = {2, 2, 2}},
        {.place = {2.0, 0.0, 0.0}, .velocity = {0.0, 1.0, 0.0}, .cells = {2, 2, 2}},
        {.place = {0.36, 0.202, 0.0}, .velocity = {-0.1, -0.8, 0.1}, .cells = {2, 2, 2}}};
    for (Block& block : blocks) block.youngs_modulus = youngs_modulus;
    Model model = *make_blocks(blocks, {0.0, -10.0, 0.0});
    for (std::size_t n = 0; n < model.velocities.size(); ++n)
        if (model.positions[n].w == 0.0f) model.velocities[n] = glm::vec4(0.3f, 0.5f, -0.2f, 0.0f);
    return std::make_shared<const Model>(std::move(model));
}

// Pairs that meet one after the other.
std::shared_ptr<const Model> several_stiff_blocks() {
    const auto block = [](const glm::dvec3& place, const glm::dvec3& velocity) {
        return Block{.place = place, .velocity = velocity, .cells = {2, 2, 2}, .youngs_modulus = 1e8};
    };
    return make_blocks({block({0, 0, 0}, {0, 1.0, 0}), block({0.5, 0, 0}, {0, 0.5, 0.1}),
                        block({0.52, 0.303, 0.02}, {0.1, -1.0, 0}),
                        block({0.02, 0.31, 0.01}, {0.1, -1.0, 0.2}), block({0, 0.62, 0.01}, {0, -2.0, 0})},
                       {0, -10, 0});
}

// A block on a box that moves, or whose surface does.
std::shared_ptr<const Model> on_a_surface(const glm::vec3& velocity, const glm::vec3& belt,
                                          double youngs_modulus = 1e5) {
    const ColliderDescription box{
        .shape = Shape{BoxShape{{1, 1, 1}}}, .position = {0.15, -0.5, 0.15}, .friction = 0.6};
    Model model = *make_blocks(
        {{.place = {0.0, 0.003, 0.0}, .velocity = {0.2, -0.5, 0.1}, .youngs_modulus = youngs_modulus},
         {.place = {0.02, 0.307, 0.0}, .velocity = {0.0, -0.7, 0.0}, .cells = {2, 2, 2}}},
        {0.0, -10.0, 0.0}, {box});
    for (std::uint32_t n = model.body_node_count(); n < model.node_count(); ++n)
        model.velocities[n] = glm::vec4(velocity, 0.0f);
    model.surfaces[0].velocity = belt;
    return std::make_shared<const Model>(std::move(model));
}

std::vector<PartChange> parts(int count, const PartChange& part = {}) {
    return std::vector<PartChange>(static_cast<std::size_t>(count), part);
}

Scenario scenario(std::string name, std::function<EndCase()> make) {
    return {std::move(name), [make = std::move(make)] {
                const EndCase at = make();
                return end_error(at);
            }};
}

// Of bodies that touch each other.
Scenarios island_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, std::function<EndCase()> make) {
        scenarios.push_back(scenario(name, [make = std::move(make)] {
            EndCase at = make();
            at.contacts = true;
            return at;
        }));
    };
    add("two_meet", [] { return EndCase{.model = meeting_blocks(), .parts = parts(6), .island = 2}; });
    add("two_rest_on_each_other_and_a_floor", [] {
        const Block lower{.place = {0, 0.004, 0}, .cells = {2, 2, 2}};
        const Block upper{.place = {0.02, 0.309, 0.01}, .cells = {2, 2, 2}};
        return EndCase{
            .model = make_blocks({lower, upper}, {0, -10, 0}, {kFloor}), .parts = parts(10), .island = 2};
    });
    add("what_an_island_owes_is_paid", [] {
        const Block soft{.youngs_modulus = 300.0};
        return EndCase{.model = meeting_blocks(soft, {.velocity = {0.0, 0.5, 0.2}, .cells = {2, 2, 2}}),
                       .parts = parts(4, {.noise = 0.1}),
                       .island = 2};
    });
    add("one_of_two_islands_gains", [] {
        EndCase at{.model = held_pile(),
                   .parts = parts(4, {.noise = 0.05}),
                   .outcomes = {Outcome::damped, Outcome::made},
                   .island = 3};
        at.parts[2].noise = 1.0;
        return at;
    });
    add("three_of_which_one_is_held",
        [] { return EndCase{.model = held_pile(), .parts = parts(5), .island = 3}; });
    add("on_a_surface_that_moves", [] {
        return EndCase{.model = on_a_surface({0.2f, 0.3f, 0.1f}, {}), .parts = parts(6), .island = 2};
    });
    add("on_a_belt", [] {
        return EndCase{.model = on_a_surface({}, {1.0f, 0.0f, 0.4f}), .parts = parts(6), .island = 2};
    });
    add("of_a_body_with_itself",
        [] { return EndCase{.model = meeting_blocks(), .parts = parts(4), .island = 2, .own_rows = 6}; });
    add("an_island_falls_apart", [] {
        EndCase at{.model = meeting_blocks(), .parts = parts(7), .island = 2, .is_torn = true};
        at.parts[3].is_apart = at.parts[3].strikes = true;
        return at;
    });
    for (const double restitution : {0.5, 1.0})
        add(restitution < 1.0 ? "two_bounce" : "two_bounce_in_full", [=] {
            const Block stiff{.velocity = {0.2, -1.0, 0.0}, .youngs_modulus = 1e8};
            return EndCase{
                .model = meeting_blocks(stiff, {.velocity = {0.0, 1.0, 0.0}, .youngs_modulus = 1e8}),
                .parts = parts(14),
                .restitution = restitution,
                .bounces = true,
                .island = 2};
        });
    add("several_bounce", [] {
        return EndCase{.model = several_stiff_blocks(),
                       .parts = parts(14),
                       .restitution = 0.4,
                       .bounces = true,
                       .contacts = true,
                       .island = 3};
    });
    add("bounces_off_a_surface_that_moves", [] {
        return EndCase{.model = on_a_surface({0.2f, 0.4f, 0.1f}, {}, 1e8),
                       .parts = parts(14),
                       .restitution = 0.6,
                       .bounces = true,
                       .island = 2};
    });
    add("an_island_is_guarded_and_stopped", [] {
        EndCase at{.model = meeting_blocks(),
                   .parts = parts(4),
                   .is_struck = true,
                   .is_guarded = true,
                   .contacts = true,
                   .island = 2};
        at.parts[0].step = 1e-4;
        at.parts[0].last_push = {10.0, -100.0, 0.0};
        return at;
    });
    return scenarios;
}

}  // namespace

Scenarios part_end_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, std::function<EndCase()> make) {
        scenarios.push_back(scenario(name, std::move(make)));
    };
    const Block falling{.place = {0, 0.005, 0}, .velocity = {0.5, -1.0, 0.2}};
    add("lands", [=] { return EndCase{two_blocks(falling), parts(8)}; });
    add("lies_still", [] {
        return EndCase{two_blocks({.place = {0, 0.004, 0}, .youngs_modulus = 1e6}), parts(12)};
    });
    add("what_is_owed_is_paid", [=] {
        Block soft = falling;
        soft.youngs_modulus = 300.0;
        return EndCase{two_blocks(soft), parts(3, {.noise = 0.1})};
    });
    add("is_made_again_with_damps_and_shorter", [] {
        const Block stiff{.place = {0, 0.2, 0}, .velocity = {0.1, 0.0, 0.0}, .youngs_modulus = 1e8};
        std::vector<PartChange> changes = parts(3);
        changes[2].noise = 0.3;
        return EndCase{
            two_blocks(stiff), changes, 0.0, false, {Outcome::damped, Outcome::divided, Outcome::made}};
    });
    add("stays_where_it_was", [=] {
        std::vector<PartChange> changes = parts(3);
        changes[1].breaks = true;
        return EndCase{two_blocks(falling), changes, 0.0, false, {Outcome::divided, Outcome::stood_still}};
    });
    for (const double restitution : {0.5, 1.0})
        add(restitution < 1.0 ? "bounces" : "bounces_in_full", [=] {
            const Block stiff{.place = {0, 0.004, 0}, .velocity = {0.3, -2.0, 0.1}, .youngs_modulus = 1e8};
            return EndCase{.model = two_blocks(stiff, restitution), .parts = parts(14), .bounces = true};
        });
    add("is_guarded", [=] {
        std::vector<PartChange> changes = parts(4);
        changes[1].push = {0.0, -8.0, 0.0};
        changes[1].noise = 0.5;
        return EndCase{two_blocks(falling), changes, 0.0, false, {}, false, true};
    });
    add("is_guarded_and_stopped", [=] {
        std::vector<PartChange> changes = parts(4);
        changes[0].push = {0.0, -3.0, 0.0};
        Block soft = falling;
        soft.youngs_modulus = 300.0;
        return EndCase{two_blocks(soft), changes, 0.0, false, {}, true, true};
    });
    add("is_stopped_without_a_contact", [=] {
        std::vector<PartChange> changes = parts(3);
        changes[0].step = 1e-4;  // as short as may be: it is made, whatever it gains
        changes[0].push = {20.0, -250.0, 0.0};
        const Block block{.place = {0, 0.02, 0}, .velocity = {0.2, 0, 0}};
        return EndCase{two_blocks(block), changes, 0.0, false, {}, true, true};
    });
    add("goes_on_after_what_is_set", [=] {
        std::vector<PartChange> changes = parts(5, {.noise = 0.01});
        changes[1].sets_velocities = true;
        changes[2].forgets = true;
        changes[4].goes_on = true;
        return EndCase{two_blocks(falling), changes};
    });
    add("is_held_and_moved", [=] { return EndCase{held_blocks(), parts(4, {.noise = 0.01})}; });
    add("is_loaded", [=] { return EndCase{loaded_blocks(), parts(4)}; });
    add("is_pulled", [=] { return EndCase{two_blocks(falling), parts(4), 0.0, true}; });
    add("rotates_fast", [=] { return EndCase{rotating_blocks(), parts(2, {.step = kStepSize})}; });
    add("meets_colliders_of_all_kinds", [=] {
        std::vector<PartChange> changes = parts(4);
        changes[2].noise = 3.0;
        return EndCase{among_colliders(), changes, 0.0, false, {}, false, true};
    });
    for (const char* kind : {"springs_with_a_volume_term", "neo_hookean_with_a_volume_term", "both_damped"})
        add(kind, [=] {
            std::vector<ElasticCase> all = elastic_cases();
            for (ElasticCase& at : all) {
                if (at.name != kind) continue;
                shake_nodes(at.model, 0.01f);
                return EndCase{std::make_shared<const Model>(std::move(at.model)), parts(3, {.noise = 0.5})};
            }
            return EndCase{};
        });
    return joined({scenarios, island_scenarios()});
}

bool ends_repeat() {
    const EndCase at{two_blocks({.place = {0, 0.005, 0}, .velocity = {0.5, -1.0, 0.2}}), parts(2)};
    const EndCase island{
        .model = several_stiff_blocks(), .parts = parts(6), .restitution = 0.5, .contacts = true};
    return velocities_after(at) == velocities_after(at) &&
           velocities_after(island) == velocities_after(island);
}

void run_end_programs() {
    use_programs({two_blocks({.place = {0, 0.005, 0}, .velocity = {0.5, -1.0, 0.2}}), {}});
    use_programs({.model = meeting_blocks(), .parts = {}, .restitution = 0.5, .contacts = true});
}

}  // namespace gelatin::test
