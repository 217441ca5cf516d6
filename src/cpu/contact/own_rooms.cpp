#include "cpu/contact/own_rooms.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

namespace gelatin::cpu {
namespace {

// A map with the linear part L keeps |L x|^2 >= (1 - |L^T L - 1|) |x|^2. Those between L and M keep the
// lesser of both squares, less |L - M|^2 |x|^2 / 4. What bends takes away as much as its steepest slope.
constexpr double kMostStrain = 0.28, kMostTurnSquared = 0.4, kMostSlope = 0.25;
constexpr double kLeft = OwnRooms<double>::kLeastStretch + kMostSlope;
static_assert(1.0 - kMostStrain - 0.25 * kMostTurnSquared >= kLeft * kLeft);
// A lattice has no more cells than this along an axis.
constexpr double kMostCells = 16.0;
// The second time brings in what nodes on one side of a point left out.
constexpr int kBendings = 2;
constexpr int kFillings = 6;
// What bends moves a node by, changes with where it is found: each correction leaves at most 0.3 of the rest.
constexpr int kCorrections = 5;
// Of the mean square of the offsets: bodies that are flatter are displaced, but not otherwise mapped.
constexpr double kFlat = 1e-6;

template <class Real>
Real squared_norm(const glm::mat<3, 3, Real>& m) {
    return glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]);
}

template <class Real>
bool keeps_distances(const glm::mat<3, 3, Real>& linear) {
    const Real strain = squared_norm(glm::transpose(linear) * linear - glm::mat<3, 3, Real>(1));
    return strain <= static_cast<Real>(kMostStrain * kMostStrain);
}

// Of a symmetric matrix, or 0 if it is nearly singular.
template <class Real>
glm::mat<3, 3, Real> safe_inverse(const glm::mat<3, 3, Real>& m) {
    const Real mean = (m[0][0] + m[1][1] + m[2][2]) / Real(3);
    if (!(glm::determinant(m) > static_cast<Real>(kFlat) * mean * mean * mean))
        return glm::mat<3, 3, Real>(0);
    return glm::inverse(m);
}

}  // namespace

template <class Real>
void OwnRooms<Real>::restart(std::shared_ptr<const Model> model, std::vector<std::uint8_t> meets_themselves) {
    model_ = std::move(model);
    meets_themselves_ = std::move(meets_themselves);
    const SurfaceParts& parts = model_->surface_parts;
    shapes_.assign(model_->objects.size(), {});
    for (std::size_t o = 0; o < shapes_.size(); ++o) {
        const Range& faces = model_->objects[o].faces;
        const std::uint32_t first = parts.face_starts[faces.first].x;
        shapes_[o].places = {first, parts.face_starts[faces.end()].x - first};
    }
    in_lattice_.assign(parts.nodes.size(), {});
    offsets_.assign(parts.nodes.size(), Vec3<Real>(0));
    mapped_.assign(parts.nodes.size(), Vec3<Real>(0));
    radii_.assign(parts.nodes.size(), std::numeric_limits<Real>::infinity());
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
    shape.is_found = true;
    shape.map = {glm::mat<3, 3, Real>(1), middle(shape.places, positions), {}, true, false};
    glm::mat<3, 3, Real> moment(0);
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        mapped_[s] = at(s, positions);
        offsets_[s] = mapped_[s] - shape.map.center;
        moment += glm::outerProduct(offsets_[s], offsets_[s]);
    }
    shape.inverse_moment = safe_inverse(moment);
    make_lattice(shape, cell);
    shape.can_bend = !(longest_edge(object, positions) > shape.lattice.cell);
    shape.map.bends.assign(shape.lattice.weights.size(), Vec3<Real>(0));
}

// Of its faces.
template <class Real>
Real OwnRooms<Real>::longest_edge(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    Real squared = 0;
    const Range& faces = model_->objects[object].faces;
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        const Face& face = model_->faces[f];
        const std::array corners{face.a, face.b, face.c};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3<Real> edge(positions[corners[k]] - positions[corners[(k + 1) % 3]]);
            squared = std::max(squared, glm::dot(edge, edge));
        }
    }
    return std::sqrt(squared);
}

template <class Real>
void OwnRooms<Real>::make_lattice(Shape& shape, Real cell) {
    Vec3<Real> low(std::numeric_limits<Real>::infinity()), high(-low);
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        low = glm::min(low, offsets_[s]);
        high = glm::max(high, offsets_[s]);
    }
    const Vec3<Real> size = high - low;
    Lattice& lattice = shape.lattice;
    lattice.low = low;
    lattice.cell = std::max(cell, std::max({size.x, size.y, size.z}) / static_cast<Real>(kMostCells));
    for (int axis = 0; axis < 3; ++axis)
        lattice.points[axis] = 2 + static_cast<std::uint32_t>(size[axis] / lattice.cell);
    lattice.weights.assign(std::size_t(lattice.points.x) * lattice.points.y * lattice.points.z, Real(0));
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        place_in_lattice(lattice, s);
        for_points(lattice, s, [&](std::size_t p, Real weight) { lattice.weights[p] += weight; });
    }
}

