#include "cpu/implicit/rigid_bodies.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "cpu/implicit/rigid_part.h"
#include "model/for_each_index.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
glm::dmat3 rotation_about(const glm::dvec3& w) {
    const double angle = glm::length(w);
    return angle > 0.0 ? glm::mat3_cast(glm::angleAxis(angle, w / angle)) : glm::dmat3(1.0);
}

glm::dvec3 rotation_vector(const glm::dmat3& rotation) {
    glm::dquat q = glm::quat_cast(rotation);
    if (q.w < 0.0) q = -q;
    const glm::dvec3 axis(q.x, q.y, q.z);  // times the sine of half the angle
    const double sine = glm::length(axis);
    return sine > 0.0 ? 2.0 * std::atan2(sine, q.w) / sine * axis : glm::dvec3(0.0);
}

template <class Real>
RigidBodies<Real>::RigidBodies(std::shared_ptr<const Model> model)
    : model_(std::move(model)), arms_(model_->node_count()) {
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        if (!is_rigid(o)) continue;
        objects_.push_back(o);
        const Range& nodes = model_->objects[o].nodes;
        glm::dvec3 center(0.0);
        double mass = 0.0;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const auto m = static_cast<double>(model_->masses[n]);
            center += m * glm::dvec3(model_->positions[n]);
            mass += m;
        }
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            arms_[n] = glm::dvec3(model_->positions[n]) - center / mass;
    }
    known_.resize(objects_.size());
}

template <class Real>
Pose RigidBodies<Real>::mean_pose(std::uint32_t object, std::span<const glm::dvec3> positions) const {
    const std::uint32_t first = model_->objects[object].nodes.first;
    glm::dvec3 sum(0.0);
    glm::dmat3 moment(0.0);  // arms are from the centre: no matter from where positions are
    double mass = 0.0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
        const auto m = static_cast<double>(model_->masses[first + k]);
        mass += m;
        sum += m * positions[k];
        moment += glm::outerProduct(m * (positions[k] - positions[0]), arms_[first + k]);
    }
    return {sum / mass, nearest_rotation(moment)};
}

template <class Real>
Pose RigidBodies<Real>::nearest(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    return mean_pose(object, std::vector<glm::dvec3>(positions.begin(), positions.end()));
}

// That by which nodes are where they are, or the nearest, if something else has put them there.
template <class Real>
Pose RigidBodies<Real>::known_pose(std::size_t body, std::span<const Vec4<Real>> positions) const {
    const Range& nodes = model_->objects[objects_[body]].nodes;
    for (const Pose& pose : known_[body]) {
        bool is_there = true;
        for (std::uint32_t n = nodes.first; is_there && n < nodes.end(); ++n)
            is_there = place(pose, n) == Vec3<Real>(positions[n]);
        if (is_there) return pose;
    }
    return nearest(objects_[body], positions.subspan(nodes.first, nodes.count));
}

template <class Real>
void RigidBodies<Real>::move(std::span<const Vec4<Real>> positions, std::span<Vec3<Real>> displacements,
                             std::span<Vec4<Real>> ends) {
    for_each_index(0, objects_.size(), 1, [&](std::size_t b) {
        const Range& nodes = model_->objects[objects_[b]].nodes;
        if (positions[nodes.first].w == Real(0)) return;
        const Pose from = known_pose(b, positions);
        std::vector<glm::dvec3> wanted;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            wanted.push_back(from.center + from.rotation * arms_[n] + glm::dvec3(displacements[n]));
        const Pose to = mean_pose(objects_[b], wanted);
        known_[b] = {from, to};
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            ends[n] = Vec4<Real>(place(to, n), positions[n].w);
            displacements[n] = Vec3<Real>(to.center - from.center + (to.rotation - from.rotation) * arms_[n]);
        }
    });
}

template <class Real>
void RigidBodies<Real>::archive(Archive& archive) {
    archive.array(known_);
}

template <class Real>
void RigidBodies<Real>::keep_velocities(Nodes<Real>& nodes) const {
    for_each_index(0, objects_.size(), 1, [&](std::size_t b) {
        const Range& range = model_->objects[objects_[b]].nodes;
        if (nodes.positions[range.first].w == Real(0)) return;
        const RigidPart<Real> body(range, nodes);
        for (std::uint32_t n = range.first; n < range.end(); ++n)
            nodes.velocities[n] = Vec4<Real>(Vec3<Real>(body.at(nodes.positions[n])), nodes.velocities[n].w);
    });
}

template class RigidBodies<float>;
template class RigidBodies<double>;

}  // namespace gelatin::cpu
