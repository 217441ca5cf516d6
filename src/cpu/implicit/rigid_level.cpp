#include "cpu/implicit/rigid_level.h"

#include <Eigen/LU>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

std::vector<Range> node_ranges(const Model& model) {
    std::vector<Range> ranges;
    for (const ModelObject& object : model.objects) ranges.push_back(object.nodes);
    return ranges;
}

// (s, w) -> s + w x r, as a matrix of three rows.
Eigen::Matrix<double, 3, 6> motion_at(const glm::dvec3& r) {
    Eigen::Matrix<double, 3, 6> j;
    j << 1, 0, 0, 0, r.z, -r.y,  //
        0, 1, 0, -r.z, 0, r.x,   //
        0, 0, 1, r.y, -r.x, 0;
    return j;
}

glm::dmat3 rotation_about(const glm::dvec3& w) {
    const double angle = glm::length(w);
    return angle > 0.0 ? glm::mat3_cast(glm::angleAxis(angle, w / angle)) : glm::dmat3(1.0);
}

}  // namespace

template <class Real>
RigidLevel<Real>::RigidLevel(std::shared_ptr<const Model> model)
    : model_(std::move(model)), numbers_(model_->objects.size(), kNoNode), pieces_(node_ranges(*model_)) {
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        const auto* first = model_->positions.data() + nodes.first;
        if (std::any_of(first, first + nodes.count, [](const glm::vec4& p) { return p.w == 0.0f; })) continue;
        numbers_[o] = static_cast<std::uint32_t>(bodies_.size());
        bodies_.push_back({o});
    }
}

template <class Real>
void RigidLevel<Real>::begin(std::span<const Vec4<Real>> positions, std::span<const Real> inertia) {
    positions_.assign(positions.begin(), positions.end());
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        Body& body = bodies_[b];
        const Range& nodes = model_->objects[body.object].nodes;
        const glm::dvec3 origin(positions[nodes.first]);
        RigidSums sums;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sums.add(glm::dvec3(positions[n]) - origin, static_cast<double>(inertia[n]), glm::dvec3(0.0));
        const glm::dvec3 middle = sums.arm / sums.stiffness;
        body.center = origin + middle;
        body.weight = sums.stiffness;
        sums.square.add_outer(-sums.stiffness, middle);
        sums.arm = glm::dvec3(0.0);
        body.matrix = inertia_matrix(sums);
        body.inverse = body.matrix.inverse();
    });
}

template <class Real>
void RigidLevel<Real>::factorise(std::span<const ContactRow<Real>> rows,
                                 std::span<const RowTangent<Real>> tangents) {
    is_coupled_ = false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, MotionMatrix> blocks;  // of the lower triangle
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) blocks[{b, b}] = bodies_[b].matrix;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const ContactRow<Real>& row = rows[k];
        const SymmetricMatrix<Real>& h = tangents[k].stiffness;
        if (!(h.diagonal.x + h.diagonal.y + h.diagonal.z > Real(0))) continue;
        Eigen::Matrix3d stiffness;
        stiffness << h.diagonal.x, h.beside.z, h.beside.y, h.beside.z, h.diagonal.y, h.beside.x, h.beside.y,
            h.beside.x, h.diagonal.z;
        std::uint32_t sides[2] = {kNoNode, kNoNode};
        Eigen::Matrix<double, 3, 6> jacobians[2];
        for (int side = 0; side < 2; ++side) {
            const std::uint32_t object = side == 0 ? row.object : row.other;
            if (object == kNoNode || numbers_[object] == kNoNode) continue;
            sides[side] = numbers_[object];
            glm::dvec3 arm(0.0);
            for (std::uint32_t q = 0; q < row.count; ++q) {
                const auto weight = static_cast<double>(row.weights[q]);
                if ((side == 0) != (weight < 0.0)) continue;
                arm +=
                    std::abs(weight) * (glm::dvec3(positions_[row.nodes[q]]) - bodies_[sides[side]].center);
            }
            jacobians[side] = (side == 0 ? -1.0 : 1.0) * motion_at(arm);
        }
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                if (sides[i] == kNoNode || sides[j] == kNoNode || sides[i] < sides[j]) continue;
                auto [block, is_new] = blocks.try_emplace({sides[i], sides[j]}, MotionMatrix::Zero());
                block->second += jacobians[i].transpose() * stiffness * jacobians[j];
                is_coupled_ = true;
            }
    }
    if (!is_coupled_) return;
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [at, block] : blocks)
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                entries.emplace_back(6 * static_cast<int>(at.first) + i, 6 * static_cast<int>(at.second) + j,
                                     block(i, j));
    const auto size = static_cast<Eigen::Index>(6 * bodies_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(matrix);
}

