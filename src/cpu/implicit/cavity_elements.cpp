#include "cpu/implicit/cavity_elements.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
CavityElements<Real>::CavityElements(std::shared_ptr<const Model> model) : model_(std::move(model)) {
    const auto cavities = static_cast<std::uint32_t>(model_->cavities.size());
    for (std::uint32_t c = 0; c < cavities; ++c) append_corners(c);
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
        return std::tie(a.node, a.cavity) < std::tie(b.node, b.cavity);
    });
    of_cavities_.resize(cavities);
    for (std::uint32_t k = 0; k < corners_.size(); ++k) of_cavities_[corners_[k].cavity].push_back(k);
    volumes_.resize(cavities);
    pressures_.resize(cavities);
    stiffnesses_.resize(cavities);
    curvatures_ = values_ = stiffnesses_;
    gradients_.resize(corners_.size());
    arms_.resize(edges_.size());
}

// Of a closed surface each edge has two faces, and of these each has it in another direction.
template <class Real>
void CavityElements<Real>::append_corners(std::uint32_t cavity) {
    std::map<std::uint32_t, std::map<std::uint32_t, Edge>> edges;  // by both nodes
    for (const glm::uvec3& f : model_->cavities[cavity].faces)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
            edges[a][b].next = c;
            edges[b][a].previous = c;
        }
    for (const auto& [node, of_node] : edges) {
        Corner& corner = corners_.emplace_back(Corner{node, cavity});
        corner.edges = {static_cast<std::uint32_t>(edges_.size()),
                        static_cast<std::uint32_t>(of_node.size())};
        for (const auto& [other, edge] : of_node) edges_.push_back({other, edge.next, edge.previous});
    }
}

// g from the node itself: all that it is made of is small then, and exact but for rounding of what is small.
template <class Real>
void CavityElements<Real>::linearise(std::span<const Vec4<Real>> positions, std::span<const double> drives) {
    for (std::size_t c = 0; c < of_cavities_.size(); ++c) {
        const Cavity& cavity = model_->cavities[c];
        const double volume = enclosed_volume(cavity.faces, positions);
        volumes_[c] = volume;
        curvatures_[c] = Real(0);
        pressures_[c] = static_cast<Real>(cavity.pressure(drives[c], volume));
        stiffnesses_[c] = static_cast<Real>(cavity.stiffness(drives[c], volume));
    }
    const auto at = [&](std::uint32_t n) { return glm::dvec3(positions[n]); };
    for_each_index(corners_.size(), [&](std::size_t k) {
        const Corner& corner = corners_[k];
        const glm::dvec3 origin = at(corner.node);
        glm::dvec3 sum(0.0);
        for (std::uint32_t e = corner.edges.first; e < corner.edges.end(); ++e) {
            const Edge& edge = edges_[e];
            sum += glm::cross(at(edge.other) - origin, at(edge.next) - origin);
            arms_[e] = Vec3<Real>((at(edge.next) - at(edge.previous)) / 6.0);
        }
        gradients_[k] = Vec3<Real>(sum / 6.0);
    });
}

template <class Real>
void CavityElements<Real>::add(std::span<Vec3<Real>> forces,
                               std::span<SymmetricMatrix<Real>> diagonal) const {
    for (std::size_t k = 0; k < corners_.size(); ++k) {
        const auto& [node, cavity, edges] = corners_[k];
        forces[node] += pressures_[cavity] * gradients_[k];
        diagonal[node].add_outer(stiffnesses_[cavity], gradients_[k]);
    }
}

// For the rotations w = e_k x r the sum of w . H w over all three axes is 2 sum of g . r, which is 6 V.
template <class Real>
void CavityElements<Real>::balance_rotations(const ModelObject& body, double resistance) {
    double sum = 0.0;
    for (std::uint32_t c = body.cavities.first; c < body.cavities.end(); ++c)
        sum += 6.0 * static_cast<double>(pressures_[c]) * volumes_[c];
    // Springs, of which those that are compressed do not count, resist by half as much again.
    constexpr double kMost = 2.0;
    const double share = sum > 0.0 ? std::min(resistance / sum, kMost) : 0.0;
    for (std::uint32_t c = body.cavities.first; c < body.cavities.end(); ++c)
        curvatures_[c] = static_cast<Real>(share) * pressures_[c];
}

template <class Real>
void CavityElements<Real>::begin_product(const ModelObject& body, std::span<const Vec4<Real>> displacements) {
    for (std::uint32_t c = body.cavities.first; c < body.cavities.end(); ++c) {
        double sum = 0.0;
        for (const std::uint32_t k : of_cavities_[c])
            sum += static_cast<double>(glm::dot(gradients_[k], Vec3<Real>(displacements[corners_[k].node])));
        values_[c] = static_cast<Real>(static_cast<double>(stiffnesses_[c]) * sum);
    }
}

template <class Real>
void CavityElements<Real>::multiply(const Range& nodes, std::span<const Vec4<Real>> displacements,
                                    std::span<Vec3<Real>> product) const {
    auto corner = std::lower_bound(corners_.begin(), corners_.end(), nodes.first,
                                   [](const Corner& c, std::uint32_t node) { return c.node < node; });
    for (; corner != corners_.end() && corner->node < nodes.end(); ++corner) {
        Vec3<Real> bent(0);  // H d
        for (std::uint32_t e = corner->edges.first; e < corner->edges.end(); ++e)
            bent += glm::cross(Vec3<Real>(displacements[edges_[e].other]), arms_[e]);
        const auto k = static_cast<std::size_t>(corner - corners_.begin());
        product[corner->node] += values_[corner->cavity] * gradients_[k] - curvatures_[corner->cavity] * bent;
    }
}

template class CavityElements<float>;
template class CavityElements<double>;

}  // namespace gelatin::cpu
