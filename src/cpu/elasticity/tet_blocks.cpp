#include "cpu/elasticity/tet_blocks.h"

#include <cmath>

#include "cpu/elasticity/link_strip.h"
#include "model/elasticity/neo_hookean.h"

namespace gelatin::cpu {
namespace {

// A strip of the tets that a row's node is a corner of.
struct RowStrip {
    std::vector<StripStep> steps;
    std::vector<std::uint32_t> entries;  // of its triangles: 4 tet + corner

    template <class NodesOf>
    RowStrip(std::span<const std::uint32_t> tet_entries, const NodesOf& nodes_of)
        : entries(tet_entries.begin(), tet_entries.end()) {
        std::vector<LinkTriangle> triangles;
        for (const std::uint32_t entry : entries) {
            const glm::uvec4 nodes = nodes_of(entry / 4);
            const auto& opposite = kOppositeCorners[entry % 4];
            triangles.push_back({nodes[opposite[0]], nodes[opposite[1]], nodes[opposite[2]]});
        }
        steps = make_link_strip(triangles);
    }
};

std::span<const std::uint32_t> entries_of(const NodeTets& tets, std::uint32_t node) {
    return std::span(tets.entries).subspan(tets.starts[node], tets.starts[node + 1] - tets.starts[node]);
}

// Where `node` comes among the corners.
int corner_of(const glm::uvec4& corners, std::uint32_t node) {
    int k = 0;
    while (corners[k] != node) ++k;
    return k;
}

class Builder {
public:
    Builder(const Model& model, std::span<const std::uint32_t> nodes, const NodeTets& node_tets)
        : model_(model), nodes_(nodes), node_tets_(node_tets), tet_indices_(neo_hookean_tet_indices(model)) {}

    TetBlocks build() {
        for (std::uint32_t group = 0; group < nodes_.size() / kGroup; ++group) {
            begin_group();
            append_group(nodes_.subspan(group * kGroup, kGroup));
        }
        begin_group();
        blocks_.is_damped = model_.has_damping();
        return std::move(blocks_);
    }

private:
    void begin_group() {
        blocks_.neo_hookean_starts.push_back(static_cast<std::uint32_t>(blocks_.neo_hookean.size()));
        blocks_.volume_starts.push_back(static_cast<std::uint32_t>(blocks_.volumes.size()));
    }

    void append_group(std::span<const std::uint32_t> nodes) {
        shown_ = shown_nodes(nodes.data());
        for (std::uint32_t row = 0; row < kGroup; ++row) {
            if (nodes[row] == kNoNode) continue;
            if (has_neo_hookean_tets(model_, nodes[row])) {
                append_neo_hookean(nodes[row], row);
            } else if (!model_.volume_term.is_empty()) {
                append_volumes(nodes[row], row);
            }
        }
    }

    void append_neo_hookean(std::uint32_t node, std::uint32_t row) {
        const RowStrip strip(entries_of(model_.neo_hookean_corners, node),
                             [&](std::uint32_t tet) { return nodes_of(model_.neo_hookean_tets[tet]); });
        LinkTriangle last{};
        for (std::size_t k = 0; k < strip.steps.size(); ++k) {
            const StripStep& step = strip.steps[k];
            last = {step.keeps_oldest ? last[0] : last[1], last[2], step.vertex};
            const std::size_t index = blocks_.neo_hookean_starts.back() + k;
            if (index == blocks_.neo_hookean.size()) append_neo_hookean_block();
            NeoHookeanBlock& block = blocks_.neo_hookean[index];
            block.nodes[row] = step.vertex;
            if (step.triangle != StripStep::kNoTriangle)
                set_corner(strip.entries[step.triangle], last, index, row);
            block.mu[row] = std::copysign(block.mu[row], step.keeps_oldest ? -1.0f : 1.0f);
        }
    }

