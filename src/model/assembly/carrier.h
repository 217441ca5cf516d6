#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "mesh/carry_surface.h"
#include "mesh/lattice/face_tree.h"
#include "mesh/lattice/solid_angles.h"
#include "mesh/tet_mesh.h"
#include "model/drive/joint.h"
#include "model/model.h"

namespace gelatin {

/// Of its nodes [m].
std::vector<glm::dvec3> positions_of_object(const ModelObject& object, std::span<const glm::vec4> positions);

/// What carries points of an object: the tets of a body; four nodes, as far apart as possible, of what is
/// rigid, a rigid body or a collider's surface; of a surface that changes its shape the nearest face and one
/// node more.
class Carrier {
public:
    /// @param positions of all nodes [m]
    Carrier(const Model& model, std::uint32_t object, std::span<const glm::vec4> positions);
    Carrier(const Carrier&) = delete;
    Carrier& operator=(const Carrier&) = delete;

    const std::string& name() const { return object_.name; }
    /// The median one of the surface [m].
    double edge() const { return edge_; }
    bool is_rigid() const { return is_rigid_; }
    /// Whether a point is within it, or its surface nearer than `most` [m].
    bool is_near(const glm::dvec3& point, double most) const;
    /// Whether it can: a sheet, which is flat, says nothing of what is beside it.
    bool can_carry() const;

    std::vector<CarriedVertex> carry(const std::vector<glm::dvec3>& points) const;
    /// A point alone: without axes.
    CarriedFrame carry_point(const glm::dvec3& point) const;
    /// @pre is_rigid() and can_carry()
    CarriedFrame carry_frame(const Frame& frame) const;
    /// How far the four nodes are from their mean [m].
    double size() const;

private:
    void find_frame();
    glm::dmat3 frame_edges() const;
    glm::dvec4 weights_of(const glm::dvec3& vector) const;
    CarriedVertex carry_by_frame(const glm::dvec3& point) const;
    CarriedVertex carry_by_face(const glm::dvec3& point) const;

    const ModelObject& object_;
    bool is_rigid_, is_surface_;
    TetMesh mesh_;
    double edge_;
    lattice::FaceTree hull_;
    lattice::SolidAngles winding_number_;
    glm::uvec4 frame_{0};  // of what is rigid
};

}  // namespace gelatin
