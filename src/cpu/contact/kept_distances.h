#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Eight tets, one a column; the last ones of a body again where some are missing.
template <class Real>
struct TetColumns {
    static constexpr std::size_t kCount = 8;

    std::array<std::array<std::uint32_t, kCount>, 4> nodes;
    /// Of the edges that lead from the first corner at the start: entry 3 j + k is that of row k, column j
    /// [1/m].
    std::array<std::array<Real, kCount>, 9> inverses;
};

/// Some of the tets of a block.
struct LostTets {
    std::uint32_t block;
    std::uint8_t columns;  ///< a bit each
};

/// Tells of bodies whose shape is convex at the start (ContactSurface::is_convex) that they do not meet
/// themselves, without a look at any pairs. The line between two of its points X and Y is inside such a body
/// then. So, if sym(R^T F) >= c in all tets, with the gradient F of each since the start and any rotation R,
///   (x - y) . R (X - Y) >= c |X - Y|^2.
/// It holds for each single line that meets no other tets, too.
template <class Real>
class KeptDistances {
public:
    KeptDistances(std::shared_ptr<const Model> model, const ContactSurface& surface);

    /// Of a motion in which all nodes go straight: the tets that keep less than `part` at either end, with
    /// one R for both. Two points whose line at the start meets none of them keep their part all the way.
    /// May be called for several bodies at once. @pre is_convex(object)
    std::vector<LostTets> find_lost_tets(std::uint32_t object, Real part, std::span<const Vec4<Real>> from,
                                         std::span<const Vec4<Real>> to);
    /// Those that keep less elsewhere, with the same R, and are not known.
    std::vector<LostTets> find_more_lost(std::uint32_t object, Real part, std::span<const LostTets> known,
                                         std::span<const Vec4<Real>> positions) const;
    /// Round lost tets at the start [m].
    AxisBox<Real> box_of(std::uint32_t object, const LostTets& lost) const;
    bool is_convex(std::uint32_t object) const { return !shapes_[object].tets.empty(); }

private:
    struct Shape {
        std::vector<TetColumns<Real>> tets;  // empty if it is not convex
        glm::mat<3, 3, Real> turn{1};        // the last R
    };
    // True if visit(blocks, first) is, for all of a body's blocks of tets; ends early if not.
    template <class Visit>
    static bool all_blocks(const Shape& shape, const Visit& visit);
    bool keeps(const Shape& shape, Real part, std::span<const Vec4<Real>> positions) const;
    glm::mat<3, 3, Real> nearest_turn(std::uint32_t object, std::span<const Vec4<Real>> positions) const;

    std::shared_ptr<const Model> model_;
    std::vector<Shape> shapes_;  // by object
};

}  // namespace gelatin::cpu
