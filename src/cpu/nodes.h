#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gelatin::cpu {

template <class Real>
using Vec3 = glm::vec<3, Real>;
template <class Real>
using Vec4 = glm::vec<4, Real>;

/// Positions and velocities of all nodes in the precision of a backend; the same layout as on the GPU.
template <class Real>
struct Nodes {
    std::vector<Vec4<Real>> positions;   ///< xyz [m], inverse mass [1/kg], shape [nodes]
    std::vector<Vec4<Real>> velocities;  ///< xyz [m/s], damping time [s], shape [nodes]
};

}  // namespace gelatin::cpu
