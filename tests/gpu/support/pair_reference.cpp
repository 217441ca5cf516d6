#include "gpu/support/pair_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

#include "cpu/contact/kept_distances.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/find_pairs.h"
#include "gpu/support/scenario.h"
#include "model/corners.h"
#include "model/shared_constants.h"
#include "support/converted.h"

namespace gelatin::test {
namespace {

namespace tuning = cpu::tuning;
using Key = std::tuple<bool, std::uint32_t, std::uint32_t>;
using Pairs = std::map<Key, cpu::NearPair<double>>;

constexpr double kBand = 2e-6;  // [m]; what rounding makes of a few meters

Key pair_key(const NearPair& pair) {
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
          velocities_(converted<double>(model_.velocities)) {
        for (std::uint32_t o = 0; at.own && o < model_.body_count(); ++o)
            if (surface_->is_convex[o] != 0) add_lost(o);
        leaf_of_face_.resize(model_.faces.size());
        for (const std::uint32_t leaf : model_.face_trees.levels[0])
            for (std::uint32_t k = 0; k < model_.face_trees.nodes[leaf].item_count; ++k)
                leaf_of_face_[model_.face_trees.nodes[leaf].first_item + k] = leaf;
    }

    const ContactSurface& surface() const { return *surface_; }
    const std::vector<glm::dvec4>& from() const { return from_; }
    bool has_lost(std::uint32_t body) const { return lost_.contains(body); }
    double fastest() const {
        cpu::FindPairs<double> find(case_.model, surface_, case_.own);
        find.begin({from_, to_});
        return find.fastest_approach({from_, to_});
    }

    /// With slacks and boxes that are larger by so much [m]. Of bodies that have lost some distances, those
    /// that the device lists.
    Pairs find(double band) const {
        // Where all bodies count as not convex, all of their own pairs are listed.
        auto surface = std::make_shared<ContactSurface>(*surface_);
        std::fill(surface->is_convex.begin(), surface->is_convex.end(), std::uint8_t(0));
        const double thinnest = *std::min_element(surface->thicknesses.begin(), surface->thicknesses.end());
        cpu::FindPairs<double> find(case_.model, surface, case_.own);
        cpu::Paths<double> paths = this->paths();
        paths.slack += band / thinnest;
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
        const cpu::Paths<double> paths = this->paths();
        find.begin(paths);
        find.run(paths);
        Pairs pairs;
        for (const cpu::NearPair<double>& near : find.pairs())
            pairs.emplace(Key{near.pair.is_edges(), near.pair.first, near.pair.second}, near);
        return pairs;
    }

private:
    cpu::Paths<double> paths() const {
        return {.from = from_,
                .to = to_,
                .velocities = velocities_,
                .step = kPairStep / (case_.is_shortest ? 256.0 : 1.0)};
    }
    void add_lost(std::uint32_t body) {
        cpu::KeptDistances<double> kept(case_.model, *surface_);
        for (const cpu::LostTets& tets : kept.find_lost_tets(body, tuning::kNearly, from_, to_))
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
    std::vector<glm::dvec4> from_, to_, velocities_;
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

void compare_paths(const PairCase& at, const FoundPairs& found, PairErrors& errors) {
    const std::vector<glm::vec4> begins = begins_of(at);
    for (std::size_t o = 0; o < at.model->objects.size(); ++o) {
        const Range& nodes = at.model->objects[o].nodes;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 d(at.predicted[n]);
            sum += d;
            errors.add(glm::distance(glm::dvec3(found.path_ends[n]), glm::dvec3(begins[n]) + d), kBand);
            errors.require(found.path_ends[n].w == begins[n].w);
        }
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

// Of nearest points. Where two edges, or those of a face, are nearly parallel, the direction between them has
// an error by the sine of their angle, as far as they count as not parallel.
double bound_of(const cpu::ContactPair& pair, const std::vector<glm::dvec4>& positions) {
    const auto at = [&](std::size_t k) { return glm::dvec3(positions[pair.nodes[k]]); };
    const glm::dvec3 u = pair.is_edges() ? at(1) - at(0) : at(2) - at(1), v = at(3) - at(2);
    double extent = 0.0;
    for (std::size_t k = 1; k < 4; ++k) extent = std::max(extent, glm::distance(at(0), at(k)));
    const double least = std::sqrt(predicates::kParallelRounding * 0x1p-23);
    const double sine = glm::length(glm::cross(u, v)) / (glm::length(u) * glm::length(v));
    return kBand + 8.0 * 0x1p-23 * extent / std::max(sine, least);
}

// How near, and where: the vector between nearest points is unique, weights need not be. Of places that are
// equally near by rounding any is right.
void compare_pair(const NearPair& actual, const cpu::NearPair<double>& expected,
                  const PairReference& reference, PairErrors& errors) {
    const auto& nodes = expected.pair.nodes;
    errors.require(actual.node_0 == nodes[0] && actual.node_1 == nodes[1] && actual.node_2 == nodes[2] &&
                   actual.node_3 == nodes[3]);
    errors.require(actual.object == expected.pair.object && actual.other == expected.pair.other);
    const double gap = static_cast<double>(actual.normal.w);
    const glm::dvec3 normal(actual.normal), apart = expected.gap * expected.normal;
    const double bound = bound_of(expected.pair, reference.from());
    errors.add(gap - expected.gap, bound);
    const double bound_apart = bound + std::sqrt(8.0 * 0x1p-23) * expected.gap;
    errors.add(glm::distance(gap * normal, apart), bound_apart);
    errors.add(gap > 0.0 ? glm::length(normal) - 1.0 : 0.0, 1e-5);
    glm::dvec3 difference(0.0);  // of what is between the nearest points
    double sides[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t side = expected.pair.side_of(k);
        const auto weight = static_cast<double>(actual.weights[static_cast<int>(k)]);
        errors.add(weight - 0.5, 0.5 + 1e-6);
        sides[side] += weight;
        const double more = weight - expected.weights[static_cast<int>(k)];
        difference += (side == 0 ? -more : more) * glm::dvec3(reference.from()[nodes[k]]);
    }
    for (const double side : sides) errors.add(side - 1.0, 1e-5);
    errors.add(glm::length(difference), bound_apart);
    errors.add(static_cast<double>(actual.reach - expected.pair.reach), 1e-7);
    if (expected.gap < 100.0 * bound) return;  // of others the normal is not sure
    const double rounding = expected.rounding * 0x1p29;
    errors.add(static_cast<double>(actual.rounding) - rounding, 0.01 * rounding);
}

// All that certainly are near, and none that certainly are not.
void compare_pairs(const FoundPairs& found, const PairReference& reference, PairErrors& errors) {
    const Pairs certain = reference.find(-kBand), possible = reference.find(kBand);
    Pairs actual;
    for (const NearPair& pair : found.listed()) {
        const auto at = possible.find(pair_key(pair));
        errors.require(at != possible.end());
        if (at == possible.end()) return;
        errors.require(actual.emplace(pair_key(pair), at->second).second);
        compare_pair(pair, at->second, reference, errors);
    }
    for (const auto& [key, near] : certain) errors.require(actual.contains(key));
    for (const auto& [key, near] : reference.find_exactly()) {
        const bool is_certain = certain.contains(key) || near.pair.is_own();
        errors.require(actual.contains(key) || !is_certain);
    }
}

// A body may have self-contact if it is not convex, or has lost distances.
void compare_own(const PairCase& at, const FoundPairs& found, const PairReference& reference,
                 PairErrors& errors) {
    for (std::uint32_t o = 0; at.own && o < at.model->body_count(); ++o) {
        const bool has_slot = std::any_of(found.slots.begin(), found.slots.begin() + found.counts.slots,
                                          [&](const PairSlot& s) { return s.object == o && s.other == o; });
        errors.require(has_slot == (reference.surface().is_convex[o] == 0 || reference.has_lost(o)));
    }
}

}  // namespace

double error_of_slots(const FoundPairs& found) {
    PairErrors errors;
    compare_slots(found, errors);
    return errors.worst();
}

double error_of_pairs(const PairCase& at, const FoundPairs& found) {
    const PairReference reference(at, found);
    PairErrors errors;
    compare_paths(at, found, errors);
    const double fastest = reference.fastest();
    errors.add(static_cast<double>(found.counts.fastest) - fastest, 1e-4 * fastest + 1e-4);
    if (errors.worst() <= 1.0) compare_slots(found, errors);
    if (errors.worst() <= 1.0) compare_own(at, found, reference, errors);
    if (errors.worst() <= 1.0) compare_pairs(found, reference, errors);
    return errors.worst();
}

}  // namespace gelatin::test
