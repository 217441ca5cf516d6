#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

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

/// Keeps rigid bodies in shape: their nodes are their state, as those of others are, and move as one.
template <class Real>
class RigidBodies {
public:
    explicit RigidBodies(std::shared_ptr<const Model> model);

    /// Objects, ascending.
    std::span<const std::uint32_t> objects() const { return objects_; }
    bool is_rigid(std::size_t object) const { return model_->objects[object].is_rigid; }

    /// The one nearest to where nodes are, in the mean of their masses. @param positions of its nodes [m]
    Pose pose(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    /// Displacements become those of the nearest poses. @param positions where they begin [m], shape [nodes];
    /// bodies with nodes whose w is 0 are left out
    void keep_shapes(std::span<const Vec4<Real>> positions, std::span<Vec3<Real>> displacements) const;
    /// Velocities become those of the bodies' momentum and angular momentum.
    void keep_velocities(Nodes<Real>& nodes) const;

private:
    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> objects_;
    std::vector<glm::dvec3> arms_;  // of nodes of these in the model, from the centre of mass [m]
};

}  // namespace gelatin::cpu
