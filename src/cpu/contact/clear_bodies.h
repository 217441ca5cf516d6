#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/kept_distances.h"
#include "cpu/contact/own_gaps.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Bodies that are clear of themselves: nothing of them is near anything else of them, so that nothing guards
/// them from themselves. Each step that they make is looked back at (docs/contact.md). Bodies that were set
/// to where they pass through themselves, other than with their shape at rest, count as clear until they do
/// not any more: elasticity takes them apart, which guards would not let it do.
template <class Real>
class ClearBodies {
public:
    ClearBodies(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// All are, until a step shows that one is not.
    void restart();
    bool is_clear(std::size_t object) const { return states_[object] != State::near_itself; }

    /// To be called when a step begins.
    /// @param is_near(object) whether a body that is not clear of itself is near itself
    /// @return those that are clear of themselves from now on
    template <class IsNear>
    std::vector<std::uint32_t> find(std::span<const Vec4<Real>> positions, const IsNear& is_near);

    /// Looks back at a step. Those that may have met themselves are not clear any more.
    /// @return whether there were none
    bool stay_clear(std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to);

private:
    enum class State : std::uint8_t {
        set,    // clear, as far as is known, or passing through itself
        heals,  // passing through itself since it was set
        clear,
        near_itself,
    };
    // Convex bodies that keep kKept of all distances do not meet themselves; those that have come below, once
    // they keep kKeptAgain.
    static constexpr double kKept = 0.01, kKeptAgain = 0.15;

    bool stays_open(std::uint32_t object, std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to);
    bool has_to_heal(std::uint32_t object, std::span<const Vec4<Real>> positions);

    std::shared_ptr<const Model> model_;
    KeptDistances<Real> kept_;
    OwnGaps<Real> gaps_;
    std::vector<State> states_;  // by body
    // For how many steps it is not looked at whether a body heals, or is near itself, any more.
    std::vector<std::uint8_t> waits_;
};

template <class Real>
template <class IsNear>
std::vector<std::uint32_t> ClearBodies<Real>::find(std::span<const Vec4<Real>> positions,
                                                   const IsNear& is_near) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t o = 0; o < states_.size(); ++o) {
        if (states_[o] != State::near_itself) continue;
        if (waits_[o] > 0) {
            --waits_[o];
            continue;
        }
        if (is_near(o) && !kept_.keeps(o, static_cast<Real>(kKeptAgain), positions)) continue;
        states_[o] = State::clear;
        found.push_back(o);
    }
    return found;
}

}  // namespace gelatin::cpu
