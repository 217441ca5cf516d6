#include "gpu/support/pair_scenarios.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "cpu/contact/tuning.h"
#include "gpu/support/pair_reference.h"
#include "gpu/support/pairs_on_gpu.h"
#include "support/contact_scenes.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

namespace tuning = cpu::tuning;

double pair_error(const PairCase& at, std::size_t least) {
    const FoundPairs found = PairsOnGpu(at).run();
    return std::max(error_of_pairs(at, found),
                    error_if(found.counts.pairs < least || found.counts.has_lost != 0));
}

// By velocities and random numbers.
std::vector<glm::vec3> motions_of(const Model& model, double time, double shake) {
    RandomMaker random(3);
    std::vector<glm::vec3> moved;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        moved.push_back(glm::vec3(time * glm::dvec3(model.velocities[n]) + random.point(shake)));
    return moved;
}

const glm::dvec3 kSmall(0.1);
const glm::ivec3 kCells(2, 2, 2);

PairCase two_blocks() {
    const auto model = make_blocks(
        {{.velocity = {1, 0, 0}, .cells = {3, 3, 3}, .size = kSmall},
         {.place = {0.104, 0.01, 0.02}, .velocity = {-0.5, 0.2, 0}, .cells = kCells, .size = kSmall}});
    return {model, motions_of(*model, 1.0 / 240.0, 1e-3)};
}

PairCase three_blocks(double time) {
    const auto model =
        make_blocks({{.velocity = {0, 20, 0}, .cells = kCells, .size = kSmall},
                     {.place = {0.104, 0.01, 0.02}, .velocity = {0, 20, 0}, .cells = kCells, .size = kSmall},
                     {.place = {0.05, 0.12, 0}, .cells = kCells, .size = kSmall}});
    return {model, motions_of(*model, time, 0.0)};
}

// On the surface of a collider, which moves.
PairCase on_a_collider() {
    std::vector<ColliderDescription> colliders(2);
    colliders[0].shape = Shape(BoxShape{{0.4, 0.1, 0.4}});
    colliders[0].position = {0.05, -0.0505, 0.05};
    colliders[1].shape = Shape(BoxShape{{0.1, 0.1, 0.1}});
    colliders[1].position = {0.1505, 0.049, 0.05};  // and in each other
    const auto model = make_blocks({{.velocity = {0.1, -0.3, 0}, .cells = {3, 2, 3}, .size = kSmall}},
                                   {0, -10, 0}, colliders);
    PairCase at{model, motions_of(*model, 1.0 / 240.0, 1e-4)};
    for (std::size_t o = model->body_count(); o < model->objects.size(); ++o)
        for (std::uint32_t n = model->objects[o].nodes.first; n < model->objects[o].nodes.end(); ++n)
            at.predicted[n] = {0.002f, 0.0f, o == model->body_count() ? 0.0f : 0.001f};
    return at;
}

// A body with a notch, whose sides come near each other.
PairCase notched() {
    TetMesh mesh = without(make_block({6, 4, 3}, {0.6, 0.4, 0.3}),
                           [](const glm::dvec3& p) { return p.x > 0.2 && p.x < 0.4 && p.y > 0.1; });
    const auto model = std::make_shared<const Model>(make_model(make_body(mesh)));
    PairCase at{model, motions_of(*model, 0.0, 1e-3)};
    for (const glm::vec4& x : model->positions) {
        const float side = x.x < 0.3f ? 1.0f : -1.0f;
        at.moved.emplace_back(x.y > 0.15f ? side * 0.095f : 0.0f, 0.0f, 0.0f);
    }
    return at;
}

PairCase crowd(int count, double speed) {
    RandomMaker random(5);
    std::vector<Block> blocks;
    for (int k = 0; k < count; ++k)
        blocks.push_back({.place = glm::dvec3(k % 8, k / 8 % 8, 2 * (k / 64)) * 0.103 + random.point(0.002),
                          .velocity = random.point(speed),
                          .cells = count > 20 ? glm::ivec3(1) : kCells,
                          .size = kSmall});
    const auto model = make_blocks(blocks);
    return {model, motions_of(*model, 1.0 / 240.0, 1e-4)};
}

