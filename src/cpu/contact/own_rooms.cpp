#include "cpu/contact/own_rooms.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "cpu/contact/least_stretch.h"
#include "model/collision/surface_parts.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

// The linear part of a map leaves at least this of a length.
constexpr double kLeastLinear = 0.5;
// Of the least and greatest part of distances that must be kept: for rounding.
constexpr double kMargin = 0.98;
// In cells: longer edges of faces reach over what a map is known to do near their ends. A point of a face is
// no farther from a corner than the edge by the root of three, and kNear leads on from there.
constexpr double kLongestEdge = 0.85;
static_assert(kLongestEdge * 0.5774 + OwnRooms<double>::kNear <= 1.0);
// What bends moves a node by, changes with where it is found: each correction leaves at most 0.7 of the rest.
constexpr int kCorrections = 8;
// Of the mean square of the offsets: bodies that are flatter are displaced, but not otherwise mapped.
constexpr double kFlat = 1e-6;
// Of rooms of bodies that do not meet themselves [m]; its square is a number on devices, too.
constexpr double kAnyMotion = 1e15;

template <class Real>
Real squared_norm(const glm::mat<3, 3, Real>& m) {
    return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
}

// Of a symmetric matrix, or 0 if it is nearly singular.
template <class Real>
glm::mat<3, 3, Real> safe_inverse(const glm::mat<3, 3, Real>& m) {
    const Real mean = (m[0][0] + m[1][1] + m[2][2]) / Real(3);
    if (!(glm::determinant(m) > static_cast<Real>(kFlat) * mean * mean * mean))
        return glm::mat<3, 3, Real>(0);
    return glm::inverse(m);
}

// How steep the bends of a map with this linear part may be.
template <class Real>
Real most_slope(const glm::mat<3, 3, Real>& linear) {
    return least_stretch(linear) - static_cast<Real>(OwnRooms<double>::kLeastKept);
}

// The part of the way from a map to another one, with linear parts that leave at least `least` of a length,
// on which all between them do that leave `kept`: L and M leave the lesser of both squares, less |L - M|^2
// / 4.
template <class Real>
Real part_kept(Real least, Real kept, Real squared_turn) {
    const Real allowed = Real(4) * (least * least - kept * kept);
    if (!(allowed > Real(0))) return Real(0);
    return squared_turn > allowed ? std::sqrt(allowed / squared_turn) : Real(1);
}

}  // namespace

template <class Real>
void OwnRooms<Real>::restart(std::shared_ptr<const Model> model, std::vector<std::uint8_t> meets_themselves) {
    model_ = std::move(model);
    meets_themselves_ = std::move(meets_themselves);
    const SurfaceParts& parts = model_->surface_parts;
    shapes_.assign(model_->objects.size(), {});
    for (std::size_t o = 0; o < shapes_.size(); ++o) {
        shapes_[o].places = surface_places(parts, model_->objects[o].faces);
    }
    const std::size_t count = parts.nodes.size();
    in_lattice_.assign(count, {});
    offsets_.assign(count, Vec3<Real>(0));
    mapped_.assign(count, Vec3<Real>(0));
    radii_.assign(count, static_cast<Real>(kAnyMotion));
    apart_.assign(count, Real(0));
    longest_edges_.assign(count, Real(0));
    face_edges_.assign(model_->faces.size(), Real(0));
    std::vector<std::uint32_t> places(model_->node_count());
    for (std::uint32_t s = 0; s < count; ++s) places[parts.nodes[s]] = s;
    corners_.clear();
    for (const Face& face : model_->faces)
        corners_.emplace_back(places[face.a], places[face.b], places[face.c]);
}

template <class Real>
void OwnRooms<Real>::forget(std::uint32_t object, bool meets_itself) {
    const Range& places = shapes_[object].places;
    meets_themselves_[object] = meets_itself ? 1 : 0;
    shapes_[object].is_found = false;
    std::fill_n(radii_.begin() + places.first, places.count, static_cast<Real>(kAnyMotion));
    std::fill_n(mapped_.begin() + places.first, places.count, Vec3<Real>(0));
}

