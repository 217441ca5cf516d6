// An independent reference: nearest points in extended precision, pair by pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "model/corners.h"
#include "support/proximities.h"

namespace gelatin::test {
namespace {

using Extended = long double;
using Point = glm::vec<3, Extended>;
template <std::size_t Count>
using Corners = std::array<Point, Count>;

Extended length(const Point& p) {
    return std::sqrt(glm::dot(p, p));
}

Point point_on(const Corners<2>& edge, Extended fraction) {
    return edge[0] + std::clamp(fraction, Extended(0), Extended(1)) * (edge[1] - edge[0]);
}

Extended distance(const Point& p, const Corners<2>& edge) {
    const Point along = edge[1] - edge[0];
    const Extended size = glm::dot(along, along);
    return length(point_on(edge, size > 0 ? glm::dot(p - edge[0], along) / size : 0) - p);
}

// Least squares over the face's plane, and over its edges: the least of what lies within.
Extended distance(const Point& p, const Corners<3>& face) {
    const Point u = face[1] - face[0], v = face[2] - face[0], w = p - face[0];
    const Extended uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v),
                   determinant = uu * vv - uv * uv;
    Extended least =
        std::min({distance(p, Corners<2>{face[0], face[1]}), distance(p, Corners<2>{face[1], face[2]}),
                  distance(p, Corners<2>{face[2], face[0]})});
    if (determinant <= 0) return least;
    const Extended s = (vv * glm::dot(u, w) - uv * glm::dot(v, w)) / determinant,
                   t = (uu * glm::dot(v, w) - uv * glm::dot(u, w)) / determinant;
    if (s >= 0 && t >= 0 && s + t <= 1) least = std::min(least, length(w - s * u - t * v));
    return least;
}

Extended distance(const Corners<2>& e, const Corners<2>& f) {
    const Point u = e[1] - e[0], v = f[1] - f[0], w = f[0] - e[0];
    const Extended uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v),
                   determinant = uu * vv - uv * uv;
    Extended least = std::min({distance(e[0], f), distance(e[1], f), distance(f[0], e), distance(f[1], e)});
    if (determinant <= 0) return least;
    const Extended s = (vv * glm::dot(u, w) - uv * glm::dot(v, w)) / determinant,
                   t = (uv * glm::dot(u, w) - uu * glm::dot(v, w)) / determinant;
    return std::min(least, length(point_on(f, t) - point_on(e, s)));
}

// All that a pair's bounds depend on.
struct PairBounds {
    glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};

    template <std::size_t Count>
    explicit PairBounds(const Corners<Count>& corners) {
        for (const Point& p : corners) {
            min = glm::min(min, glm::dvec3(p));
            max = glm::max(max, glm::dvec3(p));
        }
    }
    // Whether two are farther apart than that along an axis: the answer for most, and quick.
    bool is_apart(const PairBounds& other, double distance) const {
        for (int k = 0; k < 3; ++k)
            if (min[k] - other.max[k] > distance || other.min[k] - max[k] > distance) return true;
        return false;
    }
    // A lower bound of the distance of two.
    double gap(const PairBounds& other) const {
        return glm::length(glm::max(glm::max(min - other.max, other.min - max), glm::dvec3(0.0)));
    }
    double extent(const PairBounds& other) const {
        const glm::dvec3 size = glm::max(max, other.max) - glm::min(min, other.min);
        return std::max({size.x, size.y, size.z});
    }
};

template <class Real>
double least_sine() {
    return std::sqrt(static_cast<double>(cpu::kParallel<Real>));
}

template <class Real>
double distance_bound(double extent, const Point& u, const Point& v) {
    const Extended product = length(u) * length(v);
    const double sine = product > 0 ? static_cast<double>(length(glm::cross(u, v)) / product) : 0.0;
    return 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * extent /
           std::max(sine, least_sine<Real>());
}

template <class Real>
class Checker {
public:
    Checker(const Model& model, const CollisionSettings& settings, const FoundProximities& found)
        : model_(model),
          parts_(model.surface_parts),
          found_(found),
          radius_(*settings.proximity_radius),
          own_(settings.self_collision.value_or(false)),
          positions_(model.positions.begin(), model.positions.end()) {
        for (const Face& face : model.faces) faces_.push_back({at(face.a), at(face.b), at(face.c)});
        for (const FaceEdge& edge : parts_.edges) edges_.push_back({at(edge.a), at(edge.b)});
    }