// A convex body, or a part of it, is pressed flat where the part begins, or ends; another one is beside it.
PairCase pressed(bool everywhere, bool at_first, bool at_last) {
    const auto model = make_blocks({{.cells = {6, 4, 3}, .size = {0.6, 0.4, 0.3}},
                                    {.place = {0.605, 0, 0}, .cells = kCells, .size = kSmall}});
    PairCase at{model, motions_of(*model, 0.0, 1e-4)};
    const Range& nodes = model->objects[0].nodes;
    at.moved.resize(model->node_count(), glm::vec3(0.0f));
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::vec3 x(model->positions[n]), down(0.0f, -0.95f * x.y, 0.0f);
        if (!everywhere && x.x > 0.25f) continue;
        if (at_first) at.moved[n] = down;
        if (at_first != at_last) at.predicted[n] += at_last ? down : -down;
    }
    return at;
}

// A plate of which one end is pressed flat. What is left of its thickness at the other end is enough to lose
// nothing there, though both sides are near each other.
PairCase pressed_plate() {
    const auto model = make_blocks({{.cells = {8, 1, 3}, .size = {0.8, 0.04, 0.3}}});
    PairCase at{model, motions_of(*model, 0.0, 1e-4)};
    at.moved.resize(model->node_count(), glm::vec3(0.0f));
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        const glm::vec3 x(model->positions[n]);
        if (x.x < 0.25f || x.x > 0.55f) at.moved[n].y = (x.x < 0.25f ? -0.95f : -0.8f) * x.y;
    }
    return at;
}

// All rotates at once, and nothing is deformed: there is no self-contact.
PairCase rotated() {
    PairCase at = two_blocks();
    const float c = std::cos(2.5f), s = std::sin(2.5f);
    for (std::uint32_t n = 0; n < at.model->node_count(); ++n) {
        const glm::vec3 x(at.model->positions[n]);
        at.moved.push_back(glm::vec3(c * x.x - s * x.y, s * x.x + c * x.y, x.z) - x);
        at.predicted[n] = glm::vec3(0.001f * float(n % 3), 0.01f, 0.0f);
    }
    return at;
}

// Objects go so far beside each other that the part is halved, if it may be.
double fast_error() {
    PairCase at = three_blocks(0.5);
    const FoundPairs found = PairsOnGpu(at).run();
    const bool is_halved = found.counts.fastest > static_cast<float>(tuning::kFastest) &&
                           found.counts.slots > 0 && found.counts.searches == 0 && found.counts.pairs == 0;
    at.is_shortest = true;
    return std::max({error_if(!is_halved), error_of_slots(found), pair_error(at, 1)});
}

// A list for which there is no place, the ones after it, and then all of them.
double full_error() {
    const PairCase at = two_blocks();
    PairsOnGpu gpu(at);
    const FoundPairs all = gpu.run();
    const gpu::PairCapacity enough = gpu.capacity();
    bool is_right = true;
    for (int list = 0; list < 4; ++list) {
        gpu::PairCapacity few = enough;
        std::size_t* const capacities[] = {&few.slots, &few.searches, &few.leaf_pairs, &few.pairs};
        const std::uint32_t counts[] = {all.counts.slots, all.counts.searches, all.counts.leaf_pairs,
                                        all.counts.pairs};
        *capacities[list] = counts[list] - 1;
        PairsOnGpu limited(at);
        limited.limit(few);
        const PairCounts found = limited.run_once().counts;
        const std::uint32_t actual[] = {found.slots, found.searches, found.leaf_pairs, found.pairs};
        is_right = is_right && found.is_full != 0 && limited.is_untouched_behind_the_end();
        for (int k = 0; k < 4; ++k) is_right = is_right && actual[k] == (k <= list ? counts[k] : 0);
        *capacities[list] = counts[list];
        limited.limit(few);
        is_right = is_right && limited.run_once().counts.is_full == 0;
    }
    return error_if(!is_right);
}

// A try that is given up writes nothing.
double given_up_error() {
    const PairCase at = two_blocks();
    PairsOnGpu gpu(at);
    const FoundPairs before = gpu.run();
    gpu.set_path_ends(begins_of(at));
    const FoundPairs after = gpu.give_up();
    return error_if(after.path_ends != begins_of(at) || after.counts.pairs != before.counts.pairs ||
                    after.motions != before.motions);
}

