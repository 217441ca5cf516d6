#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "model/for_each_index.h"
#include "model/range.h"

namespace gelatin::cpu {

/// Rows between the same two objects, one after the other.
struct RowPair {
    std::uint32_t object, other;  ///< as in ContactRow
    Range rows{0, 0};
};

/// The rows of an island in a solve; what it writes is its owner's.
template <class Real>
struct IslandRows {
    std::span<ContactRow<Real>> rows;
    std::span<RowTangent<Real>> tangents;
    std::span<Vec3<Real>> forces;  ///< on second sides [N]
    std::span<Vec3<Real>> slips;   ///< s [m]

    std::size_t count() const { return rows.size(); }
    /// force_of(row number)
    template <class ForceOf>
    void set_forces(const ForceOf& force_of) const {
        for_each_index(count(), [&](std::size_t r) { forces[r] = force_of(r); });
    }
    /// At the slips: tangents, or forces.
    void find_tangents() const;
    void find_forces() const;
    /// In place of tangents, for a first step that closes gaps: from the gap at the start to the one
    /// expected.
    void find_chords(std::span<const Vec3<Real>> expected_slips) const;
    /// Friction is limited by what presses at the slips.
    void set_limits() const;
    /// How far along a direction the objective falls, by at most all of it. @param changes of slips
    /// @param base what pulls along it without rows, and by how much less it does so at its end [J]
    double line_search(std::span<const Vec3<Real>> changes, double base, double curvature) const;
};

}  // namespace gelatin::cpu