// Relative to the first of them, for precision.
template <class Real>
Vec3<Real> OwnRooms<Real>::middle(const Range& places, std::span<const Vec4<Real>> positions) const {
    const Vec3<Real> first = at(places.first, positions);
    Vec3<Real> sum(0);
    for (std::uint32_t s = places.first; s < places.end(); ++s) sum += at(s, positions) - first;
    return first + sum / static_cast<Real>(places.count);
}

template <class Real>
void OwnRooms<Real>::find(std::uint32_t object, Real cell, std::span<const Vec4<Real>> positions) {
    Shape& shape = shapes_[object];
    const Range& places = shape.places;
    shape.is_found = true;
    shape.map = {};
    shape.map.center = middle(places, positions);
    glm::mat<3, 3, Real> moment(0);
    for (std::uint32_t s = places.first; s < places.end(); ++s) {
        mapped_[s] = at(s, positions);
        offsets_[s] = mapped_[s] - shape.map.center;
        moment += glm::outerProduct(offsets_[s], offsets_[s]);
    }
    shape.inverse_moment = safe_inverse(moment);
    const Real least_cell = longest_edge(object) / static_cast<Real>(kLongestEdge);
    shape.lattice.surround(std::span(offsets_).subspan(places.first, places.count),
                           std::max(cell, Real(1.001f) * least_cell));
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        in_lattice_[s] = shape.lattice.place(offsets_[s]);
    shape.lattice.weigh(in_lattice(shape));
    shape.map.bends = shape.lattice.straight();
}

// Of faces as they were found. Each node learns the longest of its own.
template <class Real>
Real OwnRooms<Real>::longest_edge(std::uint32_t object) {
    const Range &faces = model_->objects[object].faces, &places = shapes_[object].places;
    std::fill_n(longest_edges_.begin() + places.first, places.count, Real(0));
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        const glm::uvec3& corners = corners_[f];
        const Vec3<Real> a = offsets_[corners.y] - offsets_[corners.x],
                         b = offsets_[corners.z] - offsets_[corners.y],
                         c = offsets_[corners.x] - offsets_[corners.z];
        face_edges_[f] = std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
        for (int k = 0; k < 3; ++k)
            longest_edges_[corners[k]] = std::max(longest_edges_[corners[k]], face_edges_[f]);
    }
    return *std::max_element(face_edges_.begin() + faces.first, face_edges_.begin() + faces.end());
}

template <class Real>
bool OwnRooms<Real>::find_again(std::uint32_t object, std::span<const std::uint32_t> places,
                                std::span<const Vec4<Real>> positions) {
    Shape& shape = shapes_[object];
    const glm::mat<3, 3, Real> back = glm::inverse(shape.map.linear);
    for (const std::uint32_t s : places) {
        for (int correction = 0; correction < kCorrections; ++correction) {
            offsets_[s] += back * deviation(s, at(s, positions));
            if (!shape.lattice.contains(offsets_[s])) return false;
            in_lattice_[s] = shape.lattice.place(offsets_[s]);
            mapped_[s] = mapped(shape, shape.map, s);
        }
    }
    shape.lattice.weigh(in_lattice(shape));
    return longest_edge(object) <= static_cast<Real>(kLongestEdge) * shape.lattice.cell();
}

template <class Real>
void OwnRooms<Real>::make_rooms(std::uint32_t object) {
    Shape& shape = shapes_[object];
    const std::vector<Real> rooms = find_rooms(object, shape.map);
    std::copy(rooms.begin(), rooms.end(), radii_.begin() + shape.places.first);
}

