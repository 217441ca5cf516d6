#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cpu/contact/part_within.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A map of a body's surface, from where it was found to about where it is: an affine one, and what it bends,
/// at the points of a lattice, linear between them along each axis.
template <class Real>
struct ShapeMap {
    glm::mat<3, 3, Real> linear{1};
    Vec3<Real> center{0};           ///< of the middle of what was found [m]
    std::vector<Vec3<Real>> bends;  ///< [m]
    bool is_carried = false;        ///< the affine one is the nearest, not one that is only displaced
    bool is_steep = false;          ///< it could not be bent as far as it should
};

/// How far nodes may go before others of their own body could meet them. When a body is found, all its pairs
/// are listed that are nearer than a distance. Until it is found again, no others meet while each node is
/// nearer than its radius to where a map has it that keeps at least kLeastStretch of all distances. Any such
/// map will do. So it follows the body, and neither motion nor smooth deformation use up rooms
/// (docs/contact.md).
template <class Real>
class OwnRooms {
public:
    /// What maps keep of a distance, and what two nodes may each use of that.
    static constexpr double kLeastStretch = 0.53, kRoom = 0.45;
    /// Of its room, what a node may use by itself.
    static constexpr double kByNodes = 0.9;

    /// Forgets all. @param meets_themselves by object
    void restart(std::shared_ptr<const Model> model, std::vector<std::uint8_t> meets_themselves);

    bool meets_itself(std::size_t object) const {
        return !meets_themselves_.empty() && meets_themselves_[object] != 0;
    }
    /// The surface nodes of an object among all of them.
    const Range& places(std::size_t object) const { return shapes_[object].places; }

    /// The body is found where it is. Radii have to be written after this.
    /// @param cell of the lattice, unless that has too many [m]
    void find(std::uint32_t object, Real cell, std::span<const Vec4<Real>> positions);
    bool is_found(std::size_t object) const { return shapes_[object].is_found; }
    /// Some of its surface nodes are found again: about where the map has them then.
    void find_again(std::uint32_t object, std::span<const std::uint32_t> places,
                    std::span<const Vec4<Real>> positions);
    /// From the middle of its body when a surface node was found [m].
    const Vec3<Real>& offset(std::uint32_t place) const { return offsets_[place]; }
    /// Of a surface node [m].
    void set_radius(std::uint32_t place, Real radius) { radii_[place] = radius; }
    /// That of nodes that nothing is near.
    void set_largest_radius(std::uint32_t object, Real radius) { shapes_[object].largest_radius = radius; }
    Real largest_radius(std::uint32_t object) const { return shapes_[object].largest_radius; }
    Real radius(std::uint32_t place) const { return radii_[place]; }

    /// From where the map has a surface node [m].
    Vec3<Real> deviation(std::uint32_t place, const Vec3<Real>& position) const {
        return position - mapped_[place];
    }
    /// The part of a node's own motion that it may make. Some of its room is left for what its body does.
    Real part_within_room(std::uint32_t place, const Vec3<Real>& position, const Vec3<Real>& motion) const {
        if (meets_themselves_.empty()) return Real(1);
        return part_within(deviation(place, position), motion, Real(kByNodes) * radii_[place]);
    }
    /// Where the map has a surface node, and how far from there it may go by itself [m].
    Vec4<Real> room(std::uint32_t place) const {
        if (meets_themselves_.empty()) return Vec4<Real>(0, 0, 0, std::numeric_limits<float>::max());
        return Vec4<Real>(mapped_[place], Real(kByNodes) * radii_[place]);
    }
    /// How far a surface node may go in any direction [m].
    Real free_around(std::uint32_t place, const Vec3<Real>& position) const {
        if (meets_themselves_.empty()) return std::numeric_limits<Real>::infinity();
        return Real(kByNodes) * radii_[place] - glm::length(deviation(place, position));
    }
    /// The largest part of its room that a node of a body uses.
    Real used(std::uint32_t object, std::span<const Vec4<Real>> positions) const;

