#include "exact/triangle_overlap.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace gelatin::test {
namespace {

// Not the kernel that is exact in predicates alone: CGAL meets segments by way of their supporting lines.
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Number = Kernel::FT;

// CGAL asks for shapes that are not degenerate.
std::variant<Point, Segment> segment_or_point(const Point& a, const Point& b) {
    if (a == b) return a;
    return Segment(a, b);
}

using Corners = std::array<Point, 3>;
Corners corners_of(const cpu::Triangle<double>& t) {
    Corners corners;
    for (int i = 0; i < 3; ++i) corners[i] = Point(t[i].x, t[i].y, t[i].z);
    return corners;
}

std::variant<Point, Segment, Triangle> what_is_covered(Corners p) {
    if (!CGAL::collinear(p[0], p[1], p[2])) return Triangle(p[0], p[1], p[2]);
    std::sort(p.begin(), p.end());
    if (p[0] == p[2]) return p[0];
    return Segment(p[0], p[2]);
}

struct DoIntersect {
    bool operator()(const Point& a, const Point& b) const { return a == b; }
    template <class A, class B>
    bool operator()(const A& a, const B& b) const {
        return CGAL::do_intersect(a, b);
    }
};

// The nearest points of two triangles are on two edges, or on a corner and a face.
Number squared_distance_of_edges(const Corners& s, const Corners& t) {
    Number least = CGAL::squared_distance(s[0], t[0]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            least = std::min(
                least,
                std::visit(
                    [](const auto& a, const auto& b) -> Number { return CGAL::squared_distance(a, b); },
                    segment_or_point(s[i], s[(i + 1) % 3]), segment_or_point(t[j], t[(j + 1) % 3])));
        }
    }
    return least;
}

void take_distance_to_face(const Corners& corners, const Corners& face, Number& least) {
    if (CGAL::collinear(face[0], face[1], face[2])) return;
    for (const Point& p : corners) {
        least = std::min<Number>(least, CGAL::squared_distance(p, Triangle(face[0], face[1], face[2])));
    }
}

}  // namespace

bool exactly_overlap(const cpu::Triangle<double>& s, const cpu::Triangle<double>& t) {
    return std::visit(DoIntersect(), what_is_covered(corners_of(s)), what_is_covered(corners_of(t)));
}

double distance_apart(const cpu::Triangle<double>& s, const cpu::Triangle<double>& t) {
    const Corners corners_s = corners_of(s), corners_t = corners_of(t);
    Number least = squared_distance_of_edges(corners_s, corners_t);
    take_distance_to_face(corners_s, corners_t, least);
    take_distance_to_face(corners_t, corners_s, least);
    return std::sqrt(CGAL::to_double(least));
}

}  // namespace gelatin::test
