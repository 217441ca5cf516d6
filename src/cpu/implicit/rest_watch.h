#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/drive/pulls.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Knows which bodies rest, so that steps may leave them out until something drives them or comes near
/// (docs/contact.md). Bodies that touch each other begin to rest together, and are woken together.
template <class Real>
class RestWatch {
public:
    /// @param thicknesses of objects [m]
    RestWatch(std::shared_ptr<const Model> model, std::span<const double> thicknesses);

    /// Wakes all. To be called when nodes were set from outside.
    void restart();
    void archive(Archive& archive);

    /// What acts in the step that comes next.
    struct Drive {
        double step;                                ///< [s]
        std::span<const Vec4<Real>> positions;      ///< at its start, with held nodes in their new places
        std::span<const float> load_factors;        ///< of the model's loads
        const Pulls<Real>* pulls;                   ///< null: no hand holds anything
        std::span<const Vec3<Real>> held_at;        ///< where the last step left held nodes [m],
                                                    ///< shape [Model::handle_nodes]
        std::span<const std::uint32_t> moved = {};  ///< bodies that motors or gas move
    };
    /// Wakes those that are driven. @return whether a step has nothing to do: all rest, and no collider moves
    bool begin(const Drive& drive);
    /// When it has ended. @param islands numbers of bodies that touch each other, shape [bodies]
    void end(std::span<const std::uint32_t> islands);

    /// Of bodies.
    std::span<const std::uint8_t> asleep() const { return asleep_; }
    /// Holds the nodes of all that rest. @param nodes inverse masses and velocities become 0
    void hold(Nodes<Real>& nodes) const;
    /// Lets them go: gives them their inverse masses back.
    void release(Nodes<Real>& nodes) const;
    /// Wakes a body, and what it touched, and lets them go.
    void wake(std::uint32_t body, Nodes<Real>& nodes);

private:
    void wake(std::uint32_t body);
    bool wake_moved(const Drive& drive);
    bool leaves_place(const Range& nodes, Real most, std::span<const Vec4<Real>> positions) const;
    template <class Visit>
    void for_nodes_asleep(const Visit& visit) const;

    std::shared_ptr<const Model> model_;
    std::vector<double> thicknesses_;
    std::vector<Vec4<Real>> places_;      // that nodes have kept to; empty at the start
    std::vector<double> times_;           // for which bodies have [s]
    std::vector<std::uint8_t> asleep_;    // bodies
    std::vector<std::uint32_t> islands_;  // in which they fell asleep
    std::vector<float> load_factors_;
};

}  // namespace gelatin::cpu
