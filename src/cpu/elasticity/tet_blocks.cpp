#include "cpu/elasticity/tet_blocks.h"

#include <utility>

#include "model/elasticity/tet_strips.h"

namespace gelatin::cpu {
namespace {

static_assert(TetBlocks::kEmptyBlocks == TetStrips::kFirstVertices);

class Builder {
public:
    Builder(const Model& model, std::span<const std::uint32_t> nodes, const NodeTets& node_tets)
        : nodes_(nodes), strips_(model, node_tets) {
        blocks_.is_damped = model.has_damping();
    }

    TetBlocks build() {
        for (std::uint32_t first = 0; first < nodes_.size(); first += kGroup) {
            begin_group();
            const std::span<const std::uint32_t> nodes = nodes_.subspan(first, kGroup);
            if (is_empty_group(nodes.data())) continue;
            shown_ = shown_nodes(nodes.data());
            for (std::uint32_t row = 0; row < kGroup; ++row) {
                if (nodes[row] != kNoNode) append(nodes[row], row);
            }
        }
        begin_group();
        return std::move(blocks_);
    }

private:
    void begin_group() {
        blocks_.neo_hookean_starts.push_back(static_cast<std::uint32_t>(blocks_.neo_hookean.size()));
        blocks_.volume_starts.push_back(static_cast<std::uint32_t>(blocks_.volumes.size()));
    }

    void append(std::uint32_t node, std::uint32_t row) {
        std::size_t index = blocks_.neo_hookean_starts.back();
        for (const NeoHookeanStep& step : strips_.neo_hookean(node)) {
            if (index == blocks_.neo_hookean.size()) append_neo_hookean_block();
            set(step, index++, row);
        }
        index = blocks_.volume_starts.back();
        for (const VolumeStep& step : strips_.volumes(node)) {
            if (index == blocks_.volumes.size()) append_volume_block();
            set(step, index++, row);
        }
    }

    void append_neo_hookean_block() {
        blocks_.neo_hookean.emplace_back().nodes = shown_;
        blocks_.openings.emplace_back();
    }

    void append_volume_block() {
        blocks_.volumes.emplace_back().nodes = shown_;
        blocks_.inverse_six_volumes.emplace_back();
    }

    void set(const NeoHookeanStep& step, std::size_t index, std::uint32_t row) {
        NeoHookeanBlock& block = blocks_.neo_hookean[index];
        block.nodes[row] = step.vertex & ~TetStrips::kKeepsOldest;
        block.aa[row] = step.aa;
        block.ab[row] = step.ab;
        block.bb[row] = step.bb;
        block.ac[row] = step.ac;
        block.bc[row] = step.bc;
        block.cc[row] = step.cc;
        block.mu[row] = with_sign(step.mu, step.vertex);
        block.lambda[row] = step.lambda;
        blocks_.openings[index][row] = glm::vec3(step.opening);
    }

    void set(const VolumeStep& step, std::size_t index, std::uint32_t row) {
        VolumeBlock& block = blocks_.volumes[index];
        block.nodes[row] = step.vertex & ~TetStrips::kKeepsOldest;
        const float inverse = step.inverse_six_volumes;
        block.modulus[row] = with_sign(inverse * inverse * step.modulus, step.vertex);
        blocks_.inverse_six_volumes[index].values[row] = inverse;
    }

    static float with_sign(float value, std::uint32_t vertex) {
        return (vertex & TetStrips::kKeepsOldest) != 0 ? -value : value;
    }

    std::span<const std::uint32_t> nodes_;
    TetStrips strips_;
    std::array<std::uint32_t, kGroup> shown_{};
    TetBlocks blocks_;
};

}  // namespace

TetBlocks make_tet_blocks(const Model& model, std::span<const std::uint32_t> nodes,
                          const NodeTets& node_tets) {
    if (model.neo_hookean_tets.empty() && model.volume_term.is_empty()) return {};
    return Builder(model, nodes, node_tets).build();
}

}  // namespace gelatin::cpu