// What a map keeps, and the rooms with it. Within a face rooms are interpolated, and what bends is not linear
// there: how far it is from that, rooms are smaller by.
template <class Real>
std::vector<Real> OwnRooms<Real>::find_rooms(std::uint32_t object, ShapeMap<Real>& map) const {
    const Shape& shape = shapes_[object];
    const Range &places = shape.places, &faces = model_->objects[object].faces;
    map.least = least_stretch(map.linear);
    map.slope = shape.lattice.steepest(map.bends);
    map.around = shape.lattice.local_maps(map.linear, map.bends);
    typename BendLattice<Real>::Curvatures curvatures;
    struct Near {
        Real kept, bulge;
    };
    std::vector<Near> near(places.count, {Real(1), Real(0)});
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        Near face{Real(1), Real(0)};
        Real spread = 0, apart = std::numeric_limits<Real>::infinity();
        for (int k = 0; k < 3; ++k) {
            const LocalMap<Real>& local = map.around[in_lattice_[corners_[f][k]].used];
            face.kept = std::min(face.kept, local.kept());
            spread = std::max(spread, local.spread);
            apart = std::min(apart, apart_[corners_[f][k]]);
        }
        face.bulge = static_cast<Real>(0.5774) * face_edges_[f] * spread;
        if (face.bulge > static_cast<Real>(kRoomBent - kRoom) * face.kept * apart) {
            const auto at_corner = [&](int k) { return &in_lattice_[corners_[f][k]]; };
            face.bulge = std::min(
                face.bulge, shape.lattice.bulge(map.bends, curvatures,
                                                {at_corner(0), at_corner(1), at_corner(2)}, face_edges_[f]));
        }
        for (int k = 0; k < 3; ++k) {
            Near& corner = near[corners_[f][k] - places.first];
            corner = {std::min(corner.kept, face.kept), std::max(corner.bulge, face.bulge)};
        }
    }
    std::vector<Real> rooms(places.count);
    for (std::uint32_t k = 0; k < places.count; ++k) {
        const Real kept = near[k].kept * apart_[places.first + k];
        const Real room = std::min(Real(kRoom) * kept, Real(kRoomBent) * kept - near[k].bulge);
        rooms[k] = std::max(room, Real(0));
    }
    return rooms;
}

template <class Real>
MapAhead<Real> OwnRooms<Real>::completed(std::uint32_t object, ShapeMap<Real> map) const {
    MapAhead<Real> ahead;
    ahead.rooms = find_rooms(object, map);
    const Shape& shape = shapes_[object];
    ahead.mapped.reserve(shape.places.count);
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s)
        ahead.mapped.push_back(mapped(shape, map, s));
    ahead.map = std::move(map);
    return ahead;
}

template <class Real>
Real OwnRooms<Real>::used(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Range& places = shapes_[object].places;
    Real most = 0;
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        most = std::max(most, used_by(s, at(s, positions)));
    return most;
}

template <class Real>
bool OwnRooms<Real>::keeps(std::uint32_t object, Real part) const {
    const std::vector<LocalMap<Real>>& around = shapes_[object].map.around;
    return std::all_of(around.begin(), around.end(), [&](const auto& local) { return local.kept() >= part; });
}

template <class Real>
glm::mat<3, 3, Real> OwnRooms<Real>::moment(const Shape& shape, const Vec3<Real>& center,
                                            std::span<const Vec4<Real>> positions) const {
    glm::mat<3, 3, Real> moment(0);
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s)
        moment += glm::outerProduct(at(s, positions) - center, offsets_[s]);
    return moment;
}

template <class Real>
MapAhead<Real> OwnRooms<Real>::displaced(std::uint32_t object, const Vec3<Real>& displacement) const {
    const Range& places = shapes_[object].places;
    const auto first = static_cast<std::ptrdiff_t>(places.first), end = first + places.count;
    MapAhead<Real> ahead{shapes_[object].map,
                         {mapped_.begin() + first, mapped_.begin() + end},
                         {radii_.begin() + first, radii_.begin() + end}};
    ahead.displace(displacement);
    return ahead;
}

template <class Real>
MapAhead<Real> OwnRooms<Real>::moved(std::uint32_t object, std::span<const Vec4<Real>> positions,
                                     std::span<const Vec4<Real>> ends) const {
    const Range& places = shapes_[object].places;
    const Vec3<Real> from = middle(places, positions), to = middle(places, ends);
    glm::mat<3, 3, Real> moment(0);
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        moment += glm::outerProduct(at(s, ends) - to, at(s, positions) - from);
    const glm::mat<3, 3, Real> turn(nearest_rotation(glm::dmat3(moment)));
    MapAhead<Real> ahead = displaced(object, Vec3<Real>(0));
    for (Vec3<Real>& place : ahead.mapped) place = to + turn * (place - from);
    ShapeMap<Real>& map = ahead.map;
    map.linear = turn * map.linear;
    map.center = to + turn * (map.center - from);
    for (Vec4<Real>& bend : map.bends) bend = Vec4<Real>(turn * Vec3<Real>(bend), Real(0));
    for (LocalMap<Real>& local : map.around) local.linear = turn * local.linear;
    return ahead;
}

