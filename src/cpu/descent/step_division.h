#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contacts.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Decides into how many parts a step is divided, so that bodies that meet bounce: a long step of implicit
/// Euler takes up most of an impact's energy (docs/contact.md).
template <class Real>
class StepDivision {
public:
    /// @param wave_times of its objects [s]; must outlive this
    StepDivision(std::shared_ptr<const Model> model, std::span<const double> wave_times);

    /// To be called when nodes were set from outside.
    void restart();

    /// @param step to be divided [s] @param nodes that it begins with @param touched_colliders by object, in
    /// the last step
    /// @param contacts null: there is one body @param sweeps of the step
    int parts(double step, const Nodes<Real>& nodes, std::span<const std::uint8_t> touched_colliders,
              const Contacts<Real>* contacts, int sweeps);

private:
    void find_velocities(std::span<const Vec4<Real>> velocities);
    void find_speeds(double step, std::span<const Vec4<Real>> positions,
                     std::span<const std::uint8_t> touched_colliders, const Contacts<Real>* contacts);
    std::vector<glm::dvec3> find_relative(const Contacts<Real>& contacts) const;
    double plane_speed(double step, std::span<const Vec4<Real>> positions, std::size_t object) const;

    std::shared_ptr<const Model> model_;
    std::span<const double> wave_times_;
    // By object:
    std::vector<double> masses_;          // of what is not held [kg]
    std::vector<glm::dvec3> velocities_;  // mean [m/s]
    std::vector<double> speeds_;          // with which it meets others now, or kMeetsNothing [m/s]
    std::vector<double> liveliness_;      // the greatest of these, fading while it meets them [m/s]
};

}  // namespace gelatin::cpu
