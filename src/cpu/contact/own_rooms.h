#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/bend_lattice.h"
#include "cpu/contact/part_within.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A map of a body's surface, from where it was found to about where it is: an affine one, and what it bends.
template <class Real>
struct ShapeMap {
    glm::mat<3, 3, Real> linear{1};
    Vec3<Real> center{0};                     ///< of the middle of what was found [m]
    typename BendLattice<Real>::Bends bends;  ///< [m]
    Real least = 1, slope = 0;                ///< length that `linear` leaves of 1; bound of that of bends
    std::vector<LocalMap<Real>> around;       ///< by cell of the lattice that is in use
};

/// A map that a body may follow. By surface node of the body: where the map has it, and the radius of its
/// room there.
template <class Real>
struct MapAhead {
    ShapeMap<Real> map;
    std::vector<Vec3<Real>> mapped;  ///< [m]
    std::vector<Real> rooms;         ///< [m]

    void displace(const Vec3<Real>& displacement) {
        map.center += displacement;
        for (Vec3<Real>& place : mapped) place += displacement;
    }
};

/// How far nodes may go before others of their own body could meet them. When a body is found, all its pairs
/// are listed that are nearer than a distance. Until it is found again, no others meet while each node is in
/// its room: round where a map has it, with a radius by what this map keeps of the distances near the node.
/// Any map will do that keeps some of all distances. So it follows the body, and neither motion nor smooth
/// deformation use up rooms (docs/contact.md).
template <class Real>
class OwnRooms {
public:
    /// What two nodes may each use of what a map leaves of the distance between what they are in; of that,
    /// what a node may use by itself.
    static constexpr double kRoom = 0.45, kByNodes = 0.9;
    /// What all maps keep of any distance; and what rooms with bends, and those between two maps, may use up.
    static constexpr double kLeastKept = 0.3, kRoomBent = 0.47, kRoomBetween = 0.49;
    /// Of a cell of the lattice: what is farther apart than this is kept apart by what maps keep of any
    /// distance.
    static constexpr double kNear = 0.5;

    /// Forgets all. @param meets_themselves by object
    void restart(std::shared_ptr<const Model> model, std::vector<std::uint8_t> meets_themselves);

    bool meets_itself(std::size_t object) const {
        return !meets_themselves_.empty() && meets_themselves_[object] != 0;
    }
    /// Nothing is known of the body any more. @param meets_itself if not, its nodes have room for any motion
    void forget(std::uint32_t object, bool meets_itself);
    /// The surface nodes of an object among all of them.
    const Range& places(std::size_t object) const { return shapes_[object].places; }