// Beyond its last points a lattice bends as there.
template <class Real>
void OwnRooms<Real>::place_in_lattice(const Lattice& lattice, std::uint32_t place) {
    const Vec3<Real> in_cells = (offsets_[place] - lattice.low) / lattice.cell;
    glm::uvec3 first(0);
    for (int axis = 0; axis < 3; ++axis) {
        const Real last = static_cast<Real>(lattice.points[axis] - 2);
        first[axis] = static_cast<std::uint32_t>(std::clamp(in_cells[axis], Real(0), last));
    }
    in_lattice_[place] = {first.x + lattice.points.x * (first.y + lattice.points.y * first.z),
                          glm::clamp(in_cells - Vec3<Real>(first), Vec3<Real>(0), Vec3<Real>(1))};
}

template <class Real>
void OwnRooms<Real>::find_again(std::uint32_t object, std::span<const std::uint32_t> places,
                                std::span<const Vec4<Real>> positions) {
    const Shape& shape = shapes_[object];
    const glm::mat<3, 3, Real> back = glm::inverse(shape.map.linear);
    for (const std::uint32_t s : places) {
        for (int correction = 0; correction < kCorrections; ++correction) {
            offsets_[s] += back * deviation(s, at(s, positions));
            place_in_lattice(shape.lattice, s);
            mapped_[s] = mapped(object, shape.map, s);
        }
    }
}

// use(point, weight) for the points of a node's cell; weights add up to 1.
template <class Real>
template <class Use>
void OwnRooms<Real>::for_points(const Lattice& lattice, std::uint32_t place, const Use& use) const {
    const InLattice& in = in_lattice_[place];
    const std::size_t row = lattice.points.x, layer = row * lattice.points.y;
    for (std::size_t k = 0; k < 8; ++k) {
        const Real x = (k & 1) != 0 ? in.within.x : Real(1) - in.within.x;
        const Real y = (k & 2) != 0 ? in.within.y : Real(1) - in.within.y;
        const Real z = (k & 4) != 0 ? in.within.z : Real(1) - in.within.z;
        use(in.point + (k & 1) + (k >> 1 & 1) * row + (k >> 2) * layer, x * y * z);
    }
}

template <class Real>
Vec3<Real> OwnRooms<Real>::bend(const Lattice& lattice, const std::vector<Vec3<Real>>& bends,
                                std::uint32_t place) const {
    Vec3<Real> sum(0);
    for_points(lattice, place, [&](std::size_t p, Real weight) { sum += weight * bends[p]; });
    return sum;
}

// Points that no node is near are between their neighbours.
template <class Real>
void OwnRooms<Real>::fill_empty(const Lattice& lattice, std::vector<Vec3<Real>>& bends) const {
    const glm::ivec3 points(lattice.points);
    const auto index = [&](const glm::ivec3& p) {
        return std::size_t(p.x) + lattice.points.x * (std::size_t(p.y) + lattice.points.y * std::size_t(p.z));
    };
    for (int filling = 0; filling < kFillings; ++filling) {
        glm::ivec3 p(0);
        for (p.z = 0; p.z < points.z; ++p.z)
            for (p.y = 0; p.y < points.y; ++p.y)
                for (p.x = 0; p.x < points.x; ++p.x) {
                    if (lattice.weights[index(p)] > Real(0)) continue;
                    Vec3<Real> sum(0);
                    Real count = 0;
                    for (int axis = 0; axis < 3; ++axis)
                        for (const int side : {-1, 1}) {
                            glm::ivec3 q = p;
                            q[axis] += side;
                            if (q[axis] < 0 || q[axis] >= points[axis]) continue;
                            sum += bends[index(q)];
                            count += Real(1);
                        }
                    bends[index(p)] = sum / count;
                }
    }
}

// A bound of the slope in all cells: along each axis, it is between those of the edges of a cell.
template <class Real>
Real OwnRooms<Real>::steepest(const Lattice& lattice, const std::vector<Vec3<Real>>& bends) const {
    const glm::uvec3& points = lattice.points;
    const std::size_t row = points.x, layer = row * points.y;
    const std::array<std::size_t, 3> strides{1, row, layer};
    Real most = 0;
    for (std::uint32_t z = 0; z + 1 < points.z; ++z)
        for (std::uint32_t y = 0; y + 1 < points.y; ++y)
            for (std::uint32_t x = 0; x + 1 < points.x; ++x) {
                const std::size_t first = x + y * row + z * layer;
                Real squared = 0;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::size_t along = strides[axis], a = strides[(axis + 1) % 3],
                                      b = strides[(axis + 2) % 3];
                    Real steep = 0;
                    for (const std::size_t p : {first, first + a, first + b, first + a + b}) {
                        const Vec3<Real> change = bends[p + along] - bends[p];
                        steep = std::max(steep, glm::dot(change, change));
                    }
                    squared += steep;
                }
                most = std::max(most, squared);
            }
    return std::sqrt(most) / lattice.cell;
}

