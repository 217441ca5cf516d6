#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/elasticity/node_tets.h"
#include "model/layouts.h"

namespace gelatin {

struct Model;

/// The tets round nodes as strips (shaders/layouts/tet_strip.glsl), for solvers that visit them node by node.
class TetStrips {
public:
    /// @param node_tets those of the model's tets; both must outlive this
    TetStrips(const Model& model, const NodeTets& node_tets);

    /// The neo-Hookean tets that the node is a corner of.
    std::vector<NeoHookeanStep> neo_hookean(std::uint32_t node) const;
    /// The tets round the node that the volume term acts on.
    std::vector<VolumeStep> volumes(std::uint32_t node) const;

    static constexpr std::uint32_t kKeepsOldest = 0x80000000u;  ///< of a step's vertex
    /// So many vertices come in before the first tet.
    static constexpr std::uint32_t kFirstVertices = 2;

private:
    float modulus_of(std::uint32_t tet) const;

    const Model& model_;
    const NodeTets& node_tets_;
    std::vector<std::uint32_t> indices_;  // of neo-Hookean tets, in Model::tets
};

/// Steps by row of nodes in slices of 64 rows, laid out as HalfSprings' pairs are.
template <class Step>
struct StripSlices {
    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<Step> steps;                  ///< shape [slice_starts.back()]
};

/// @param rows nodes, each at most once, or kNoNode
StripSlices<NeoHookeanStep> pack_neo_hookean_strips(const TetStrips& strips,
                                                    std::span<const std::uint32_t> rows);
StripSlices<VolumeStep> pack_volume_strips(const TetStrips& strips, std::span<const std::uint32_t> rows);

}  // namespace gelatin
