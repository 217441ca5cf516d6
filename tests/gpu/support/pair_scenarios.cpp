#include "gpu/support/pair_scenarios.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "cpu/contact/kept_distances.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/find_pairs.h"
#include "gpu/support/pairs_on_gpu.h"
#include "model/corners.h"
#include "support/contact_scenes.h"
#include "support/converted.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

namespace tuning = cpu::tuning;
using Key = std::tuple<bool, std::uint32_t, std::uint32_t>;
using Pairs = std::map<Key, cpu::NearPair<double>>;

constexpr double kBand = 2e-6;  // [m]; what rounding makes of a few meters

Key key_of(const NearPair& pair) {
    return {pair.is_edges != 0, pair.first, pair.second};
}

// Of paths as the device has them.
class PairReference {
public:
    PairReference(const PairCase& at, const FoundPairs& found)
        : case_(at),
          model_(*at.model),
          surface_(std::make_shared<ContactSurface>(make_contact_surface(model_, {}))),
          from_(converted<double>(begins_of(at))),
          to_(converted<double>(found.path_ends)),
          slacks_(found.slacks.begin(), found.slacks.end()) {
        for (std::uint32_t o = 0; at.own && o < model_.body_count(); ++o)
            if (surface_->is_convex[o] != 0) add_lost(o);
        leaf_of_face_.resize(model_.faces.size());
        for (const std::uint32_t leaf : model_.face_trees.levels[0])
            for (std::uint32_t k = 0; k < model_.face_trees.nodes[leaf].item_count; ++k)
                leaf_of_face_[model_.face_trees.nodes[leaf].first_item + k] = leaf;
    }

    const ContactSurface& surface() const { return *surface_; }
    const std::vector<glm::dvec4>& from() const { return from_; }
    double slack(std::uint32_t object) const { return slacks_[object]; }
    bool has_lost(std::uint32_t body) const { return lost_.contains(body); }
    double fastest() const {
        cpu::FindPairs<double> find(case_.model, surface_, case_.own);
        find.begin({from_, to_, slacks_});
        return find.fastest_approach({from_, to_, slacks_});
    }

    /// With slacks and boxes that are larger by so much [m]. Of bodies that have lost some distances, those
    /// that the device lists.
    Pairs find(double band) const {
        // Where all bodies count as not convex, all of their own pairs are listed.
        auto surface = std::make_shared<ContactSurface>(*surface_);
        std::fill(surface->is_convex.begin(), surface->is_convex.end(), std::uint8_t(0));
        std::vector<double> slacks = slacks_;
        for (double& slack : slacks) slack += band;
        cpu::FindPairs<double> find(case_.model, surface, case_.own);
        const cpu::Paths<double> paths{from_, to_, slacks};
        find.begin(paths);
        find.run(paths);
        Pairs pairs;
        for (const cpu::NearPair<double>& near : find.pairs())
            if (is_listed(near.pair, band))
                pairs.emplace(Key{near.pair.is_edges(), near.pair.first, near.pair.second}, near);
        return pairs;
    }
    /// As it is.
    Pairs find_exactly() const {
        cpu::FindPairs<double> find(case_.model, surface_, case_.own);
        const cpu::Paths<double> paths{from_, to_, slacks_};
        find.begin(paths);
        find.run(paths);
        Pairs pairs;
        for (const cpu::NearPair<double>& near : find.pairs())
            pairs.emplace(Key{near.pair.is_edges(), near.pair.first, near.pair.second}, near);
        return pairs;
    }

private:
    void add_lost(std::uint32_t body) {
        cpu::KeptDistances<double> kept(case_.model, *surface_);
        for (const cpu::LostTets& tets : kept.find_lost_tets(body, tuning::kKept, from_, to_))
            lost_[body].add(kept.box_of(body, tets));
    }
    bool is_listed(const cpu::ContactPair& pair, double band) const {
        if (!pair.is_own() || surface_->is_convex[pair.object] == 0) return true;
        if (!lost_.contains(pair.object)) return false;
        cpu::AxisBox<double> lost = lost_.at(pair.object),
                             lines = rest_box(leaf_of(pair.is_edges(), pair.first));
        lines.add(rest_box(pair.is_edges() ? leaf_of(true, pair.second) : leaf_of_face_[pair.second]));
        lost.min -= glm::dvec3(band);
        lost.max += glm::dvec3(band);
        return meet(lost, lines);
    }
    std::uint32_t leaf_of(bool is_edge, std::uint32_t number) const {
        const SurfaceParts& parts = model_.surface_parts;
        std::uint32_t place = number;
        if (!is_edge) {
            const auto found = std::find(parts.nodes.begin(), parts.nodes.end(), number);
            place = static_cast<std::uint32_t>(found - parts.nodes.begin());
        }
        const auto behind = std::upper_bound(
            parts.face_starts.begin(), parts.face_starts.end(), place,
            [&](std::uint32_t p, const glm::uvec2& first) { return p < (is_edge ? first.y : first.x); });
        return leaf_of_face_[static_cast<std::size_t>(behind - parts.face_starts.begin()) - 1];
    }
    cpu::AxisBox<double> rest_box(std::uint32_t leaf) const {
        const TreeNode& node = model_.face_trees.nodes[leaf];
        cpu::AxisBox<double> box;
        for (std::uint32_t f = node.first_item; f < node.first_item + node.item_count; ++f)
            for (const std::uint32_t n : corners_of(model_.faces[f]))
                box.add(glm::dvec3(model_.positions[n]));
        return box;
    }

