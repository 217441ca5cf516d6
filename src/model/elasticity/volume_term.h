#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/elasticity/node_tets.h"

namespace gelatin {

struct Material;
struct TetRest;

/// Isotropic elasticity with Young's modulus E and Poisson's ratio nu, split into the part of springs and
/// that of a volume term (docs/finite-elements.md).
double shear_modulus(const Material& material);  ///< mu = E / (2 (1 + nu)) [Pa], the part of springs
/// Lame's lambda minus mu [Pa]: springs behave as if both were equal. Negative below nu = 1/4.
double lacking_modulus(const Material& material);
double bulk_modulus(const Material& material);  ///< lambda + 2/3 mu [Pa]

/// The part of a body's resistance to changes of volume that springs, or single neo-Hookean tets
/// (model/elasticity/neo_hookean.h), do not have, averaged over nodes:
///   W = sum_i V_i kappa_i phi(J_i - 1),   J_i = v_i / V_i,
/// with v_i a quarter of the volumes of the tets around node i, V_i that at rest. Tets of several materials
/// share the stress: with K_t the bulk modulus of their springs or their own, and means by volume,
///   kappa_i = mean(K_t) (1 / mean(K_t / (K_t + kappa_t)) - 1).
struct VolumeTerm {
    std::vector<glm::vec2> nodes;  ///< V_i [m^3], kappa_i [Pa], shape [nodes]
    /// Of each tet the mean |kappa_i| of its corners [Pa], shape [tets]: with it as the stiffness of every
    /// tet by itself, W is never underestimated.
    std::vector<float> tets;
    TetCorners corners;  ///< the tets around each node, one row for each

    bool is_empty() const { return nodes.empty(); }
};

/// Empty if no tet contributes.
VolumeTerm make_volume_term(std::span<const glm::uvec4> tets, std::span<const TetRest> rests,
                            const NodeTets& node_tets);

}  // namespace gelatin