    /// The body is found where it is. What its nodes are apart has to be told after this.
    /// @param cell of the lattice, unless that has too many, or edges are too long for it [m]
    void find(std::uint32_t object, Real cell, std::span<const Vec4<Real>> positions);
    bool is_found(std::size_t object) const { return shapes_[object].is_found; }
    /// Some of its surface nodes are found again: about where the map has them then.
    /// @return false if the body has to be found as a whole
    bool find_again(std::uint32_t object, std::span<const std::uint32_t> places,
                    std::span<const Vec4<Real>> positions);
    /// From the middle of its body when a surface node was found [m].
    const Vec3<Real>& offset(std::uint32_t place) const { return offsets_[place]; }
    /// Of the faces that a surface node is in, when it was found [m].
    Real longest_edge_at(std::uint32_t place) const { return longest_edges_[place]; }
    /// The most that may be told to be apart [m].
    Real most_apart(std::uint32_t object) const {
        return static_cast<Real>(kLeastKept * kNear) * shapes_[object].lattice.cell();
    }
    /// How far apart what a surface node is in and what is not listed with it are at least [m], when it was
    /// found. Of two nodes that are told different distances, the mean of both is meant.
    void set_apart(std::uint32_t place, Real apart) { apart_[place] = apart; }
    /// All of a body's were set: its rooms follow from these.
    void make_rooms(std::uint32_t object);

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
    /// The part of its room that a surface node uses.
    Real used_by(std::uint32_t place, const Vec3<Real>& position) const {
        const Real used = glm::length(deviation(place, position));
        return radii_[place] > Real(0) ? used / radii_[place] : std::numeric_limits<Real>::infinity();
    }
    /// The largest part of its room that a node of a body uses.
    Real used(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    /// Whether rooms would hardly be larger if the body was found where it is: the map keeps at least this
    /// part of distances everywhere.
    bool keeps(std::uint32_t object, Real part) const;

    const ShapeMap<Real>& map(std::size_t object) const { return shapes_[object].map; }
    /// That in the middle of which it would be if the body was found now [m].
    Real fresh_radius(std::uint32_t place) const { return Real(kRoom) * apart_[place]; }

    /// The present map, displaced.
    MapAhead<Real> displaced(std::uint32_t object, const Vec3<Real>& displacement) const;
    /// The present map, moved by the rigid motion that is nearest to the way from `positions` to `ends`:
    /// rooms stay as large as they are.
    MapAhead<Real> moved(std::uint32_t object, std::span<const Vec4<Real>> positions,
                         std::span<const Vec4<Real>> ends) const;
    /// The one that is nearest to `positions`, as far as it keeps enough of all distances: an affine one, or
    /// else the present one displaced, and bent.
    MapAhead<Real> fitted(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    /// The part of the way from the present map to another one on which rooms between both hold, too.
    Real part_between(std::uint32_t object, const ShapeMap<Real>& to) const;
    /// What is between the present map and another one, at a part of the way.
    MapAhead<Real> between(std::uint32_t object, const ShapeMap<Real>& to, Real part) const;
    void follow(std::uint32_t object, const MapAhead<Real>& ahead);
    void shift(std::uint32_t object, const Vec3<Real>& motion);

private:
    struct Shape {
        Range places;
        bool is_found = false;
        glm::mat<3, 3, Real> inverse_moment{0};  // of the offsets [1/m^2]; 0: too flat
        BendLattice<Real> lattice;
        ShapeMap<Real> map;
    };
    Real longest_edge(std::uint32_t object);
    ShapeMap<Real> carried(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    Vec3<Real> mapped(const Shape& shape, const ShapeMap<Real>& map, std::uint32_t place) const {
        return map.center + map.linear * offsets_[place] + shape.lattice.bend(map.bends, in_lattice_[place]);
    }
    MapAhead<Real> completed(std::uint32_t object, ShapeMap<Real> map) const;
    std::vector<Real> find_rooms(std::uint32_t object, ShapeMap<Real>& map) const;
    Vec3<Real> at(std::uint32_t place, std::span<const Vec4<Real>> positions) const {
        return Vec3<Real>(positions[model_->surface_parts.nodes[place]]);
    }
    std::span<const typename BendLattice<Real>::Place> in_lattice(const Shape& shape) const {
        return std::span(in_lattice_).subspan(shape.places.first, shape.places.count);
    }
    glm::mat<3, 3, Real> moment(const Shape& shape, const Vec3<Real>& center,
                                std::span<const Vec4<Real>> positions) const;
    Vec3<Real> middle(const Range& places, std::span<const Vec4<Real>> positions) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint8_t> meets_themselves_;  // by object
    std::vector<Shape> shapes_;                   // by object
    std::vector<glm::uvec3> corners_;             // of faces, among the surface nodes
    // By surface node [m]: from the middle when its body was found; where the map has it; what it is in and
    // is not listed is as far apart; its room; the longest edge of its faces when it was found.
    std::vector<Vec3<Real>> offsets_, mapped_;
    std::vector<Real> apart_, radii_, longest_edges_;
    std::vector<Real> face_edges_;  // the longest of each face when it was found [m]
    std::vector<typename BendLattice<Real>::Place> in_lattice_;
};

}  // namespace gelatin::cpu
