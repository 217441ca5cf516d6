#include "mesh/fill_polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "mesh/fill_contours.h"

namespace gelatin {
namespace {

/// Twice the area vector of a polygon (Newell).
glm::dvec3 newell_normal(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        normal += cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    return normal;
}

/// The corners as seen against the normal: the outline goes round counter-clockwise.
std::vector<glm::dvec2> project(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
    const glm::dvec3 n = normal / length(normal);
    const glm::dvec3 aside = std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = normalize(cross(aside, n)), v = cross(n, u);
    std::vector<glm::dvec2> flat;
    for (const glm::dvec3& p : corners) flat.emplace_back(dot(p - corners[0], u), dot(p - corners[0], v));
    return flat;
}

/// Twice the area, positive if the corners turn left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Cuts off one ear after the other: a corner whose triangle with its two neighbours contains no other one.
class EarClipper {
public:
    explicit EarClipper(const std::vector<glm::dvec2>& points) : points_(points) {
        const auto count = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            next_.push_back((k + 1) % count);
            previous_.push_back((k + count - 1) % count);
        }
        // A corner can only turn from reflex to convex while ears are cut off.
        for (std::uint32_t k = 0; k < count; ++k) {
            if (!is_convex(k)) reflex_.push_back(k);
        }
        const auto [low, high] = std::pair(bound(false), bound(true));
        axis_ = high.x - low.x >= high.y - low.y ? 0 : 1;
        std::sort(reflex_.begin(), reflex_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis_] < points_[b][axis_]; });
    }

    FilledPolygon fill() {
        result_.crosses_itself = turns() != 1;
        std::uint32_t corner = 0;
        std::size_t left = points_.size(), tried = 0, stuck = 0;
        constexpr std::size_t kPatience = 100;  // outlines of nonsense would take the square of their length
        while (left > 3) {
            const bool is_stuck = tried == left;
            if (is_stuck) corner = best_without_ears(corner, left);
            if (is_stuck && result_.crosses_itself) ++stuck;
            if (is_stuck || stuck > kPatience || is_ear(corner)) {
                cut_off(corner);
                --left;
                tried = 0;
                corner = next_[corner];  // leaves out a corner, which gives wider triangles than a fan
            } else {
                ++tried;
            }
            corner = next_[corner];
        }
        result_.triangles.emplace_back(previous_[corner], corner, next_[corner]);
        return std::move(result_);
    }

private:
    bool is_convex(std::uint32_t corner) const {
        constexpr double kStraight = 1e-12;  // a sine that is rounding
        const glm::dvec2 &a = points_[previous_[corner]], &b = points_[corner], &c = points_[next_[corner]];
        return turn(a, b, c) > kStraight * distance(a, b) * distance(b, c);
    }

    /// How often the outline turns round; 1 as well where it goes back on itself, which could be either way.
    long turns() const {
        double angle = 0.0;
        for (std::size_t k = 0; k < points_.size(); ++k) {
            const glm::dvec2 to = points_[k] - points_[previous_[k]], from = points_[next_[k]] - points_[k];
            const double sine = to.x * from.y - to.y * from.x, cosine = dot(to, from);
            if (sine == 0.0 && cosine <= 0.0) return 1;
            angle += std::atan2(sine, cosine);
        }
        return std::lround(angle / (2.0 * std::numbers::pi));
    }

    bool is_ear(std::uint32_t corner) const {
        if (!is_convex(corner)) return false;
        const glm::dvec2 &a = points_[previous_[corner]], &b = points_[corner], &c = points_[next_[corner]];
        const double low = std::min({a[axis_], b[axis_], c[axis_]}),
                     high = std::max({a[axis_], b[axis_], c[axis_]});
        auto it = std::lower_bound(reflex_.begin(), reflex_.end(), low,
                                   [&](std::uint32_t k, double value) { return points_[k][axis_] < value; });
        for (; it != reflex_.end() && points_[*it][axis_] <= high; ++it) {
            if (is_cut_off(*it)) continue;
            const glm::dvec2& p = points_[*it];
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
        }
        return true;
    }

    /// What to cut off where no corner is an ear: one of a straight line, else the outline crosses itself.
    std::uint32_t best_without_ears(std::uint32_t first, std::size_t left) {
        std::uint32_t convex = first;
        for (std::size_t k = 0; k < left; ++k, first = next_[first]) {
            const glm::dvec2 &a = points_[previous_[first]], &b = points_[first], &c = points_[next_[first]];
            const bool is_straight = std::abs(turn(a, b, c)) <= 1e-12 * distance(a, b) * distance(b, c);
            if (is_straight) return first;
            if (is_convex(first)) convex = first;
        }
        result_.crosses_itself = true;
        return convex;
    }

    void cut_off(std::uint32_t corner) {
        const std::uint32_t a = previous_[corner], c = next_[corner];
        result_.triangles.emplace_back(a, corner, c);
        next_[a] = c;
        previous_[c] = a;
        previous_[corner] = corner;
    }
    bool is_cut_off(std::uint32_t corner) const { return previous_[corner] == corner; }

    glm::dvec2 bound(bool upper) const {
        glm::dvec2 bound = points_[0];
        for (const glm::dvec2& p : points_) bound = upper ? max(bound, p) : min(bound, p);
        return bound;
    }

    const std::vector<glm::dvec2>& points_;
    std::vector<std::uint32_t> next_, previous_;  // a corner that was cut off is its own previous one
    std::vector<std::uint32_t> reflex_;           // corners at which the outline does not turn left, sorted
    int axis_ = 0;                                // along which
    FilledPolygon result_;
};

/// The thinnest of some triangles: its quality.
double worst_quality(const FlatMesh& mesh) {
    double worst = 1.0;
    for (const glm::uvec3& t : mesh.triangles)
        worst = std::min(worst,
                         triangle_quality(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    return worst;
}

FilledPolygon fan(std::size_t corners) {
    FilledPolygon result;
    for (std::uint32_t k = 1; k + 1 < corners; ++k) result.triangles.emplace_back(0u, k, k + 1);
    return result;
}

}  // namespace

FilledPolygon fill_polygon(const std::vector<glm::dvec3>& corners) {
    const glm::dvec3 normal = newell_normal(corners);
    const double size = length(normal);
    if (!(size > 0.0) || !std::isfinite(size)) return fan(corners.size());  // encloses nothing
    FlatMesh flat{project(corners, normal), {}};
    FilledPolygon filled = EarClipper(flat.positions).fill();
    constexpr double kThin = 0.1;
    flat.triangles = std::move(filled.triangles);
    if (!filled.crosses_itself && worst_quality(flat) < kThin) improve_triangles(flat);
    filled.triangles = std::move(flat.triangles);
    return filled;
}

}  // namespace gelatin
