#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_list.h"
#include "cpu/contact/own_boxes.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Looks back at steps that bodies have made as if they could not meet themselves.
template <class Real>
class OwnGaps {
public:
    OwnGaps(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// Whether no parts of a body have come so near each other on their way that they press: each node goes
    /// straight, as the body sees it, which moves as a rigid one meanwhile. May be called for several bodies
    /// at once. @param from, to [m], shape [nodes]
    bool stay_open(std::uint32_t object, std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to);

    /// Whether faces of a body overlap that have no corner in common. May be called for several bodies at
    /// once.
    bool passes_through_itself(std::uint32_t object, std::span<const Vec4<Real>> positions);

private:
    void find_ways(std::uint32_t object, std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to);
    // True if test(walk, near) is, for all leaves of a body.
    template <class Test>
    bool all_walks(std::uint32_t object, const Test& test) const;
    bool part_stays_open(std::uint32_t object);
    bool are_open(std::vector<ContactPair>& pairs) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    // Of a part of the way, by node: from the middle of its body, and as the body sees it [m].
    std::vector<Vec4<Real>> starts_;
    std::vector<Vec3<Real>> ways_;
    OwnBoxes<Real> boxes_;
};

}  // namespace gelatin::cpu
