#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// What a map does round a cell of a lattice: from X to Y it takes `linear` (Y - X), and besides no more than
/// `spread` |Y - X|.
template <class Real>
struct LocalMap {
    glm::mat<3, 3, Real> linear{1};
    Real least = 1;   ///< length that `linear` leaves of 1
    Real spread = 0;  ///< of its slopes

    /// What the map keeps of a distance at least.
    Real kept() const { return least - spread; }
};

/// Displacements at the points of a lattice round a body, and quadratic B-splines between them: what bends a
/// map of the body (OwnRooms). Slopes and second derivatives are between differences of neighbouring points,
/// which bounds them.
template <class Real>
class BendLattice {
public:
    using Bends = std::vector<Vec4<Real>>;  ///< by point [m]; w is 0: four lanes cost less than three
    /// Where something is: its cell, which is round a point, by the number of this and among those in use;
    /// and from the point, in cells.
    struct Place {
        std::uint32_t point = 0, used = 0;
        glm::uvec3 cell{0};
        Vec3<Real> within{0};
    };

    /// Makes the lattice anew. @param cell unless there would be too many [m]
    void surround(std::span<const Vec3<Real>> offsets, Real cell);
    bool contains(const Vec3<Real>& offset) const;
    /// Of something that it contains, whose cell is in use from now on.
    Place place(const Vec3<Real>& offset);
    /// These count for all that is fitted.
    void weigh(std::span<const Place> places);

    Real cell() const { return cell_; }  ///< [m]
    Bends straight() const { return Bends(weights_.size(), Vec4<Real>(0)); }
    Vec3<Real> bend(const Bends& bends, const Place& place) const {
        const std::array<std::size_t, 3> steps = strides();
        const std::array<Vec3<Real>, 3> weights = weights_at(place);
        const Vec4<Real>* layer = &bends[first_of(place)];
        Vec4<Real> sum(0);
        for (std::size_t z = 0; z < 3; ++z, layer += steps[2])
            for (std::size_t y = 0; y < 3; ++y) {
                const Vec4<Real>* row = layer + y * steps[1];
                sum += (weights[y].y * weights[z].z) *
                       (weights[0].x * row[0] + weights[1].x * row[1] + weights[2].x * row[2]);
            }
        return Vec3<Real>(sum);
    }
    /// Adds what is left at places, on average. @param left(k) at the k-th of them [m]
    template <class Left>
    void add(std::span<const Place> places, const Left& left, Bends& bends) const;
    /// Between those of their neighbours, where there are no places near.
    void fill_empty(Bends& bends) const;
    /// Makes bends flatter whose slope is over `most`. @return whether any was
    bool flatten(Bends& bends, Real most) const;
    /// A bound of all slopes, and so of the change of bends over any distance.
    Real steepest(const Bends& bends) const;
    /// What bounds the second derivatives of bends, found where it is asked for.
    struct Curvatures {
        std::array<std::vector<Real>, 3> bows, twists;  ///< squared, by point [m^2]: along an axis, across it
        std::vector<Real> cells;                        ///< along any direction, by cell in use [1/m]
    };
    /// Bound of how far bends within a face are from what is linear between its corners [m].
    /// @param curvatures of these bends; empty before the first call
    /// @param longest_edge of the face [m]
    Real bulge(const Bends& bends, Curvatures& curvatures, const std::array<const Place*, 3>& corners,
               Real longest_edge) const;
    /// A map with this linear part round each of the cells in use: in it and all that touch it.
    std::vector<LocalMap<Real>> local_maps(const glm::mat<3, 3, Real>& linear, const Bends& bends) const;

private:
    // Of the point before, of its own, and after, along each axis.
    static std::array<Vec3<Real>, 3> weights_at(const Place& place) {
        const Vec3<Real> before = Real(0.5f) - place.within, after = Real(0.5f) + place.within;
        return {Real(0.5f) * before * before, Real(0.75f) - place.within * place.within,
                Real(0.5f) * after * after};
    }
    std::size_t first_of(const Place& place) const {
        const std::array<std::size_t, 3> steps = strides();
        return place.point - steps[0] - steps[1] - steps[2];
    }
    // use(point, weight) for the points round a cell; weights add up to 1.
    template <class Use>
    void for_points(const Place& place, const Use& use) const {
        const std::array<std::size_t, 3> steps = strides();
        const std::array<Vec3<Real>, 3> weights = weights_at(place);
        const std::size_t first = first_of(place);
        for (std::size_t z = 0; z < 3; ++z)
            for (std::size_t y = 0; y < 3; ++y)
                for (std::size_t x = 0; x < 3; ++x)
                    use(first + x + y * steps[1] + z * steps[2], weights[x].x * weights[y].y * weights[z].z);
    }
    std::array<std::size_t, 3> strides() const { return {1, points_.x, std::size_t(points_.x) * points_.y}; }
    template <class Use>
    void for_cells(const Use& use) const;
    Real squared_slope(const Bends& bends, std::size_t first) const;
    Curvatures find_differences(const Bends& bends) const;
    Real curvature(const Curvatures& curvatures, std::size_t point) const;
    void shrink(Bends& bends, std::size_t first, Real part) const;
    void widen(std::vector<Real>& low, std::vector<Real>& high, std::size_t axis, int first, int last) const;

    Vec3<Real> low_{0};  // its first point, as an offset [m]
    Real cell_ = 1;      // [m]
    glm::uvec3 points_{1};
    std::vector<Real> weights_;                  // of the places near a point
    std::vector<std::uint32_t> used_, numbers_;  // points of cells in use; their numbers, by point
};

template <class Real>
template <class Left>
void BendLattice<Real>::add(std::span<const Place> places, const Left& left, Bends& bends) const {
    Bends sums = straight();
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Vec4<Real> here(left(k), Real(0));
        for_points(places[k], [&](std::size_t p, Real weight) { sums[p] += weight * here; });
    }
    for (std::size_t p = 0; p < sums.size(); ++p)
        if (weights_[p] > Real(0)) bends[p] += sums[p] / weights_[p];
}

}  // namespace gelatin::cpu
