#include "cpu/contact/eased_reaches.h"

#include <algorithm>

#include "cpu/contact/nearest_pairs.h"

namespace gelatin::cpu {
namespace {

// Bodies are apart as far as they press after so long [s]: their speed is their reach by that.
constexpr double kGrowth = 1.0 / 3.0;
// Of the whole reach, however near they start.
constexpr double kLeastPart = 1.0 / 256.0;

}  // namespace

template <class Real>
void EasedReaches<Real>::begin(const ContactList<Real>& list, std::span<const Vec4<Real>> positions) {
    parts_.clear();
    const auto look_at = [&](std::span<const ContactPair> pairs) {
        for_measured<Real>(pairs, positions, [&](std::size_t p, const auto& measured, std::size_t column) {
            const ContactPair& pair = pairs[p];
            const double part = static_cast<double>(measured.gaps[column]) / static_cast<double>(pair.reach);
            if (pair.is_own() || !(part < 1.0)) return;
            double& least = parts_.try_emplace(objects_of(pair), 1.0).first->second;
            least = std::clamp(part, kLeastPart, least);
        });
    };
    const std::span pairs(list.pairs);  // measured are those of one kind
    look_at(pairs.first(list.first_edges));
    look_at(pairs.subspan(list.first_edges));
}

template <class Real>
void EasedReaches<Real>::grow(double seconds) {
    for (auto& [objects, part] : parts_) part += seconds / kGrowth;
    std::erase_if(parts_, [](const auto& eased) { return eased.second >= 1.0; });
}

template <class Real>
void EasedReaches<Real>::set(std::span<ContactPair> pairs) const {
    for (ContactPair& pair : pairs) {
        if (pair.is_own()) continue;
        const auto eased = parts_.find(objects_of(pair));
        const double part = eased == parts_.end() ? 1.0 : eased->second;
        pair.reach = static_cast<float>(part * surface_->reach(pair.object, pair.other));
    }
}

template class EasedReaches<float>;
template class EasedReaches<double>;

}  // namespace gelatin::cpu
