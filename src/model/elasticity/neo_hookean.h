#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gelatin {

struct Model;

/// A tet of a neo-Hookean body. Corner 0's shape function has minus the sum of the other gradients.
struct NeoHookeanTet {
    std::uint32_t node_0, node_1, node_2, node_3;  ///< corners
    glm::vec4 gradient_1;  ///< of corner 1's shape function at rest [1/m]; w: volume at rest [m^3]
    glm::vec4 gradient_2;  ///< w: mu [Pa]
    glm::vec4 gradient_3;  ///< w: lambda [Pa]
};

/// The two constants of a single tet's energy (cpu/elasticity/neo_hookean.h), and that of the volume term,
/// which is averaged over nodes (model/elasticity/volume_term.h), because single tets would lock.
struct NeoHookeanModuli {
    double mu;      ///< [Pa], > 0
    double lambda;  ///< [Pa], > 0
    double kappa;   ///< [Pa], >= 0
};

/// The constants for which small strains obey Hooke's law. With Lamé's
///   mu_L = E / (2 (1 + nu)),   lambda_L = E nu / ((1 + nu) (1 - 2 nu)),
/// tets take lambda_t = min(lambda_L, max(mu_L, 3 mu_L - lambda_L)), and kappa is the rest. That is all of
/// lambda_L up to nu = 0.3, so that these bodies do without the volume term and its cost, and mu_L from
/// nu = 1/3 on (docs/finite-elements.md). For the tets' part, mu = 4/3 mu_L
/// and lambda = lambda_t + 5/6 mu_L (Smith, de Goes, Kim: "Stable Neo-Hookean Flesh Simulation", ACM
/// Transactions on Graphics 37(2), 2018, 3.4).
/// @param youngs_modulus [Pa], > 0 @param poisson_ratio in [0, 0.5)
NeoHookeanModuli neo_hookean_moduli(double youngs_modulus, double poisson_ratio);

/// A tet at rest. @param corners positions of `nodes` [m], wound as those of TetMesh
/// @pre its properties fit into single precision
NeoHookeanTet make_neo_hookean_tet(const glm::uvec4& nodes, const std::array<glm::dvec3, 4>& corners,
                                   const NeoHookeanModuli& moduli);

/// The gradients of the corners' shape functions [1/m].
std::array<glm::dvec3, 4> shape_gradients(const NeoHookeanTet& tet);

/// True for the nodes of bodies of such tets.
bool has_neo_hookean_tets(const Model& model, std::uint32_t node);

inline glm::uvec4 nodes_of(const NeoHookeanTet& tet) {
    return {tet.node_0, tet.node_1, tet.node_2, tet.node_3};
}

}  // namespace gelatin
