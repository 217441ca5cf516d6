#include "model/elasticity/volume_term.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

double shear_modulus(const Material& material) {
    return material.youngs_modulus / (2.0 * (1.0 + material.poisson_ratio));
}

double lacking_modulus(const Material& material) {
    const double nu = material.poisson_ratio;
    return material.youngs_modulus * (4.0 * nu - 1.0) / (2.0 * (1.0 + nu) * (1.0 - 2.0 * nu));
}

double bulk_modulus(const Material& material) {
    return material.youngs_modulus / (3.0 * (1.0 - 2.0 * material.poisson_ratio));
}

VolumeTerm make_volume_term(std::span<const glm::uvec4> tets, std::span<const TetRest> rests,
                            const NodeTets& node_tets) {
    VolumeTerm term;
    if (std::all_of(rests.begin(), rests.end(), [](const TetRest& r) { return r.kappa == 0.0f; }))
        return term;
    for (std::size_t n = 0; n + 1 < node_tets.starts.size(); ++n) {
        double volume = 0.0, bulk = 0.0, share = 0.0;
        for (std::uint32_t e = node_tets.starts[n]; e < node_tets.starts[n + 1]; ++e) {
            const TetRest& rest = rests[node_tets.entries[e] / 4];
            const double quarter = 0.25 * static_cast<double>(rest.volume);
            const auto own = static_cast<double>(rest.bulk);
            volume += quarter;
            bulk += quarter * own;
            share += quarter * own / (own + static_cast<double>(rest.kappa));
        }
        term.nodes.emplace_back(volume, volume > 0.0 ? bulk / volume * (volume / share - 1.0) : 0.0);
    }
    for (const glm::uvec4& tet : tets) {
        float sum = 0.0f;
        for (int k = 0; k < 4; ++k) sum += 0.25f * std::abs(term.nodes[tet[k]].y);
        term.tets.push_back(sum);
    }
    std::vector<std::uint32_t> rows(term.nodes.size());
    std::iota(rows.begin(), rows.end(), 0u);
    term.corners = pack_tet_corners(rows, node_tets, tets);
    return term;
}

}  // namespace gelatin
