#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/motion.h"
#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How stiff bodies come down on planes among the colliders: as rigid ones. Where each of their nodes was put
/// outside by itself, that would bring far more energy into them than they have (docs/contact.md).
template <class Real>
class PlaneLanding {
public:
    /// @param wave_times of its objects [s]; must outlive this
    PlaneLanding(std::shared_ptr<const Model> model, std::span<const double> wave_times);

    /// Begins a step. @param positions input: its first guess; output: outside of planes, for stiff bodies
    /// @return whether a body may land in this step: its targets lead into a plane
    bool begin(double step, const StepObjective<Real>& objective, std::span<Vec4<Real>> positions);

    /// Whether it may, in this step: a stiff body that nothing holds.
    bool lands(std::uint32_t object) const { return lands_[object] != 0; }

    /// Changes the motion m_0 of a body to the nearest one while planes press: to the least of
    ///   1/2 (m - m_0)^T A (m - m_0) + sum_i k_i / 2 min(0, h_i(m))^2,
    /// with A the inertia, h_i the heights of surface nodes above planes, to first order, and k_i how stiff
    /// the body is at these at rest. @param origin of rotations [m]
    /// @return whether it led into a plane
    bool land(std::uint32_t object, const StepObjective<Real>& objective,
              std::span<const Vec4<Real>> positions, const glm::dvec3& origin, Motion& motion) const {
        return land(object, objective, positions, {}, origin, motion);
    }

    /// Takes the nodes of a body outside in this way, with rotations of any size.
    /// @param forces by node, on nodes that press planes already: of all but the planes, before the body
    /// moved [N]; 0 for others; empty: none
    void land(std::uint32_t object, const StepObjective<Real>& objective, std::span<const Vec3<Real>> forces,
              std::span<Vec4<Real>> positions) const;

private:
    struct Row;

    bool land(std::uint32_t object, const StepObjective<Real>& objective,
              std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> forces,
              const glm::dvec3& origin, Motion& motion) const;
    std::vector<Row> find_rows(std::uint32_t object, const StepObjective<Real>& objective,
                               std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> forces,
                               const glm::dvec3& origin, const Motion& motion) const;
    static bool limit_friction(const Motion& motion, std::vector<Row>& rows);
    bool is_inside(std::uint32_t object, std::span<const Vec4<Real>> positions,
                   const glm::dvec3& origin = glm::dvec3(0.0), const Motion& motion = Motion::Zero()) const;

    std::shared_ptr<const Model> model_;
    std::vector<float> stiffnesses_;  // of nodes [N/m]
    std::span<const double> wave_times_;
    std::vector<std::uint8_t> lands_;  // by object: stiff bodies that nothing holds, in this step
};

}  // namespace gelatin::cpu
