#pragma once

#include <functional>
#include <span>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "model/drive/attachment.h"

namespace gelatin::cpu {

/// What a motor did in the last step, in units of its row.
struct MotorMemory {
    double held = 0.0;          ///< along the axis, reversed [N]
    double speed = 0.0;         ///< [m/s]
    double acceleration = 0.0;  ///< when its force was too small last; 0: it never was [m/s^2]
};

/// The rows of a joint in a step (docs/joints.md#rows). Directions and angles change within it: rows
/// are linear about where frames are expected at its end.
template <class Real>
class JointRows {
public:
    /// @param positions when the step begins [m] @param expected displacements [m], shape [nodes]
    JointRows(const Attachment& attachment, std::span<const Vec4<Real>> positions,
              std::span<const Vec3<Real>> expected);

    /// Adds all.
    /// @param blank with what all rows of the attachment have
    /// @param stiffness_of a row by the nodes it has: of what does not yield; 0: nothing of it is free
    void add(const MotorTarget& motor, const MotorMemory& memory, double step, const ContactRow<Real>& blank,
             const std::function<Real(const ContactRow<Real>&)>& stiffness_of,
             std::vector<ContactRow<Real>>& rows) const;
    /// Along which the coordinate grows.
    Vec3<Real> axis() const { return Vec3<Real>(axis_); }
    /// What the effort is for a force along it [m] or 1.
    double scale() const { return joint_.kind == Joint::Kind::hinge ? joint_.lever : 1.0; }

private:
    // Of what a row ties, in the coordinates of both frames: 1 or 0 for the point, and of its axes.
    struct Sides {
        glm::dvec4 own, other;
    };
    ContactRow<Real> row_of(const ContactRow<Real>& blank, const Sides& sides) const;
    glm::dvec3 apart(const Sides& sides) const;
    void find_coordinate();

    const Joint& joint_;
    Frame own_, other_, own_end_, other_end_;
    double start_ = 0.0, end_ = 0.0;  // the coordinate
    // Along n the row of the coordinate has scale() times it, but for an offset.
    Sides sides_{};
    glm::dvec3 axis_{0.0};
    double offset_ = 0.0;
};

}  // namespace gelatin::cpu
