#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Where a rigid body is.
struct Pose {
    glm::dvec3 center{0.0};    ///< of mass [m]
    glm::dmat3 rotation{1.0};  ///< from its shape in the model
};

/// By a vector along the axis, as long as the angle [rad]; and back.
glm::dmat3 rotation_about(const glm::dvec3& w);
glm::dvec3 rotation_vector(const glm::dmat3& rotation);

/// Keeps rigid bodies in shape: their nodes are their state, as those of others are, and move as one. Nodes
/// are rounded, so poses are known better than by them.
template <class Real>
class RigidBodies {
public:
    explicit RigidBodies(std::shared_ptr<const Model> model);

    /// Objects, ascending.
    std::span<const std::uint32_t> objects() const { return objects_; }
    bool is_rigid(std::size_t object) const { return model_->objects[object].is_rigid; }

    /// The one nearest to where nodes are, in the mean of their masses. @param positions of its nodes [m]
    Pose nearest(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    /// Bodies go where nodes are displaced, in the mean of their masses. Those that are held stay.
    /// @param positions where they begin; w: 0 for held nodes @param displacements [m], output: of the whole
    /// body @param ends output; all shape [nodes]
    void move(std::span<const Vec4<Real>> positions, std::span<Vec3<Real>> displacements,
              std::span<Vec4<Real>> ends);
    void archive(Archive& archive);
    /// Velocities become those of the bodies' momentum and angular momentum.
    void keep_velocities(Nodes<Real>& nodes) const;

private:
    Vec3<Real> place(const Pose& pose, std::uint32_t node) const {
        return Vec3<Real>(pose.center + pose.rotation * arms_[node]);
    }
    Pose mean_pose(std::uint32_t object, std::span<const glm::dvec3> positions) const;
    Pose known_pose(std::size_t body, std::span<const Vec4<Real>> positions) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> objects_;
    std::vector<std::array<Pose, 2>> known_;  // of these: where the last step began, and its end
    std::vector<glm::dvec3> arms_;            // of nodes of these in the model, from the centre of mass [m]
};

}  // namespace gelatin::cpu
