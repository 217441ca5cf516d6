#include "model/springs/rest_net.h"

#include <glm/geometric.hpp>

#include "model/spring_packing.h"

namespace gelatin {

RestNet make_rest_net(const TetMesh& mesh, const std::vector<Link>& links) {
    RestNet net;
    for (const Link& link : links) {
        const glm::dvec3 d = mesh.positions[link.nodes.y] - mesh.positions[link.nodes.x];
        const double length = glm::length(d);
        net.nodes.push_back(link.nodes);
        net.directions.emplace_back(Eigen::Vector3d(d.x, d.y, d.z) / length);
        net.lengths.push_back(length);
    }
    net.ends = make_incidence(static_cast<std::uint32_t>(mesh.positions.size()), net.nodes);
    return net;
}

std::vector<Eigen::Vector3d> boundary_areas(const TetMesh& mesh) {
    std::vector<Eigen::Vector3d> areas(mesh.positions.size(), Eigen::Vector3d::Zero());
    for (const glm::uvec3& face : mesh.faces) {
        const glm::dvec3 a = mesh.positions[face.x];
        const glm::dvec3 third = glm::cross(mesh.positions[face.y] - a, mesh.positions[face.z] - a) / 6.0;
        for (int k = 0; k < 3; ++k) areas[face[k]] += Eigen::Vector3d(third.x, third.y, third.z);
    }
    return areas;
}

}  // namespace gelatin
