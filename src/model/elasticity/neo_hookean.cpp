#include "model/elasticity/neo_hookean.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "model/model.h"

namespace gelatin {

NeoHookeanModuli neo_hookean_moduli(double youngs_modulus, double poisson_ratio) {
    const double shear = youngs_modulus / (2.0 * (1.0 + poisson_ratio));
    const double ratio = 2.0 * poisson_ratio / (1.0 - 2.0 * poisson_ratio);  // lambda_L over mu_L
    const double lame = ratio * shear, own = std::min(ratio, std::max(1.0, 3.0 - ratio)) * shear;
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

bool has_neo_hookean_tets(const Model& model, std::uint32_t node) {
    const std::vector<std::uint32_t>& starts = model.neo_hookean_corners.starts;
    return !starts.empty() && starts[node] < starts[node + 1];
}

}  // namespace gelatin
