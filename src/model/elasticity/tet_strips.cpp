#include "model/elasticity/tet_strips.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numeric>

#include "model/elasticity/link_strip.h"
#include "model/elasticity/neo_hookean.h"
#include "model/model.h"
#include "model/shared_constants.h"
#include "model/spring_packing.h"

namespace gelatin {
namespace {

std::span<const std::uint32_t> entries_of(const NodeTets& tets, std::uint32_t node) {
    return std::span(tets.entries).subspan(tets.starts[node], tets.starts[node + 1] - tets.starts[node]);
}

// The steps' vertices. Calls set_tet(step, entry, order) for each that completes a tet, with `order` its
// other corners as they come.
template <class Step, class NodesOf, class SetTet>
std::vector<Step> make_strip(std::span<const std::uint32_t> entries, const NodesOf& nodes_of_tet,
                             const SetTet& set_tet) {
    std::vector<LinkTriangle> triangles;
    for (const std::uint32_t entry : entries) {
        const glm::uvec4 nodes = nodes_of_tet(entry / 4);
        const auto& opposite = kOppositeCorners[entry % 4];
        triangles.push_back({nodes[opposite[0]], nodes[opposite[1]], nodes[opposite[2]]});
    }
    std::vector<Step> steps;
    LinkTriangle last{};
    for (const StripStep& from : make_link_strip(triangles)) {
        last = {from.keeps_oldest ? last[0] : last[1], last[2], from.vertex};
        Step& step = steps.emplace_back();
        step.vertex = from.vertex | (from.keeps_oldest ? TetStrips::kKeepsOldest : 0u);
        step.tet = packing::kNone;
        if (from.triangle != StripStep::kNoTriangle) set_tet(step, entries[from.triangle], last);
    }
    return steps;
}

// Where `node` comes among the corners.
int corner_of(const glm::uvec4& corners, std::uint32_t node) {
    int k = 0;
    while (corners[k] != node) ++k;
    return k;
}

// Gram-Schmidt makes the gradients triangular. The z axis is opposed to that of x and y, for which
// counter-clockwise corners have a positive cc.
void set_gradients(const NeoHookeanTet& tet, const LinkTriangle& order, NeoHookeanStep& step) {
    const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
    const glm::uvec4 nodes = nodes_of(tet);
    const auto gradient = [&](std::uint32_t node) {
        return gradients[static_cast<std::size_t>(corner_of(nodes, node))];
    };
    const glm::dvec3 a = gradient(order[0]), b = gradient(order[1]), c = gradient(order[2]);
    const double aa = glm::length(a);
    const glm::dvec3 x = a / aa;
    const double ab = glm::dot(x, b), ac = glm::dot(x, c);
    const double bb = glm::length(b - ab * x);
    const glm::dvec3 y = (b - ab * x) / bb;
    step.aa = static_cast<float>(aa);
    step.ab = static_cast<float>(ab);
    step.bb = static_cast<float>(bb);
    step.ac = static_cast<float>(ac);
    step.bc = static_cast<float>(glm::dot(y, c));
    step.cc = static_cast<float>(-glm::dot(glm::cross(x, y), c));
    step.opening = step.mu * glm::vec4(-(a + b + c), 0.0);
}

template <class Step, class StripOf>
StripSlices<Step> pack(std::span<const std::uint32_t> rows, const StripOf& strip_of) {
    constexpr std::uint32_t kSlice = packing::kSlice;
    StripSlices<Step> packed{{0}, {}};
    Step none{};
    none.vertex = none.tet = packing::kNone;
    for (std::size_t first = 0; first < rows.size(); first += kSlice) {
        const std::size_t end = std::min(first + kSlice, rows.size());
        std::vector<std::vector<Step>> strips;
        std::size_t most = 0;
        for (std::size_t r = first; r < end; ++r) {
            strips.push_back(rows[r] == kNoNode ? std::vector<Step>() : strip_of(rows[r]));
            most = std::max(most, strips.back().size());
        }
        const std::uint32_t start = packed.slice_starts.back();
        packed.slice_starts.push_back(start + kSlice * static_cast<std::uint32_t>(most));
        packed.steps.resize(packed.slice_starts.back(), none);
        for (std::size_t r = 0; r < strips.size(); ++r) {
            for (std::size_t k = 0; k < strips[r].size(); ++k)
                packed.steps[start + kSlice * k + r] = strips[r][k];
        }
    }
    return packed;
}

std::vector<std::uint32_t> neo_hookean_tet_indices(const Model& model) {
    std::vector<std::uint32_t> indices(model.neo_hookean_tets.size());
    for (const ModelObject& object : model.objects) {
        const auto first = indices.begin() + object.neo_hookean_tets.first;
        std::iota(first, first + object.neo_hookean_tets.count, object.tets.first);
    }
    return indices;
}

}  // namespace

TetStrips::TetStrips(const Model& model, const NodeTets& node_tets)
    : model_(model), node_tets_(node_tets), indices_(neo_hookean_tet_indices(model)) {}

float TetStrips::modulus_of(std::uint32_t tet) const {
    return model_.volume_term.is_empty() ? 0.0f : model_.volume_term.tets[tet] * model_.tet_rests[tet].volume;
}

std::vector<NeoHookeanStep> TetStrips::neo_hookean(std::uint32_t node) const {
    if (!has_neo_hookean_tets(model_, node)) return {};
    const std::vector<NeoHookeanTet>& tets = model_.neo_hookean_tets;
    return make_strip<NeoHookeanStep>(
        entries_of(model_.neo_hookean_corners, node), [&](std::uint32_t t) { return nodes_of(tets[t]); },
        [&](NeoHookeanStep& step, std::uint32_t entry, const LinkTriangle& order) {
            const NeoHookeanTet& tet = tets[entry / 4];
            const float volume = tet.gradient_1.w;
            step.tet = indices_[entry / 4];
            step.mu = volume * tet.gradient_2.w;
            step.lambda = volume * tet.gradient_3.w;
            step.modulus = modulus_of(step.tet);
            step.volume = volume;
            set_gradients(tet, order, step);
        });
}

std::vector<VolumeStep> TetStrips::volumes(std::uint32_t node) const {
    if (model_.volume_term.is_empty()) return {};
    std::vector<std::uint32_t> entries;
    for (const std::uint32_t entry : entries_of(node_tets_, node)) {
        if (model_.volume_term.tets[entry / 4] != 0.0f) entries.push_back(entry);
    }
    return make_strip<VolumeStep>(
        entries, [&](std::uint32_t t) { return model_.tets[t]; },
        [&](VolumeStep& step, std::uint32_t entry, const LinkTriangle& order) {
            const glm::uvec4& tet = model_.tets[entry / 4];
            const float inverse = 1.0f / (6.0f * model_.tet_rests[entry / 4].volume);
            // Counter-clockwise as kOppositeCorners has it, or not.
            const auto& opposite = kOppositeCorners[entry % 4];
            const int first = corner_of({tet[opposite[0]], tet[opposite[1]], tet[opposite[2]], 0}, order[0]);
            const bool is_reversed = tet[opposite[(first + 1) % 3]] != order[1];
            step.tet = entry / 4;
            step.inverse_six_volumes = is_reversed ? -inverse : inverse;
            step.modulus = modulus_of(step.tet);
        });
}

StripSlices<NeoHookeanStep> pack_neo_hookean_strips(const TetStrips& strips,
                                                    std::span<const std::uint32_t> rows) {
    return pack<NeoHookeanStep>(rows, [&](std::uint32_t node) { return strips.neo_hookean(node); });
}

StripSlices<VolumeStep> pack_volume_strips(const TetStrips& strips, std::span<const std::uint32_t> rows) {
    return pack<VolumeStep>(rows, [&](std::uint32_t node) { return strips.volumes(node); });
}

}  // namespace gelatin
