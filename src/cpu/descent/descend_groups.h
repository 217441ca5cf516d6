#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu/descent/spring_blocks.h"
#include "cpu/elasticity/elements.h"
#include "cpu/elasticity/tet_blocks.h"

namespace gelatin::cpu {

/// Groups that a thread takes at a time, at least.
constexpr std::size_t kGroupsATask = 16;

/// NodeTerms of a group of rows, in columns.
struct alignas(32) TermColumns {
    using Column = std::array<float, kGroup>;
    std::array<Column, 3> force{}, diagonal{}, beside{};

    NodeTerms<float> row(std::size_t r) const;
    void add(std::size_t r, const NodeTerms<float>& terms);
};

/// A test that most nodes pass at once: those behind it may be inside a collider.
struct ColliderBound {
    glm::vec4 place;  ///< a plane's normal and offset, or a centre and the square of a radius [m, m^2]
    bool is_plane;
};
std::vector<ColliderBound> make_collider_bounds(std::span<const Collider> colliders);

/// The tets of a step.
struct DescentTets {
    const TetBlocks& blocks;
    const TetOffsets& offsets;          ///< empty without a volume term
    std::span<const glm::vec4> starts;  ///< xyz when the step began [m], damping time [s], shape [nodes]
    float inverse_step;                 ///< [1/s]
};

/// What a sweep of vertex block descent reads.
struct DescentGroups {
    const SpringBlocks& springs;  ///< their dampers in them
    DescentTets tets;
    std::span<const std::uint32_t> nodes;  ///< of each row, or kNoNode
    std::span<const glm::vec4> targets;    ///< y [m], m / h^2 [N/m], 0 where a node is held; shape [nodes]
    std::span<const ColliderBound> colliders;
};

/// What inertia, springs and tets, but for flat ones, add to the force on each node of a group.
/// @param terms of which only the forces change
void gather_group_forces(const DescentGroups& from, std::size_t group, std::span<const glm::vec4> positions,
                         TermColumns& terms);

/// Newton's step of each node of a group that is not held, with SIMD for the processor it runs on.
/// @param terms what flat tets add; those of all other elements are added to it
/// @return a bit for each row: whether its node may have come into a collider
std::uint32_t descend_group(const DescentGroups& from, std::size_t group, TermColumns& terms,
                            std::span<glm::vec4> positions);

}  // namespace gelatin::cpu