    ProximityErrors run() {
        std::vector<PairBounds> face_bounds, edge_bounds;
        for (const auto& face : faces_) face_bounds.emplace_back(face);
        for (const auto& edge : edges_) edge_bounds.emplace_back(edge);
        PairBounds whole(Corners<1>{at(0)});
        for (const PairBounds& box : face_bounds) {
            whole.min = glm::min(whole.min, box.min);
            whole.max = glm::max(whole.max, box.max);
        }
        farthest_ = radius_ + largest_bound(whole.extent(whole));
        for (std::uint32_t q = 0; q < parts_.nodes.size(); ++q) {
            const std::uint32_t node = parts_.nodes[q];
            const Corners<1> point{at(node)};
            const PairBounds point_bounds(point);
            start_query(q);
            for (std::uint32_t f = 0; f < faces_.size(); ++f) {
                const Face& face = model_.faces[f];
                const bool counts = is_sought(object_of(node), face.object) && !has_corner(face, node);
                const auto bound = [&](double extent) {
                    return distance_bound<Real>(extent, faces_[f][1] - faces_[f][0],
                                                faces_[f][2] - faces_[f][0]);
                };
                compare(
                    node, f, counts, point_bounds, face_bounds[f],
                    [&] { return distance(point[0], faces_[f]); }, bound, &Checker::check_node_and_face);
            }
            finish_query();
        }
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            start_query(static_cast<std::uint32_t>(parts_.nodes.size()) + e);
            for (std::uint32_t f = 0; f < edges_.size(); ++f) {
                const FaceEdge &edge = parts_.edges[e], &other = parts_.edges[f];
                const bool counts = is_sought(edge.object, other.object) && !share_end(edge, other);
                const auto bound = [&](double extent) {
                    return distance_bound<Real>(extent, edges_[e][1] - edges_[e][0],
                                                edges_[f][1] - edges_[f][0]);
                };
                compare(
                    e, f, counts, edge_bounds[e], edge_bounds[f],
                    [&] { return distance(edges_[e], edges_[f]); }, bound, &Checker::check_edges);
            }
            finish_query();
        }
        return errors_;
    }

