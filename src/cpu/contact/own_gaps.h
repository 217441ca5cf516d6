#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cpu/contact/contact_list.h"
#include "cpu/contact/own_boxes.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Looks back at steps that bodies have made as if they could not meet themselves. Where a body is looked at,
/// each of its surface nodes gets a room: as long as all are in theirs, round where an affine map has them,
/// no parts of the body are so near each other that they press. All of its functions may be called for
/// several bodies at once.
template <class Real>
class OwnGaps {
public:
    /// Looks at all bodies where the model has them.
    OwnGaps(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// Whether all surface nodes of a body are in their rooms.
    bool hold(std::uint32_t object, std::span<const Vec4<Real>> positions) const;

    /// Looks at a body where a step began: whether no parts of it have come so near each other on their way
    /// that they press. Each node goes straight, as the body sees it, which moves as a rigid one meanwhile.
    /// @param from, to [m], shape [nodes]
    /// @param between leaves out parts between which none of these boxes is at the start [m]: there are no
    /// rooms then; none: looks at all
    bool stay_open(std::uint32_t object, std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to,
                   std::optional<std::span<const AxisBox<Real>>> between = std::nullopt);

    /// Whether faces of a body overlap that have no corner in common.
    bool passes_through_itself(std::uint32_t object, std::span<const Vec4<Real>> positions);

private:
    struct Shape {
        Range places;  // of its surface nodes
        // Of where they were looked at, from their middle [1/m^2]; 0: there are no rooms.
        glm::dmat3 inverse_moment{0.0};
    };
    using Between = std::optional<std::span<const AxisBox<Real>>>;

    // True if test(walk, near) is, for all leaves of a body and what is near them with some of `between`.
    template <class Test>
    bool all_walks(std::uint32_t object, const Between& between, const Test& test) const;
    void find_ways(std::uint32_t object, std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to);
    bool look(std::uint32_t object, double searched, const Between& between);
    bool are_open(std::vector<ContactPair>& pairs);
    bool are_open_by_parts(std::span<const ContactPair> pairs) const;
    double reach(std::uint32_t object) const { return surface_->reach(object, object); }

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<Shape> shapes_;       // by object
    std::vector<Vec4<Real>> starts_;  // by node, where it was looked at, from the middle of its body [m]
    std::vector<Vec3<Real>> ways_;    // as the body sees them [m]
    // By surface node [m]: what it is in, and what else is near, are at least the mean of their nodes' values
    // farther apart than they press each other.
    std::vector<Real> apart_;
    OwnBoxes<Real> boxes_;
    std::vector<AxisBox<Real>> leaves_at_start_;  // their boxes [m]
};

}  // namespace gelatin::cpu
