#include "cpu/contact/clear_bodies.h"

#include <algorithm>
#include <atomic>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Steps in which a body that may have met itself is not taken to be clear of itself, or one that passes
// through itself not to have come apart.
constexpr std::uint8_t kWaits = 8;

}  // namespace

template <class Real>
ClearBodies<Real>::ClearBodies(std::shared_ptr<const Model> model,
                               std::shared_ptr<const ContactSurface> surface)
    : model_(model),
      kept_(model, *surface),
      gaps_(model, surface),
      states_(model->body_count(), State::set),
      waits_(model->body_count()) {}

template <class Real>
void ClearBodies<Real>::restart() {
    std::fill(states_.begin(), states_.end(), State::set);
    std::fill(waits_.begin(), waits_.end(), std::uint8_t(0));
}

template <class Real>
bool ClearBodies<Real>::stay_clear(std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to) {
    std::atomic<bool> all = true;
    for_each_index(0, states_.size(), 1, [&](std::size_t index) {
        const auto o = static_cast<std::uint32_t>(index);
        State& state = states_[o];
        if (state == State::near_itself) return;
        if (state == State::heals) {
            if (waits_[o] > 0) {
                --waits_[o];
            } else if (gaps_.passes_through_itself(o, to)) {
                waits_[o] = kWaits;
            } else {
                state = State::clear;
            }
            return;
        }
        if (gaps_.hold(o, to) || stays_open(o, from, to)) return;
        waits_[o] = kWaits;
        state = state == State::set && has_to_heal(o, from) ? State::heals : State::near_itself;
        if (state == State::near_itself) all = false;
    });
    return all;
}

// Of a convex body, only what has lost tets between its parts is looked at.
template <class Real>
bool ClearBodies<Real>::stays_open(std::uint32_t object, std::span<const Vec4<Real>> from,
                                   std::span<const Vec4<Real>> to) {
    if (!kept_.is_convex(object)) return gaps_.stay_open(object, from, to);
    const std::vector<AxisBox<Real>> lost = kept_.find_lost(object, static_cast<Real>(kKept), to);
    return lost.empty() || gaps_.stay_open(object, from, to, lost);
}

template <class Real>
bool ClearBodies<Real>::has_to_heal(std::uint32_t object, std::span<const Vec4<Real>> positions) {
    if (!gaps_.passes_through_itself(object, positions)) return false;
    const std::vector<Vec4<Real>> at_rest(model_->positions.begin(), model_->positions.end());
    return !gaps_.passes_through_itself(object, at_rest);
}

template class ClearBodies<float>;
template class ClearBodies<double>;

}  // namespace gelatin::cpu
