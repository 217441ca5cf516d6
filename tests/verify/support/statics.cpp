#include "verify/support/statics.h"

#include <Eigen/Geometry>
#include <stdexcept>

#include "model/elasticity/node_tets.h"
#include "verify/support/coordinates.h"

namespace gelatin::test {
namespace {

Eigen::Vector3d rest(const Model& model, std::uint32_t node) {
    const glm::dvec3 p(model.positions[node]);
    return {p.x, p.y, p.z};
}

}  // namespace

Statics::Statics(const Model& model)
    : model_(model),
      forces_(Eigen::VectorXd::Zero(first_coordinate(model.node_count()))),
      displacements_(forces_),
      free_(Eigen::VectorXd::Ones(forces_.size())) {
    if (model_.volume_term.is_empty()) return;
    for (const glm::uvec4& tet : model_.tets) {
        Eigen::Matrix<double, 3, 4> slopes;
        for (int k = 0; k < 4; ++k) {
            const auto& other = kOppositeCorners[k];
            const Eigen::Vector3d a = rest(model_, tet[other[0]]);
            slopes.col(k) = (rest(model_, tet[other[1]]) - a).cross(rest(model_, tet[other[2]]) - a) / 6.0;
        }
        volume_slopes_.push_back(slopes);
    }
}

void Statics::hold(std::uint32_t node, int axis, double value) {
    displacements_[first_coordinate(node) + axis] = value;
    free_[first_coordinate(node) + axis] = 0.0;
}

void Statics::pull(std::uint32_t node, const Eigen::Vector3d& force) {
    forces_.segment<3>(first_coordinate(node)) += force;
}

void Statics::solve() {
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(forces_.size());
    for (const Spring& s : model_.springs) {
        const Eigen::Vector3d n = (rest(model_, s.j) - rest(model_, s.i)).normalized();
        for (const std::uint32_t end : {s.i, s.j})
            diagonal.segment<3>(first_coordinate(end)) += static_cast<double>(s.stiffness) * n.cwiseAbs2();
    }
    for (std::size_t t = 0; t < volume_slopes_.size(); ++t) {
        const double stiffness = static_cast<double>(model_.volume_term.tets[t] / model_.tet_rests[t].volume);
        for (int k = 0; k < 4; ++k)
            diagonal.segment<3>(first_coordinate(model_.tets[t][k])) +=
                stiffness * volume_slopes_[t].col(k).cwiseAbs2();
    }
    Eigen::VectorXd residual = (forces_ - stiffness_times(displacements_)).cwiseProduct(free_);
    Eigen::VectorXd z = residual.cwiseQuotient(diagonal), search = z, image;
    double left = residual.dot(z);
    const double enough = 1e-16 * left;
    for (int k = 0; left > enough; ++k) {
        if (k > 20'000) throw std::runtime_error("the static solution does not converge");
        image = stiffness_times(search).cwiseProduct(free_);
        const double step = left / search.dot(image);
        displacements_ += step * search;
        residual -= step * image;
        z = residual.cwiseQuotient(diagonal);
        const double now = residual.dot(z);
        search = z + now / left * search;
        left = now;
    }
}

Eigen::Vector3d Statics::displacement(std::uint32_t node) const {
    return displacements_.segment<3>(first_coordinate(node));
}

Eigen::Vector3d Statics::elastic_force(std::uint32_t node) const {
    return -stiffness_times(displacements_).segment<3>(first_coordinate(node));
}

Eigen::Matrix3d Statics::mean_strain() const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double volume = 0.0;
    for (const ModelObject& object : model_.objects) volume += object.rest_volume;
    for (const Face& face : model_.faces) {
        const Eigen::Vector3d a = rest(model_, face.a), b = rest(model_, face.b), c = rest(model_, face.c);
        const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
        const Eigen::Vector3d mean =
            (displacement(face.a) + displacement(face.b) + displacement(face.c)) / 3.0;
        sum += 0.5 * (mean * area.transpose() + area * mean.transpose());
    }
    return sum / volume;
}

Eigen::VectorXd Statics::stiffness_times(const Eigen::VectorXd& u) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(u.size());
    for (const Spring& s : model_.springs) {
        const Eigen::Vector3d n = (rest(model_, s.j) - rest(model_, s.i)).normalized();
        const Eigen::Vector3d f =
            static_cast<double>(s.stiffness) *
            n.dot(u.segment<3>(first_coordinate(s.i)) - u.segment<3>(first_coordinate(s.j))) * n;
        result.segment<3>(first_coordinate(s.i)) += f;
        result.segment<3>(first_coordinate(s.j)) -= f;
    }
    if (volume_slopes_.empty()) return result;
    std::vector<double> growth(model_.node_count(), 0.0);  // of the volume round each node [m^3]
    for (std::size_t t = 0; t < volume_slopes_.size(); ++t) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k)
            sum += volume_slopes_[t].col(k).dot(u.segment<3>(first_coordinate(model_.tets[t][k])));
        for (int k = 0; k < 4; ++k) growth[model_.tets[t][k]] += 0.25 * sum;
    }
    for (std::size_t t = 0; t < volume_slopes_.size(); ++t) {
        double stress = 0.0;
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t n = model_.tets[t][k];
            const glm::dvec2 node(model_.volume_term.nodes[n]);
            stress += 0.25 * node.y * growth[n] / node.x;
        }
        for (int k = 0; k < 4; ++k)
            result.segment<3>(first_coordinate(model_.tets[t][k])) += stress * volume_slopes_[t].col(k);
    }
    return result;
}

}  // namespace gelatin::test