// What is calm is expected to go on by its velocities, which are those of `at`, and not to fall.
double calm_error(const PairCase& at) {
    PairCase calm = at;
    calm.is_calm = true;
    const FoundPairs found = PairsOnGpu(calm).run();
    double worst = 0.0;
    for (std::size_t n = 0; n < found.path_ends.size(); ++n) {
        const glm::dvec3 velocity(at.model->velocities[n]);
        const glm::dvec3 end = glm::dvec3(begins_of(at)[n]) + kPairStep * velocity;
        worst = std::max(worst, glm::distance(glm::dvec3(found.path_ends[n]), end));
    }
    return worst / 1e-6;
}

// What the guard asks for: other paths of some nodes; what has lost distances where they end goes on from
// what had.
double guarded_error() {
    const PairCase at = pressed(false, true, true);
    PairsOnGpu gpu(at);
    const FoundPairs found = gpu.run();
    std::vector<glm::vec4> ends = found.path_ends;
    bool is_right = !gpu.find_lost(ends);
    const Range& nodes = at.model->objects[0].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); n += 5) ends[n].y += 0.02f;
    gpu.set_path_ends(ends);
    const auto own_count = [](const FoundPairs& some) {
        const std::vector<NearPair> pairs = some.listed();
        return std::count_if(pairs.begin(), pairs.end(),
                             [](const NearPair& near) { return near.object == near.other; });
    };
    const FoundPairs again = gpu.run(1);
    is_right = is_right && again.path_ends == ends && own_count(again) > 0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        if (at.model->positions[n].x > 0.45f) ends[n].y *= 0.05f;
    is_right = is_right && gpu.find_lost(ends);
    gpu.set_path_ends(ends);
    const FoundPairs more = gpu.run(2);
    is_right = is_right && more.counts.has_lost == 0 && own_count(more) > own_count(again);
    return error_if(!is_right || gpu.find_lost(ends));
}

}  // namespace

Scenarios pair_scenarios() {
    const auto compared = [](const char* name, auto make, std::size_t least = 1) {
        return Scenario{name, [=] { return pair_error(make(), least); }};
    };
    return {compared("two_blocks", two_blocks),
            compared(
                "without_own",
                [] {
                    PairCase at = notched();
                    at.own = false;
                    return at;
                },
                0),
            compared("three_blocks_fast", [] { return three_blocks(1.0 / 240.0); }),
            compared("on_a_collider", on_a_collider),
            compared("notched", notched, 100),
            compared("dozen", [] { return crowd(12, 0.3); }),
            compared("dozen_fast", [] { return crowd(12, 20.0); }),
            compared(
                "many", [] { return crowd(270, 1.0); }, 5000),
            {"calm_bodies_go_on", [] { return calm_error(crowd(12, 20.0)); }},
            compared("pressed", [] { return pressed(true, true, true); }),
            compared("pressed_in_a_place", [] { return pressed(false, true, true); }),
            compared("pressed_plate", [] { return pressed_plate(); }),
            compared("pressed_at_first", [] { return pressed(false, true, false); }),
            compared("pressed_at_last", [] { return pressed(false, false, true); }),
            compared("rotated", rotated),
            {"too_fast", fast_error},
            {"full", full_error},
            {"given_up", given_up_error},
            {"guarded", guarded_error}};
}

bool pairs_repeat() {
    const PairCase at = crowd(12, 1.0);
    const auto bits = [&] {
        const std::vector<NearPair> pairs = PairsOnGpu(at).run().listed();
        std::vector<std::uint32_t> words(pairs.size() * sizeof(NearPair) / 4);
        std::memcpy(words.data(), pairs.data(), 4 * words.size());
        return words;
    };
    const std::vector<std::uint32_t> first = bits();
    return !first.empty() && bits() == first;
}

void run_find_pairs() {
    const PairCase at = pressed(false, true, true);
    PairsOnGpu gpu(at);
    gpu.find_lost(gpu.run().path_ends);
}

}  // namespace gelatin::test