    const PairCase& case_;
    const Model& model_;
    std::shared_ptr<ContactSurface> surface_;
    std::vector<glm::dvec4> from_, to_;
    std::vector<double> slacks_;
    std::map<std::uint32_t, cpu::AxisBox<double>> lost_;  // at the start, by body
    std::vector<std::uint32_t> leaf_of_face_;
};

class PairErrors {
public:
    void add(double error, double scale) {
        worst_ = std::isfinite(error) ? std::max(worst_, std::abs(error) / scale)
                                      : std::numeric_limits<double>::infinity();
    }
    void require(bool is_right) { worst_ = std::max(worst_, error_if(!is_right)); }
    double worst() const { return worst_; }

private:
    double worst_ = 0.0;
};

void compare_paths(const PairCase& at, const FoundPairs& found, const ContactSurface& surface,
                   PairErrors& errors) {
    const std::vector<glm::vec4> begins = begins_of(at);
    for (std::size_t o = 0; o < at.model->objects.size(); ++o) {
        const Range& nodes = at.model->objects[o].nodes;
        double longest = 0.0;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 d(at.predicted[n]);
            longest = std::max(longest, glm::length(d));
            sum += d;
            errors.add(glm::distance(glm::dvec3(found.path_ends[n]), glm::dvec3(begins[n]) + d), kBand);
            errors.require(found.path_ends[n].w == begins[n].w);
        }
        const double thickness = surface.thicknesses[o];
        const double slack = tuning::kSlackOfThickness * thickness +
                             tuning::kSlackOfMotion * std::min(longest, tuning::kFastest * thickness);
        errors.add(static_cast<double>(found.slacks[o]) - slack, 1e-5 * slack + 1e-12);
        errors.add(glm::distance(glm::dvec3(found.motions[o]), sum / double(nodes.count)), kBand);
    }
}

// Slots by object and other, ascending; in each its pairs.
void compare_slots(const FoundPairs& found, PairErrors& errors) {
    std::uint32_t pair = 0, slot = 0;
    for (std::size_t o = 0; o + 1 < found.slot_starts.size(); ++o) {
        errors.require(found.slot_starts[o] == slot);
        for (; slot < found.slot_starts[o + 1]; ++slot) {
            const PairSlot& at = found.slots[slot];
            const bool is_first = slot == found.slot_starts[o];
            errors.require(at.object == o && (is_first || found.slots[slot - 1].other < at.other));
            errors.require(at.first_pair == pair && at.pair_end >= pair && at.pair_end <= found.counts.pairs);
            if (errors.worst() > 1.0) return;
            for (; pair < at.pair_end; ++pair) {
                const NearPair& near = found.pairs[pair];
                errors.require(near.slot == slot && near.object == at.object && near.other == at.other);
            }
        }
    }
    errors.require(slot == found.counts.slots && pair == found.counts.pairs);
}

