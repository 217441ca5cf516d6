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
      is_clear_(model->body_count()),
      heals_(model->body_count()),
      was_set_(model->body_count()),
      waits_(model->body_count()) {
    restart();
}

template <class Real>
void ClearBodies<Real>::restart() {
    std::fill(is_clear_.begin(), is_clear_.end(), std::uint8_t(1));
    std::fill(heals_.begin(), heals_.end(), std::uint8_t(0));
    std::fill(was_set_.begin(), was_set_.end(), std::uint8_t(1));
    std::fill(waits_.begin(), waits_.end(), std::uint8_t(0));
}

template <class Real>
bool ClearBodies<Real>::stay_clear(std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to) {
    std::atomic<bool> all = true;
    for_each_index(0, is_clear_.size(), 1, [&](std::size_t index) {
        const auto o = static_cast<std::uint32_t>(index);
        if (is_clear_[o] == 0) return;
        if (heals_[o] != 0) {
            if (waits_[o]-- > 0) return;
            heals_[o] = gaps_.passes_through_itself(o, to) ? 1 : 0;
            waits_[o] = heals_[o] != 0 ? kWaits : 0;
            return;
        }
        if (gaps_.hold(o, to) || kept_.keeps(o, static_cast<Real>(kKept), to) || gaps_.stay_open(o, from, to))
            return;
        waits_[o] = kWaits;
        if (was_set_[o] != 0 && has_to_heal(o, from)) {
            heals_[o] = 1;
            return;
        }
        was_set_[o] = 0;
        is_clear_[o] = 0;
        all = false;
    });
    return all;
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