template <class Real>
MapAhead<Real> OwnRooms<Real>::fitted(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    const std::uint32_t first = shape.places.first;
    ShapeMap<Real> map = carried(object, positions);
    const auto left = [&](std::size_t k) {
        const std::uint32_t s = first + static_cast<std::uint32_t>(k);
        return at(s, positions) - mapped(shape, map, s);
    };
    shape.lattice.add(in_lattice(shape), left, map.bends);
    shape.lattice.fill_empty(map.bends);
    shape.lattice.flatten(map.bends, most_slope(map.linear));
    return completed(object, std::move(map));
}

// The affine one by least squares over the surface nodes. What it keeps is not known yet.
template <class Real>
ShapeMap<Real> OwnRooms<Real>::carried(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    ShapeMap<Real> map = shape.map;
    map.center = middle(shape.places, positions);
    const glm::mat<3, 3, Real> linear = moment(shape, map.center, positions) * shape.inverse_moment;
    if (!(least_stretch(linear) >= static_cast<Real>(kLeastLinear))) return map;
    const glm::mat<3, 3, Real> turn = linear * glm::inverse(map.linear);
    map.linear = linear;
    for (Vec4<Real>& bend : map.bends) bend = Vec4<Real>(turn * Vec3<Real>(bend), Real(0));
    shape.lattice.flatten(map.bends, most_slope(map.linear));
    return map;
}

// What is farther apart than kNear of a cell is kept apart by what the map as a whole keeps; what is nearer,
// by what it does round the cells where it is.
template <class Real>
Real OwnRooms<Real>::part_between(std::uint32_t object, const ShapeMap<Real>& to) const {
    const ShapeMap<Real>& from = shapes_[object].map;
    const Real kept = static_cast<Real>(kMargin * kLeastKept) + std::max(from.slope, to.slope);
    Real part = part_kept(std::min(from.least, to.least), kept, squared_norm(to.linear - from.linear));
    for (std::size_t k = 0; k < from.around.size(); ++k) {
        const LocalMap<Real>&a = from.around[k], &b = to.around[k];
        const Real least = std::min(a.least, b.least), spread = std::max(a.spread, b.spread);
        constexpr auto kPart = static_cast<Real>(kRoomBent / kRoomBetween);
        const Real local = kPart * least + (Real(1) - kPart) * spread;
        part = std::min(part, part_kept(least, local, squared_norm(b.linear - a.linear)));
    }
    return part;
}

template <class Real>
MapAhead<Real> OwnRooms<Real>::between(std::uint32_t object, const ShapeMap<Real>& to, Real part) const {
    ShapeMap<Real> map = shapes_[object].map;
    map.linear += part * (to.linear - map.linear);
    map.center += part * (to.center - map.center);
    for (std::size_t p = 0; p < map.bends.size(); ++p) map.bends[p] += part * (to.bends[p] - map.bends[p]);
    return completed(object, std::move(map));
}

template <class Real>
void OwnRooms<Real>::follow(std::uint32_t object, const MapAhead<Real>& ahead) {
    Shape& shape = shapes_[object];
    shape.map = ahead.map;
    std::copy(ahead.mapped.begin(), ahead.mapped.end(), mapped_.begin() + shape.places.first);
    std::copy(ahead.rooms.begin(), ahead.rooms.end(), radii_.begin() + shape.places.first);
}

template <class Real>
void OwnRooms<Real>::shift(std::uint32_t object, const Vec3<Real>& motion) {
    Shape& shape = shapes_[object];
    shape.map.center += motion;
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) mapped_[s] += motion;
}

template class OwnRooms<float>;
template class OwnRooms<double>;

}  // namespace gelatin::cpu