    const ShapeMap<Real>& map(std::size_t object) const { return shapes_[object].map; }
    /// Where a map has a surface node [m].
    Vec3<Real> mapped(std::uint32_t object, const ShapeMap<Real>& map, std::uint32_t place) const {
        return map.center + map.linear * offsets_[place] + bend(shapes_[object].lattice, map.bends, place);
    }
    /// The present map, carried to `positions` by the affine one that is nearest; by a displacement if that
    /// does not keep enough of all distances.
    ShapeMap<Real> carried(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    /// The same, and bent to `positions` as far as it may be.
    ShapeMap<Real> bent(std::uint32_t object, ShapeMap<Real> map,
                        std::span<const Vec4<Real>> positions) const;
    /// The present map, moved as all nodes are that go from `positions` to `ends` by one affine motion: they
    /// stay where they are in their rooms. None if the motion cannot be found from them.
    std::optional<ShapeMap<Real>> moved(std::uint32_t object, std::span<const Vec4<Real>> positions,
                                        std::span<const Vec4<Real>> ends) const;
    /// The part of the way from the present map to another one on which all maps between them keep enough.
    Real part_between(std::uint32_t object, const ShapeMap<Real>& to) const;
    /// What is between the present map and another one, at a part of the way.
    ShapeMap<Real> between(std::uint32_t object, const ShapeMap<Real>& to, Real part) const;
    void follow(std::uint32_t object, const ShapeMap<Real>& map);
    void shift(std::uint32_t object, const Vec3<Real>& motion);

private:
    struct Lattice {
        Vec3<Real> low{0};  // its first point, as an offset [m]
        Real cell = 1;      // [m]
        glm::uvec3 points{1};
        std::vector<Real> weights;  // of the nodes near a point
    };
    // Where a node is in the lattice: the first point of its cell, and from there in cells.
    struct InLattice {
        std::uint32_t point = 0;
        Vec3<Real> within{0};
    };
    struct Shape {
        Range places;
        bool is_found = false;
        glm::mat<3, 3, Real> inverse_moment{0};  // of the offsets [1/m^2]; 0: too flat
        Lattice lattice;
        bool can_bend = true;     // where the lattice can tell what its faces do
        Real largest_radius = 0;  // [m]
        ShapeMap<Real> map;
    };
    Real longest_edge(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    void make_lattice(Shape& shape, Real cell);
    void place_in_lattice(const Lattice& lattice, std::uint32_t place);
    template <class Use>
    void for_points(const Lattice& lattice, std::uint32_t place, const Use& use) const;
    Vec3<Real> bend(const Lattice& lattice, const std::vector<Vec3<Real>>& bends, std::uint32_t place) const;
    void fill_empty(const Lattice& lattice, std::vector<Vec3<Real>>& bends) const;
    bool flatten(const Lattice& lattice, std::vector<Vec3<Real>>& bends) const;
    Real steepest(const Lattice& lattice, const std::vector<Vec3<Real>>& bends) const;
    Vec3<Real> at(std::uint32_t place, std::span<const Vec4<Real>> positions) const {
        return Vec3<Real>(positions[model_->surface_parts.nodes[place]]);
    }
    glm::mat<3, 3, Real> moment(const Shape& shape, const Vec3<Real>& center,
                                std::span<const Vec4<Real>> positions) const;
    Vec3<Real> middle(const Range& places, std::span<const Vec4<Real>> positions) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint8_t> meets_themselves_;  // by object
    std::vector<Shape> shapes_;                   // by object
    // By surface node [m]: from the middle when its body was found; where the map has it; its room.
    std::vector<Vec3<Real>> offsets_, mapped_;
    std::vector<InLattice> in_lattice_;
    std::vector<Real> radii_;
};

}  // namespace gelatin::cpu