// How near, and where: the vector between nearest points is unique, weights need not be.
void compare_pair(const NearPair& actual, const cpu::NearPair<double>& expected,
                  const PairReference& reference, PairErrors& errors) {
    const auto& nodes = expected.pair.nodes;
    errors.require(actual.node_0 == nodes[0] && actual.node_1 == nodes[1] && actual.node_2 == nodes[2] &&
                   actual.node_3 == nodes[3]);
    errors.require(actual.object == expected.pair.object && actual.other == expected.pair.other);
    const double gap = static_cast<double>(actual.normal.w);
    const glm::dvec3 normal(actual.normal), apart = expected.gap * expected.normal;
    errors.add(gap - expected.gap, kBand);
    errors.add(glm::distance(gap * normal, apart), kBand);
    errors.add(gap > 0.0 ? glm::length(normal) - 1.0 : 0.0, 1e-5);
    glm::dvec3 between(0.0);
    double sides[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t side = expected.pair.side_of(k);
        const auto weight = static_cast<double>(actual.weights[static_cast<int>(k)]);
        errors.require(weight >= 0.0 && weight <= 1.0);
        sides[side] += weight;
        between += (side == 0 ? -weight : weight) * glm::dvec3(reference.from()[nodes[k]]);
    }
    for (const double side : sides) errors.add(side - 1.0, 1e-5);
    errors.add(glm::distance(between, apart), kBand);
    errors.add(static_cast<double>(actual.reach - expected.pair.reach), 1e-7);
    if (expected.gap < 1e-3) return;  // of others the normal is not sure
    const double rounding = expected.rounding * 0x1p29;
    errors.add(static_cast<double>(actual.rounding) - rounding, 0.01 * rounding);
}

// All that certainly are near, and none that certainly are not.
void compare_pairs(const FoundPairs& found, const PairReference& reference, PairErrors& errors) {
    const Pairs certain = reference.find(-kBand), possible = reference.find(kBand);
    Pairs actual;
    for (const NearPair& pair : found.listed()) {
        const auto at = possible.find(key_of(pair));
        errors.require(at != possible.end());
        if (at == possible.end()) return;
        errors.require(actual.emplace(key_of(pair), at->second).second);
        compare_pair(pair, at->second, reference, errors);
    }
    for (const auto& [key, near] : certain) errors.require(actual.contains(key));
    for (const auto& [key, near] : reference.find_exactly()) {
        const bool is_certain = certain.contains(key) || near.pair.is_own();
        errors.require(actual.contains(key) || !is_certain);
    }
}

double pair_error(const PairCase& at, std::size_t least) {
    PairsOnGpu gpu(at);
    const FoundPairs found = gpu.run();
    const PairReference reference(at, found);
    PairErrors errors;
    errors.require(found.counts.is_full == 0 && found.counts.has_lost == 0 && found.counts.pairs >= least);
    compare_paths(at, found, reference.surface(), errors);
    const double fastest = reference.fastest();
    errors.add(static_cast<double>(found.counts.fastest) - fastest, 1e-4 * fastest + 1e-4);
    errors.require(gpu.is_untouched_behind_the_end());
    if (errors.worst() <= 1.0) compare_slots(found, errors);
    if (errors.worst() <= 1.0) compare_pairs(found, reference, errors);
    for (std::uint32_t o = 0; at.own && o < at.model->body_count(); ++o) {
        const bool has_slot = std::any_of(found.slots.begin(), found.slots.begin() + found.counts.slots,
                                          [&](const PairSlot& s) { return s.object == o && s.other == o; });
        errors.require(has_slot == (reference.surface().is_convex[o] == 0 || reference.has_lost(o)));
    }
    return errors.worst();
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
    colliders[1].position = {0.15, 0.05, 0.05};
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
        blocks.push_back({.place = glm::dvec3(k % 8, k / 8 % 8, k / 64) * 0.103 + random.point(0.002),
                          .velocity = random.point(speed),
                          .cells = count > 20 ? glm::ivec3(1) : kCells,
                          .size = kSmall});
    const auto model = make_blocks(blocks);
    return {model, motions_of(*model, 1.0 / 240.0, 1e-4)};
}

