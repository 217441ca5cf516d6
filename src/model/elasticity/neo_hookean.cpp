#include "model/elasticity/neo_hookean.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "model/elasticity/node_tets.h"
#include "model/model.h"
#include "model/shared_constants.h"

namespace gelatin {

NeoHookeanModuli neo_hookean_moduli(double youngs_modulus, double poisson_ratio) {
    const double shear = youngs_modulus / (2.0 * (1.0 + poisson_ratio));
    const double lame = 2.0 * shear * poisson_ratio / (1.0 - 2.0 * poisson_ratio);
    const double own = std::min(lame, shear);
    return {4.0 / 3.0 * shear, own + 5.0 / 6.0 * shear, lame - own};
}

NeoHookeanTet make_neo_hookean_tet(const glm::uvec4& nodes, const std::array<glm::dvec3, 4>& corners,
                                   const NeoHookeanModuli& moduli) {
    const glm::dvec3 a = corners[1] - corners[0], b = corners[2] - corners[0], c = corners[3] - corners[0];
    const double six_volumes = glm::dot(glm::cross(a, b), c);
    const auto texel = [&](const glm::dvec3& area, double w) {
        return glm::vec4(glm::dvec4(area / six_volumes, w));
    };
    return {nodes.x,
            nodes.y,
            nodes.z,
            nodes.w,
            texel(glm::cross(b, c), six_volumes / 6.0),
            texel(glm::cross(c, a), moduli.mu),
            texel(glm::cross(a, b), moduli.lambda)};
}

std::array<glm::dvec3, 4> shape_gradients(const NeoHookeanTet& tet) {
    const glm::dvec3 g1(tet.gradient_1), g2(tet.gradient_2), g3(tet.gradient_3);
    return {-(g1 + g2 + g3), g1, g2, g3};
}

// Gram-Schmidt makes the gradients triangular. Energies see no reflection, either: its z axis is opposed to
// that of x and y, for which counter-clockwise corners have a positive cc.
NeoHookeanCorner make_neo_hookean_corner(const NeoHookeanTet& tet, const std::array<int, 3>& others,
                                         std::uint32_t index) {
    const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
    const auto gradient = [&](int k) { return gradients[static_cast<std::size_t>(k)]; };
    const glm::dvec3 a = gradient(others[0]), b = gradient(others[1]), c = gradient(others[2]);
    const double aa = glm::length(a);
    const glm::dvec3 x = a / aa;
    const double ab = glm::dot(x, b), ac = glm::dot(x, c);
    const double bb = glm::length(b - ab * x);
    const glm::dvec3 y = (b - ab * x) / bb;
    const double bc = glm::dot(y, c), cc = -glm::dot(glm::cross(x, y), c);
    const float volume = tet.gradient_1.w, mu = volume * tet.gradient_2.w;
    const glm::uvec4 nodes = nodes_of(tet);
    return {.node_a = nodes[others[0]],
            .node_b = nodes[others[1]],
            .node_c = nodes[others[2]],
            .tet = index,
            .aa = static_cast<float>(aa),
            .ab = static_cast<float>(ab),
            .bb = static_cast<float>(bb),
            .ac = static_cast<float>(ac),
            .bc = static_cast<float>(bc),
            .cc = static_cast<float>(cc),
            .mu = mu,
            .lambda = volume * tet.gradient_3.w,
            .opening = mu * glm::vec4(gradient(6 - others[0] - others[1] - others[2]), 0.0)};
}

std::vector<std::uint32_t> neo_hookean_tet_indices(const Model& model) {
    std::vector<std::uint32_t> indices(model.neo_hookean_tets.size());
    for (const ModelObject& object : model.objects) {
        const auto first = indices.begin() + object.neo_hookean_tets.first;
        std::iota(first, first + object.neo_hookean_tets.count, object.tets.first);
    }
    return indices;
}

NeoHookeanCorners pack_neo_hookean_corners(const Model& model, std::span<const std::uint32_t> rows) {
    const std::vector<std::uint32_t> indices = neo_hookean_tet_indices(model);
    const NodeTetSlices slices = pack_node_tets(rows, model.neo_hookean_corners);
    NeoHookeanCorners packed{slices.slice_starts, {}};
    packed.corners.reserve(slices.entries.size());
    for (const std::uint32_t entry : slices.entries) {
        if (entry == NodeTetSlices::kNoEntry) {
            packed.corners.emplace_back().tet = packing::kNone;
        } else {
            const auto& others = kOppositeCorners[entry % 4];
            packed.corners.push_back(make_neo_hookean_corner(
                model.neo_hookean_tets[entry / 4], {others[0], others[1], others[2]}, indices[entry / 4]));
        }
    }
    return packed;
}

bool has_neo_hookean_tets(const Model& model, std::uint32_t node) {
    const std::vector<std::uint32_t>& starts = model.neo_hookean_corners.starts;
    return !starts.empty() && starts[node] < starts[node + 1];
}

}  // namespace gelatin