template <class Real>
Real OwnRooms<Real>::used(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Range& places = shapes_[object].places;
    Real most = 0;
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        most = std::max(most, glm::length(deviation(s, at(s, positions))) / radii_[s]);
    return most;
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
std::optional<ShapeMap<Real>> OwnRooms<Real>::moved(std::uint32_t object,
                                                    std::span<const Vec4<Real>> positions,
                                                    std::span<const Vec4<Real>> ends) const {
    const Shape& shape = shapes_[object];
    const Vec3<Real> from = middle(shape.places, positions), to = middle(shape.places, ends);
    const glm::mat<3, 3, Real> before = moment(shape, from, positions) * shape.inverse_moment;
    if (!keeps_distances(before)) return std::nullopt;
    const glm::mat<3, 3, Real> motion = moment(shape, to, ends) * shape.inverse_moment * glm::inverse(before);
    ShapeMap<Real> map = shape.map;
    map.linear = motion * map.linear;
    map.center = to + motion * (map.center - from);
    for (Vec3<Real>& bend : map.bends) bend = motion * bend;
    return map;
}

// By least squares over the surface nodes.
template <class Real>
ShapeMap<Real> OwnRooms<Real>::carried(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    ShapeMap<Real> map = shape.map;
    map.center = middle(shape.places, positions);
    const glm::mat<3, 3, Real> linear = moment(shape, map.center, positions) * shape.inverse_moment;
    map.is_carried = keeps_distances(linear);
    if (!map.is_carried) return map;
    const glm::mat<3, 3, Real> turn = linear * glm::inverse(map.linear);
    map.linear = linear;
    for (Vec3<Real>& bend : map.bends) bend = turn * bend;
    flatten(shape.lattice, map.bends);
    return map;
}

template <class Real>
ShapeMap<Real> OwnRooms<Real>::bent(std::uint32_t object, ShapeMap<Real> map,
                                    std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    if (!shape.can_bend) {
        map.is_steep = true;
        return map;
    }
    const Lattice& lattice = shape.lattice;
    std::vector<Vec3<Real>> sums(lattice.weights.size());
    for (int bending = 0; bending < kBendings; ++bending) {
        std::fill(sums.begin(), sums.end(), Vec3<Real>(0));
        for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
            const Vec3<Real> left = at(s, positions) - mapped(object, map, s);
            for_points(lattice, s, [&](std::size_t p, Real weight) { sums[p] += weight * left; });
        }
        for (std::size_t p = 0; p < sums.size(); ++p)
            if (lattice.weights[p] > Real(0)) map.bends[p] += sums[p] / lattice.weights[p];
    }
    fill_empty(lattice, map.bends);
    map.is_steep = flatten(lattice, map.bends) || !map.is_carried;
    return map;
}

// Where bends are too steep, they become less. @return whether they were
template <class Real>
bool OwnRooms<Real>::flatten(const Lattice& lattice, std::vector<Vec3<Real>>& bends) const {
    const Real slope = steepest(lattice, bends);
    if (!(slope > static_cast<Real>(kMostSlope))) return false;
    const Real part = static_cast<Real>(0.999 * kMostSlope) / slope;
    for (Vec3<Real>& bend : bends) bend *= part;
    return true;
}

template <class Real>
Real OwnRooms<Real>::part_between(std::uint32_t object, const ShapeMap<Real>& to) const {
    const auto most = static_cast<Real>(kMostTurnSquared);
    const Real turn = squared_norm(to.linear - shapes_[object].map.linear);
    return turn > most ? std::sqrt(most / turn) : Real(1);
}

template <class Real>
ShapeMap<Real> OwnRooms<Real>::between(std::uint32_t object, const ShapeMap<Real>& to, Real part) const {
    ShapeMap<Real> map = shapes_[object].map;
    map.linear += part * (to.linear - map.linear);
    map.center += part * (to.center - map.center);
    for (std::size_t p = 0; p < map.bends.size(); ++p) map.bends[p] += part * (to.bends[p] - map.bends[p]);
    return map;
}

template <class Real>
void OwnRooms<Real>::follow(std::uint32_t object, const ShapeMap<Real>& map) {
    Shape& shape = shapes_[object];
    shape.map = map;
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s)
        mapped_[s] = mapped(object, map, s);
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