template <class Real>
std::vector<Motion> RigidLevel<Real>::gather(std::span<const Vec3<Real>> residual) const {
    std::vector<Motion> by_object(model_->objects.size(), Motion::Zero());
    pieces_.gather(
        std::span<Motion>(by_object),
        [&](const ObjectPieces::Piece& piece) -> Motion {
            if (numbers_[piece.object] == kNoNode) return Motion::Zero();
            const glm::dvec3& center = bodies_[numbers_[piece.object]].center;
            glm::dvec3 force(0.0), moment(0.0);
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                const glm::dvec3 f(residual[n]);
                force += f;
                moment += glm::cross(glm::dvec3(positions_[n]) - center, f);
            }
            return motion(force, moment);
        },
        [](Motion& sum, const Motion& more) { sum += more; });
    std::vector<Motion> by_body;
    for (const Body& body : bodies_) by_body.push_back(by_object[body.object]);
    return by_body;
}

template <class Real>
std::vector<glm::dvec3> RigidLevel<Real>::net_forces(std::span<const Vec3<Real>> residual) const {
    std::vector<glm::dvec3> forces;
    for (const Motion& m : gather(residual)) forces.emplace_back(m(0), m(1), m(2));
    return forces;
}

template <class Real>
void RigidLevel<Real>::solve(std::span<const Vec3<Real>> residual, std::span<Vec3<Real>> displacements) {
    std::vector<Motion> motions = gather(residual);
    if (is_coupled_) {
        Eigen::VectorXd right(static_cast<Eigen::Index>(6 * motions.size()));
        for (std::size_t b = 0; b < motions.size(); ++b)
            right.segment<6>(static_cast<Eigen::Index>(6 * b)) = motions[b];
        const Eigen::VectorXd found = factors_.solve(right);
        for (std::size_t b = 0; b < motions.size(); ++b)
            motions[b] = found.segment<6>(static_cast<Eigen::Index>(6 * b));
    } else {
        for (std::size_t b = 0; b < motions.size(); ++b) motions[b] = bodies_[b].inverse * motions[b];
    }
    std::fill(displacements.begin(), displacements.end(), Vec3<Real>(0));
    for_each_index(0, motions.size(), 1, [&](std::size_t b) {
        const Motion& m = motions[b];
        const glm::dvec3 s(m(0), m(1), m(2)), w(m(3), m(4), m(5));
        const Range& nodes = model_->objects[bodies_[b].object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            displacements[n] = Vec3<Real>(s + glm::cross(w, glm::dvec3(positions_[n]) - bodies_[b].center));
    });
}

template <class Real>
Motion RigidLevel<Real>::rigid_part(const Body& body, std::span<const Vec4<Real>> positions,
                                    std::span<const Real> inertia,
                                    std::span<const Vec3<Real>> displacements) const {
    const Range& nodes = model_->objects[body.object].nodes;
    glm::dvec3 sum(0.0), moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 d = static_cast<double>(inertia[n]) * glm::dvec3(displacements[n]);
        sum += d;
        moment += glm::cross(glm::dvec3(positions[n]) - body.center, d);
    }
    return body.inverse * motion(sum, moment);
}

template <class Real>
void RigidLevel<Real>::follow_rotation(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                                       std::span<Vec3<Real>> displacements,
                                       std::span<Vec3<Real>> forces) const {
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        const Body& body = bodies_[b];
        const Motion rigid = rigid_part(body, positions, inertia, displacements);
        const glm::dvec3 w(rigid(3), rigid(4), rigid(5));
        const Range& nodes = model_->objects[body.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(positions[n]) - body.center;
            displacements[n] -= Vec3<Real>(0.5 * glm::cross(w, glm::cross(w, r)));
            forces[n] += glm::cross(Vec3<Real>(w), forces[n]);
        }
    });
}

template <class Real>
void RigidLevel<Real>::rotate(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                              std::span<Vec3<Real>> displacements) const {
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        const Body& body = bodies_[b];
        const Motion rigid = rigid_part(body, positions, inertia, displacements);
        const glm::dvec3 s(rigid(0), rigid(1), rigid(2)), w(rigid(3), rigid(4), rigid(5));
        const glm::dmat3 rotation = rotation_about(w);
        const Range& nodes = model_->objects[body.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(positions[n]) - body.center;
            const glm::dvec3 rest = glm::dvec3(displacements[n]) - s - glm::cross(w, r);
            displacements[n] = Vec3<Real>(s + rotation * (r + rest) - r);
        }
    });
}

template class RigidLevel<float>;
template class RigidLevel<double>;

}  // namespace gelatin::cpu
