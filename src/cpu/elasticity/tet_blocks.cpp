#include "cpu/elasticity/tet_blocks.h"

#include "model/elasticity/neo_hookean.h"

namespace gelatin::cpu {
namespace {

// A group's rows: their nodes, and a tet of each, which blocks without one have. So padding reads nothing of
// other bodies, which may move at the same time.
struct Rows {
    std::array<std::uint32_t, kGroup> nodes, tets{};
};

template <class Block>
Block empty_block(const Rows& rows) {
    Block block{};
    block.nodes = {rows.nodes, rows.nodes, rows.nodes};
    block.tets = rows.tets;
    return block;
}

class Builder {
public:
    Builder(const Model& model, const std::vector<std::uint32_t>& nodes, const NodeTets& node_tets)
        : model_(model), nodes_(nodes), node_tets_(node_tets), object_of_(objects_of_nodes(model)) {}

    TetBlocks build() {
        for (std::uint32_t group = 0; group < nodes_.size() / kGroup; ++group) {
            blocks_.neo_hookean_starts.push_back(static_cast<std::uint32_t>(blocks_.neo_hookean.size()));
            blocks_.volume_starts.push_back(static_cast<std::uint32_t>(blocks_.volumes.size()));
            append_group(&nodes_[group * kGroup]);
        }
        blocks_.neo_hookean_starts.push_back(static_cast<std::uint32_t>(blocks_.neo_hookean.size()));
        blocks_.volume_starts.push_back(static_cast<std::uint32_t>(blocks_.volumes.size()));
        blocks_.is_damped = model_.has_damping();
        return std::move(blocks_);
    }

private:
    void append_group(const std::uint32_t* nodes) {
        Rows rows{shown_nodes(nodes)};
        for (std::uint32_t row = 0; row < kGroup; ++row) {
            const std::uint32_t first = node_tets_.starts[rows.nodes[row]];
            if (first < node_tets_.starts[rows.nodes[row] + 1])
                rows.tets[row] = node_tets_.entries[first] / 4;
        }
        for (std::uint32_t row = 0; row < kGroup; ++row) {
            if (nodes[row] == kNoNode) continue;
            if (has_neo_hookean_tets(model_, nodes[row])) {
                append_neo_hookean(nodes[row], row, rows);
            } else if (!model_.volume_term.is_empty()) {
                append_volumes(nodes[row], row, rows);
            }
        }
    }

    void append_neo_hookean(std::uint32_t node, std::uint32_t row, const Rows& rows) {
        const NodeTets& corners = model_.neo_hookean_corners;
        const ModelObject& object = model_.objects[object_of_[node]];
        const std::uint32_t first_tet = object.tets.first - object.neo_hookean_tets.first;
        std::size_t index = blocks_.neo_hookean_starts.back();
        for (std::uint32_t e = corners.starts[node]; e < corners.starts[node + 1]; ++e, ++index) {
            if (index == blocks_.neo_hookean.size()) {
                blocks_.neo_hookean.push_back(empty_block<NeoHookeanBlock>(rows));
                blocks_.openings.emplace_back();
            }
            const std::uint32_t tet = corners.entries[e] / 4;
            const NeoHookeanCorner corner = make_neo_hookean_corner(model_.neo_hookean_tets[tet],
                                                                    corners.entries[e] % 4, first_tet + tet);
            NeoHookeanBlock& block = blocks_.neo_hookean[index];
            block.nodes[0][row] = corner.node_a;
            block.nodes[1][row] = corner.node_b;
            block.nodes[2][row] = corner.node_c;
            block.aa[row] = corner.aa;
            block.ab[row] = corner.ab;
            block.bb[row] = corner.bb;
            block.ac[row] = corner.ac;
            block.bc[row] = corner.bc;
            block.cc[row] = corner.cc;
            block.mu[row] = corner.mu;
            block.lambda[row] = corner.lambda;
            block.tets[row] = corner.tet;
            blocks_.openings[index][row] = glm::vec3(corner.opening);
        }
    }

    // Without tets that no volume term acts on, as in the other bodies of a scene.
    void append_volumes(std::uint32_t node, std::uint32_t row, const Rows& rows) {
        std::size_t index = blocks_.volume_starts.back();
        for (std::uint32_t e = node_tets_.starts[node]; e < node_tets_.starts[node + 1]; ++e) {
            const std::uint32_t tet = node_tets_.entries[e] / 4, corner = node_tets_.entries[e] % 4;
            if (model_.volume_term.tets[tet] == 0.0f) continue;
            if (index == blocks_.volumes.size()) blocks_.volumes.push_back(empty_block<VolumeBlock>(rows));
            VolumeBlock& block = blocks_.volumes[index++];
            for (std::size_t k = 0; k < 3; ++k)
                block.nodes[k][row] = model_.tets[tet][kOppositeCorners[corner][k]];
            block.inverse_six_volumes[row] = 1.0f / (6.0f * model_.tet_rests[tet].volume);
            block.tets[row] = tet;
        }
    }

    const Model& model_;
    const std::vector<std::uint32_t>& nodes_;
    const NodeTets& node_tets_;
    std::vector<std::uint32_t> object_of_;
    TetBlocks blocks_;
};

}  // namespace

TetBlocks make_tet_blocks(const Model& model, const std::vector<std::uint32_t>& nodes,
                          const NodeTets& node_tets) {
    if (model.neo_hookean_tets.empty() && model.volume_term.is_empty()) return {};
    return Builder(model, nodes, node_tets).build();
}

}  // namespace gelatin::cpu
