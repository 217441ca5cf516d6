#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"

namespace gelatin::cpu {

/// Objects that start nearer to each other than they press (ContactSurface::reach): what their contacts would
/// hold as energy would throw them apart. So they press from the gap that they have, and their reach grows to
/// all of it within a third of a second.
template <class Real>
class EasedReaches {
public:
    explicit EasedReaches(std::shared_ptr<const ContactSurface> surface) : surface_(std::move(surface)) {}

    /// Finds which these are. @param list that was found there
    void begin(const ContactList<Real>& list, std::span<const Vec4<Real>> positions);
    void forget() { parts_.clear(); }

    bool any() const { return !parts_.empty(); }

    /// After `seconds` [s].
    void grow(double seconds);
    /// Sets the reach of pairs.
    void set(std::span<ContactPair> pairs) const;

private:
    using Objects = std::pair<std::uint32_t, std::uint32_t>;  // the lower one first
    static Objects objects_of(const ContactPair& pair) { return std::minmax(pair.object, pair.other); }

    std::shared_ptr<const ContactSurface> surface_;
    std::map<Objects, double> parts_;  // of the whole reach
};

}  // namespace gelatin::cpu