private:
    Point at(std::uint32_t n) const { return Point(glm::vec3(model_.positions[n])); }
    std::uint32_t object_of(std::uint32_t node) const {
        return model_.faces[model_.node_faces.faces[model_.node_faces.starts[node]]].object;
    }
    bool is_sought(std::uint32_t object, std::uint32_t other) const { return object != other || own_; }

    void start_query(std::uint32_t query) {
        next_ = found_.starts[query];
        end_ = found_.starts[query + 1];
        for (std::uint32_t k = next_; k + 1 < end_; ++k)
            errors_.disordered += found_.proximities[k].second >= found_.proximities[k + 1].second ? 1 : 0;
    }
    static double largest_bound(double extent) {
        return 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * extent / least_sine<Real>();
    }
    // What is left has not been met in ascending order.
    void finish_query() { errors_.wrong += end_ - next_; }

    template <class Distance, class Bound, class Check>
    void compare(std::uint32_t first, std::uint32_t second, bool counts, const PairBounds& box,
                 const PairBounds& other, const Distance& distance, const Bound& bound, const Check& check) {
        ++errors_.compared;
        const bool is_found = next_ < end_ && found_.proximities[next_].second == second;
        if (!is_found && (!counts || box.is_apart(other, farthest_))) return;
        const double extent = box.extent(other);
        if (!is_found && box.gap(other) > radius_ + largest_bound(extent)) return;
        const auto exact = static_cast<double>(distance());
        const double tolerance = bound(extent) + 1e-30;
        if (counts && exact < radius_ - tolerance) {
            ++errors_.expected;
            errors_.missing += is_found ? 0 : 1;
        }
        if (!is_found) return;
        const cpu::Proximity<double>& proximity = found_.proximities[next_++];
        errors_.wrong += counts && proximity.first == first && exact < radius_ + tolerance ? 0 : 1;
        raise(errors_.distance, std::abs(proximity.distance - exact) / tolerance);
        raise(errors_.distance, std::abs(glm::length(proximity.apart) - proximity.distance) / tolerance);
        (this->*check)(proximity, tolerance);
    }

    void check_node_and_face(const cpu::Proximity<double>& proximity, double bound) {
        const glm::dvec4& w = proximity.weights;
        check_points(cpu::nearest_points_of_node_and_face<double>(model_, positions_, proximity), proximity,
                     bound);
        check_weights({w.x, w.y, w.z, 1.0 - w.w}, std::abs(w.x + w.y + w.z - 1.0));
    }
    void check_edges(const cpu::Proximity<double>& proximity, double bound) {
        const glm::dvec4& w = proximity.weights;
        check_points(cpu::nearest_points_of_edges<double>(model_, positions_, proximity), proximity, bound);
        check_weights(w, std::max(std::abs(w.x + w.y - 1.0), std::abs(w.z + w.w - 1.0)));
        const auto mirror = cpu::Proximity<double>{
            proximity.second, proximity.first, proximity.distance, -proximity.apart, {w.z, w.w, w.x, w.y}};
        const auto nodes = static_cast<std::uint32_t>(parts_.nodes.size());
        const auto begin = found_.proximities.begin();
        const auto first = begin + found_.starts[nodes + proximity.second],
                   last = begin + found_.starts[nodes + proximity.second + 1];
        errors_.not_mirrored += std::find(first, last, mirror) == last ? 1 : 0;
    }
    void check_points(const cpu::NearestPoints<double>& points, const cpu::Proximity<double>& proximity,
                      double bound) {
        // What double has left of the points, far from the origin.
        const double rounding = 1e-15 * glm::length(points[0]);
        raise(errors_.points,
              glm::distance(points[1] - points[0], proximity.apart) / (32.0 * bound + rounding));
    }
    void check_weights(const glm::dvec4& weights, double sum_error) {
        raise(errors_.weights, sum_error);
        for (int k = 0; k < 4; ++k) raise(errors_.weights, std::max(-weights[k], weights[k] - 1.0));
    }
    static void raise(double& worst, double error) {
        worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
    }

    const Model& model_;
    const SurfaceParts& parts_;
    const FoundProximities& found_;
    double radius_;
    double farthest_ = 0.0;  // two whose boxes are farther apart are farther than the radius
    bool own_;
    std::vector<glm::dvec4> positions_;
    std::vector<Corners<3>> faces_;
    std::vector<Corners<2>> edges_;
    std::uint32_t next_ = 0, end_ = 0;
    ProximityErrors errors_;
};

// Numbers that index something.
bool is_well_formed(const Model& model, const FoundProximities& found) {
    const SurfaceParts& parts = model.surface_parts;
    const std::size_t queries = parts.nodes.size() + parts.edges.size();
    if (found.starts.size() != queries + 1 || found.starts.back() != found.proximities.size()) return false;
    if (!std::is_sorted(found.starts.begin(), found.starts.end())) return false;
    for (std::size_t k = found.starts[parts.nodes.size()]; k < found.proximities.size(); ++k)
        if (found.proximities[k].first >= parts.edges.size() ||
            found.proximities[k].second >= parts.edges.size())
            return false;
    return true;
}

}  // namespace

template <class Real>
ProximityErrors check_proximities(const Model& model, const CollisionSettings& settings,
                                  const FoundProximities& found) {
    ProximityErrors malformed;
    malformed.wrong = 1;
    return is_well_formed(model, found) ? Checker<Real>(model, settings, found).run() : malformed;
}
template ProximityErrors check_proximities<float>(const Model&, const CollisionSettings&,
                                                  const FoundProximities&);
template ProximityErrors check_proximities<double>(const Model&, const CollisionSettings&,
                                                   const FoundProximities&);

void expect_none(const ProximityErrors& errors) {
    EXPECT_TRUE(errors.are_none()) << errors.missing << " missing of " << errors.expected << ", "
                                   << errors.wrong << " wrong, " << errors.disordered << " disordered, "
                                   << errors.not_mirrored << " not mirrored; errors over bounds: distance "
                                   << errors.distance << ", points " << errors.points << ", weights "
                                   << errors.weights;
}

}  // namespace gelatin::test