    void append_neo_hookean_block() {
        blocks_.neo_hookean.emplace_back().nodes = shown_;
        blocks_.neo_hookean_tets.emplace_back().fill(static_cast<std::uint32_t>(model_.tets.size()));
        blocks_.openings.emplace_back();
        if (!model_.volume_term.is_empty()) blocks_.neo_hookean_moduli.emplace_back();
    }

    // @param order the other corners as the strip has them
    void set_corner(std::uint32_t entry, const LinkTriangle& order, std::size_t index, std::uint32_t row) {
        const NeoHookeanTet& tet = model_.neo_hookean_tets[entry / 4];
        const glm::uvec4 nodes = nodes_of(tet);
        const std::uint32_t tet_index = tet_indices_[entry / 4];
        const NeoHookeanCorner corner = make_neo_hookean_corner(
            tet, {corner_of(nodes, order[0]), corner_of(nodes, order[1]), corner_of(nodes, order[2])},
            tet_index);
        NeoHookeanBlock& block = blocks_.neo_hookean[index];
        block.aa[row] = corner.aa;
        block.ab[row] = corner.ab;
        block.bb[row] = corner.bb;
        block.ac[row] = corner.ac;
        block.bc[row] = corner.bc;
        block.cc[row] = corner.cc;
        block.mu[row] = corner.mu;
        block.lambda[row] = corner.lambda;
        blocks_.neo_hookean_tets[index][row] = tet_index;
        blocks_.openings[index][row] = glm::vec3(corner.opening);
        if (!blocks_.neo_hookean_moduli.empty())
            blocks_.neo_hookean_moduli[index].values[row] = modulus_of(tet_index);
    }

    float modulus_of(std::uint32_t tet) const {
        return model_.volume_term.tets[tet] * model_.tet_rests[tet].volume;
    }

    // Without tets that no volume term acts on, as in the other bodies of a scene.
    void append_volumes(std::uint32_t node, std::uint32_t row) {
        std::vector<std::uint32_t> entries;
        for (const std::uint32_t entry : entries_of(node_tets_, node)) {
            if (model_.volume_term.tets[entry / 4] != 0.0f) entries.push_back(entry);
        }
        const RowStrip strip(entries, [&](std::uint32_t tet) { return model_.tets[tet]; });
        for (std::size_t k = 0; k < strip.steps.size(); ++k) {
            const StripStep& step = strip.steps[k];
            const std::size_t index = blocks_.volume_starts.back() + k;
            if (index == blocks_.volumes.size()) {
                blocks_.volumes.emplace_back().nodes = shown_;
                blocks_.volume_tets.emplace_back().fill(static_cast<std::uint32_t>(model_.tets.size()));
            }
            VolumeBlock& block = blocks_.volumes[index];
            block.nodes[row] = step.vertex;
            if (step.triangle != StripStep::kNoTriangle) {
                const std::uint32_t tet = strip.entries[step.triangle] / 4;
                blocks_.volume_tets[index][row] = tet;
                const float inverse = 1.0f / (6.0f * model_.tet_rests[tet].volume);
                block.inverse_six_volumes[row] = step.is_reversed ? -inverse : inverse;
                block.modulus[row] = modulus_of(tet);
            }
            block.modulus[row] = std::copysign(block.modulus[row], step.keeps_oldest ? -1.0f : 1.0f);
        }
    }

    const Model& model_;
    std::span<const std::uint32_t> nodes_;
    const NodeTets& node_tets_;
    std::vector<std::uint32_t> tet_indices_;
    std::array<std::uint32_t, kGroup> shown_{};
    TetBlocks blocks_;
};

}  // namespace

TetBlocks make_tet_blocks(const Model& model, std::span<const std::uint32_t> nodes,
                          const NodeTets& node_tets) {
    if (model.neo_hookean_tets.empty() && model.volume_term.is_empty()) return {};
    return Builder(model, nodes, node_tets).build();
}

TetOffsets::TetOffsets(const TetBlocks& blocks)
    : neo_hookean(blocks.neo_hookean_moduli.size()), volumes(blocks.volumes.size()) {}

}  // namespace gelatin::cpu
