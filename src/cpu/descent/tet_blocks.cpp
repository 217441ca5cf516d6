#include "cpu/descent/tet_blocks.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "model/descent/descent_rows.h"
#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/node_tets.h"

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

// The gradients of a, b and c after a rotation, or a reflection, that makes them triangular: Gram-Schmidt.
void set_gradients(const std::array<glm::dvec3, 3>& gradients, std::uint32_t row, NeoHookeanBlock& block) {
    const double aa = glm::length(gradients[0]);
    const glm::dvec3 x = gradients[0] / aa;
    const double ab = glm::dot(x, gradients[1]), ac = glm::dot(x, gradients[2]);
    const glm::dvec3 b_left = gradients[1] - ab * x;
    const double bb = glm::length(b_left);
    const glm::dvec3 y = b_left / bb;
    const double bc = glm::dot(y, gradients[2]);
    const double cc = glm::length(gradients[2] - ac * x - bc * y);
    block.aa[row] = static_cast<float>(aa);
    block.ab[row] = static_cast<float>(ab);
    block.bb[row] = static_cast<float>(bb);
    block.ac[row] = static_cast<float>(ac);
    block.bc[row] = static_cast<float>(bc);
    block.cc[row] = static_cast<float>(cc);
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
            NeoHookeanBlock& block = blocks_.neo_hookean[index];
            const std::uint32_t corner = corners.entries[e] % 4;
            const NeoHookeanTet& tet = model_.neo_hookean_tets[corners.entries[e] / 4];
            const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
            std::array<glm::dvec3, 3> others;
            for (std::size_t k = 0; k < 3; ++k) {
                const int other = kOppositeCorners[corner][k];
                block.nodes[k][row] = nodes_of(tet)[other];
                others[k] = gradients[static_cast<std::size_t>(other)];
            }
            set_gradients(others, row, block);
            const float volume = tet.gradient_1.w;
            block.mu[row] = volume * tet.gradient_2.w;
            block.lambda[row] = volume * tet.gradient_3.w;
            block.tets[row] = first_tet + corners.entries[e] / 4;
            blocks_.openings[index][row] = block.mu[row] * glm::vec3(gradients[corner]);
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
            block.over_six_volumes[row] = 1.0f / (6.0f * model_.tet_rests[tet].volume);
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
