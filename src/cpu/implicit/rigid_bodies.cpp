#include "cpu/implicit/rigid_bodies.h"

#include <glm/geometric.hpp>
#include <utility>

#include "cpu/implicit/rigid_part.h"
#include "model/for_each_index.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

template <class Vector>
glm::dvec3 center_of(const Model& model, const Range& nodes, std::span<const Vector> positions) {
    glm::dvec3 sum(0.0);
    double mass = 0.0;
    for (std::uint32_t k = 0; k < nodes.count; ++k) {
        const auto m = static_cast<double>(model.masses[nodes.first + k]);
        sum += m * glm::dvec3(positions[k]);
        mass += m;
    }
    return sum / mass;
}

}  // namespace

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
        const glm::dvec3 center = center_of(
            *model_, nodes, std::span<const glm::vec4>(model_->positions).subspan(nodes.first, nodes.count));
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            arms_[n] = glm::dvec3(model_->positions[n]) - center;
    }
}

template <class Real>
Pose RigidBodies<Real>::pose(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Range& nodes = model_->objects[object].nodes;
    Pose pose{center_of(*model_, nodes, positions), glm::dmat3(0.0)};
    glm::dmat3 moment(0.0);
    for (std::uint32_t k = 0; k < nodes.count; ++k)
        moment += glm::outerProduct(
            static_cast<double>(model_->masses[nodes.first + k]) * (glm::dvec3(positions[k]) - pose.center),
            arms_[nodes.first + k]);
    pose.rotation = nearest_rotation(moment);
    return pose;
}

template <class Real>
void RigidBodies<Real>::keep_shapes(std::span<const Vec4<Real>> positions,
                                    std::span<Vec3<Real>> displacements) const {
    for_each_index(0, objects_.size(), 1, [&](std::size_t b) {
        const Range& nodes = model_->objects[objects_[b]].nodes;
        if (positions[nodes.first].w == Real(0)) return;
        std::vector<Vec4<Real>> wanted(nodes.count);
        for (std::uint32_t k = 0; k < nodes.count; ++k) {
            const std::uint32_t n = nodes.first + k;
            wanted[k] = Vec4<Real>(Vec3<Real>(positions[n]) + displacements[n], 0);
        }
        const Pose to = pose(objects_[b], wanted);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            displacements[n] = Vec3<Real>(to.center + to.rotation * arms_[n] - glm::dvec3(positions[n]));
    });
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