// A convex body in parts of which everything was pressed together; another one beside it.
PairCase pressed(bool everywhere, bool on_the_way) {
    const auto model = make_blocks({{.cells = {6, 4, 3}, .size = {0.6, 0.4, 0.3}},
                                    {.place = {0.605, 0, 0}, .cells = kCells, .size = kSmall}});
    PairCase at{model, motions_of(*model, 0.0, 1e-4)};
    const Range& nodes = model->objects[0].nodes;
    at.moved.resize(model->node_count(), glm::vec3(0.0f));
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::vec3 x(model->positions[n]);
        if (!everywhere && x.x > 0.25f) continue;
        (on_the_way ? at.predicted : at.moved)[n] += glm::vec3(0.0f, (0.05f - 1.0f) * x.y, 0.0f);
    }
    return at;
}

// All rotates at once, and nothing is deformed: nothing may meet itself.
PairCase rotated() {
    PairCase at = two_blocks();
    const float c = std::cos(1.1f), s = std::sin(1.1f);
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
    PairErrors errors;
    errors.require(found.counts.fastest > static_cast<float>(tuning::kFastest));
    errors.require(found.counts.slots > 0 && found.counts.searches == 0 && found.counts.pairs == 0);
    compare_slots(found, errors);
    at.is_shortest = true;
    return std::max(errors.worst(), pair_error(at, 1));
}

// A list for which there is no place, the ones after it, and then all of them.
double full_error() {
    const PairCase at = two_blocks();
    PairsOnGpu gpu(at);
    const FoundPairs all = gpu.run();
    const gpu::PairCapacity enough = gpu.capacity();
    PairErrors errors;
    for (int list = 0; list < 4; ++list) {
        gpu::PairCapacity few = enough;
        std::size_t* const capacities[] = {&few.slots, &few.searches, &few.leaf_pairs, &few.pairs};
        const std::uint32_t counts[] = {all.counts.slots, all.counts.searches, all.counts.leaf_pairs,
                                        all.counts.pairs};
        *capacities[list] = counts[list] - 1;
        PairsOnGpu limited(at);
        limited.limit(few);
        const PairCounts found = limited.run().counts;
        const std::uint32_t actual[] = {found.slots, found.searches, found.leaf_pairs, found.pairs};
        errors.require(found.is_full != 0 && limited.is_untouched_behind_the_end());
        for (int k = 0; k < 4; ++k) errors.require(actual[k] == (k <= list ? counts[k] : 0));
        *capacities[list] = counts[list];
        limited.limit(few);
        errors.require(limited.run().counts.is_full == 0);
    }
    return errors.worst();
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

// What the guard asks for: other paths of some nodes; what has lost distances where they end goes on from
// what had.
double guarded_error() {
    const PairCase at = pressed(false, false);
    PairsOnGpu gpu(at);
    FoundPairs found = gpu.run();
    PairErrors errors;
    std::vector<glm::vec4> ends = found.path_ends;
    errors.require(!gpu.find_lost(ends));
    const Range& nodes = at.model->objects[0].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); n += 5) ends[n].y += 0.02f;
    gpu.set_path_ends(ends);
    const auto own_count = [](const FoundPairs& some) {
        const std::vector<NearPair> pairs = some.listed();
        return std::count_if(pairs.begin(), pairs.end(),
                             [](const NearPair& near) { return near.object == near.other; });
    };
    FoundPairs again = gpu.run(1);
    errors.require(again.path_ends == ends && again.slacks == found.slacks && again.counts.pairs > 0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        if (at.model->positions[n].x > 0.45f) ends[n].y *= 0.05f;
    errors.require(gpu.find_lost(ends));
    const FoundPairs more = gpu.run(2);
    errors.require(more.counts.has_lost == 0 && own_count(more) > own_count(again));
    errors.require(!gpu.find_lost(ends));
    return errors.worst();
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
            compared("notched", notched, 1000),
            compared("dozen", [] { return crowd(12, 0.3); }),
            compared("dozen_fast", [] { return crowd(12, 20.0); }),
            compared(
                "many", [] { return crowd(300, 1.0); }, 5000),
            compared("pressed", [] { return pressed(true, false); }),
            compared("pressed_in_a_place", [] { return pressed(false, false); }),
            compared("pressed_on_the_way", [] { return pressed(false, true); }),
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
    const PairCase at = pressed(false, false);
    PairsOnGpu gpu(at);
    gpu.find_lost(gpu.run().path_ends);
}

}  // namespace gelatin::test
