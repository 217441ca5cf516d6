#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "mesh/tet_mesh.h"
#include "model/model.h"
#include "model/springs/links.h"

namespace gelatin {

/// Springs at rest, in double precision, for the linear theory of small strains.
struct RestNet {
    std::vector<glm::uvec2> nodes;            ///< of each spring, shape [springs]
    std::vector<Eigen::Vector3d> directions;  ///< from the first node to the second, unit, shape [springs]
    std::vector<double> lengths;              ///< [m], shape [springs]
    SpringIncidence ends;                     ///< the springs of each node

    std::size_t node_count() const { return ends.starts.size() - 1; }
    std::size_t spring_count() const { return nodes.size(); }
};

/// @pre no link's nodes coincide
RestNet make_rest_net(const TetMesh& mesh, const std::vector<Link>& links);

/// The part of the boundary that each node represents: a third of the area normals of the boundary faces
/// around it, outwards [m^2], shape [nodes]. A uniform stress sigma acts on node i with the force sigma g_i.
std::vector<Eigen::Vector3d> boundary_areas(const TetMesh& mesh);

}  // namespace gelatin
