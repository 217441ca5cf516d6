#include "cpu/implicit/rigid_level.h"

#include <Eigen/LU>

#include <algorithm>
#include <glm/matrix.hpp>
#include <utility>

#include "cpu/implicit/rigid_bodies.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
RigidLevel<Real>::RigidLevel(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      numbers_(model_->objects.size(), kNoNode),
      body_of_(model_->node_count(), kNoNode),
      arms_(model_->node_count()) {}

template <class Real>
void RigidLevel<Real>::begin(std::span<const Vec4<Real>> positions, std::span<const Real> inertia) {
    bodies_.clear();
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        const auto first = inertia.begin() + nodes.first;
        const bool is_free = std::all_of(first, first + nodes.count, [](Real i) { return i > Real(0); });
        numbers_[o] = is_free ? static_cast<std::uint32_t>(bodies_.size()) : kNoNode;
        if (is_free) bodies_.push_back({o});
    }
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        std::fill_n(body_of_.begin() + nodes.first, nodes.count, numbers_[o]);
        if (numbers_[o] == kNoNode) return;
        Body& body = bodies_[numbers_[o]];
        const glm::dvec3 origin(positions[nodes.first]);
        RigidSums sums;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sums.add(glm::dvec3(positions[n]) - origin, static_cast<double>(inertia[n]), glm::dvec3(0.0));
        const glm::dvec3 middle = sums.arm / sums.stiffness;
        body.center = origin + middle;
        body.weight = sums.stiffness / model_->objects[o].mass;
        sums.square.add_outer(-sums.stiffness, middle);
        sums.arm = glm::dvec3(0.0);
        body.matrix = inertia_matrix(sums);
        body.inverse = body.matrix.inverse();
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            arms_[n] = Vec3<Real>(glm::dvec3(positions[n]) - body.center);
    });
}

template <class Real>
Motion RigidLevel<Real>::velocity(std::size_t object, std::span<const Vec4<Real>> velocities) const {
    const Range& nodes = model_->objects[object].nodes;
    glm::dvec3 momentum(0.0), angular(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 p = static_cast<double>(model_->masses[n]) * glm::dvec3(velocities[n]);
        momentum += p;
        angular += glm::cross(glm::dvec3(arms_[n]), p);
    }
    const Body& body = bodies_[numbers_[object]];
    return body.weight * (body.inverse * motion(momentum, angular));
}

template <class Real>
Vec3<Real> RigidLevel<Real>::relative(const ContactRow<Real>& row, std::span<const Motion> motions) const {
    Vec3<Real> s(0);
    for (std::uint32_t k = 0; k < row.count; ++k)
        if (body_of_[row.nodes[k]] != kNoNode) s += row.weights[k] * at(row.nodes[k], motions);
    return s;
}

template <class Real>
Motion RigidLevel<Real>::rigid_part(std::size_t object, std::span<const Real> inertia,
                                    std::span<const Vec3<Real>> displacements) const {
    const Range& nodes = model_->objects[object].nodes;
    glm::dvec3 sum(0.0), moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 d = static_cast<double>(inertia[n]) * glm::dvec3(displacements[n]);
        sum += d;
        moment += glm::cross(glm::dvec3(arms_[n]), d);
    }
    return inverse(object) * motion(sum, moment);
}

template <class Real>
void RigidLevel<Real>::make_rigid(std::size_t object, std::span<const Real> inertia,
                                  std::span<Vec3<Real>> displacements) const {
    const Motion part = rigid_part(object, inertia, displacements);
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) displacements[n] = displacement(part, arms_[n]);
}

template <class Real>
void RigidLevel<Real>::follow_rotation(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                                       std::span<Vec3<Real>> displacements, std::span<Vec3<Real>> forces) {
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        Body& body = bodies_[b];
        const glm::dvec3 w = body.rotation = rotation(rigid_part(body.object, inertia, displacements));
        const Range& nodes = model_->objects[body.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(positions[n]) - body.center;
            displacements[n] -= Vec3<Real>(0.5 * glm::cross(w, glm::cross(w, r)));
            forces[n] += glm::cross(Vec3<Real>(w), forces[n]);
        }
    });
}

template <class Real>
Vec3<Real> RigidLevel<Real>::added_by_rotation(const ContactRow<Real>& row) const {
    Vec3<Real> sum(0);
    for (std::uint32_t k = 0; k < row.count; ++k) {
        const std::uint32_t b = body_of_[row.nodes[k]];
        if (b == kNoNode || model_->objects[bodies_[b].object].is_rigid) continue;
        const Vec3<Real> w(bodies_[b].rotation);
        sum += Real(0.5) * row.weights[k] * glm::cross(w, glm::cross(w, arms_[row.nodes[k]]));
    }
    return sum;
}

template <class Real>
void RigidLevel<Real>::rotate(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                              std::span<Vec3<Real>> displacements) const {
    for_each_index(0, bodies_.size(), 1, [&](std::size_t b) {
        const Body& body = bodies_[b];
        const Motion rigid = rigid_part(body.object, inertia, displacements);
        const glm::dvec3 s = translation(rigid), w = rotation(rigid);
        const glm::dmat3 turn = rotation_about(w);
        const Range& nodes = model_->objects[body.object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 r = glm::dvec3(positions[n]) - body.center;
            const glm::dvec3 rest = glm::dvec3(displacements[n]) - s - glm::cross(w, r);
            displacements[n] = Vec3<Real>(s + turn * (r + rest) - r);
        }
    });
}

template class RigidLevel<float>;
template class RigidLevel<double>;

}  // namespace gelatin::cpu
