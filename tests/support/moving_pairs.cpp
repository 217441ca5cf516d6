#include "support/moving_pairs.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_precision.hpp>

#include "cpu/collision/triangle_overlap.h"
#include "support/random_maker.h"

namespace gelatin::test {
namespace {

using cpu::Moving;
using Point = glm::dvec3;
using LongPoint = glm::vec<3, long double>;

class Maker : public RandomMaker {
public:
    using RandomMaker::RandomMaker;

    // Of whole numbers.
    Point coarse_point(int extent) {
        return {integer(-extent, extent), integer(-extent, extent), integer(-extent, extent)};
    }
};

// Corners that `what` leaves of the first and the second thing.
int first_corners(PairOf what) {
    return what == PairOf::node_and_face ? 1 : what == PairOf::edges ? 2 : 3;
}
int second_corners(PairOf what) {
    return what == PairOf::edges ? 2 : 3;
}

void keep_corners(Moving<double, 3>& moving, int count) {
    for (int k = count; k < 3; ++k) {
        moving.start[k] = moving.start[count - 1];
        moving.end[k] = moving.end[count - 1];
    }
}

// b flies at a, past it or not; both fly together and deform.
MovingPair<double> random_pair(Maker& make) {
    MovingPair<double> pair;
    const Point places[] = {make.point(0.7), make.point(0.7)},
                together = make.point(make.magnitude(0.01, 10.0));
    const Point approach = (places[0] - places[1] + make.point(0.4)) / make.uniform(0.2, 1.5);
    for (int side = 0; side < 2; ++side) {
        Moving<double, 3>& moving = side == 0 ? pair.a : pair.b;
        const double size = make.magnitude(0.1, 1.0), change = make.magnitude(0.001, 0.3);
        for (int k = 0; k < 3; ++k) {
            moving.start[k] = places[side] + size * make.point();
            moving.end[k] =
                moving.start[k] + together + double(side) * approach + change * size * make.point();
        }
    }
    return pair;
}

// Both hold the origin at `quarters` quarters of the step: a corner there is a sum of two whole vectors u, v
// taken a whole number of times, and moves by a whole vector each quarter.
Moving<double, 3> moving_over_origin(Maker& make, int corners, int quarters, const Point& motion) {
    const Point u = make.coarse_point(3), v = corners == 3 ? make.coarse_point(3) : Point(0.0);
    const int i = corners == 1 ? 0 : make.integer(0, 4), j = make.integer(0, 4 - i);
    const Point first = -double(i) * u - double(j) * v;
    const std::array<Point, 3> there{first, corners == 1 ? first : first + 4.0 * u, first + 4.0 * v};
    Moving<double, 3> moving;
    const bool deforms = make.integer(0, 3) != 0;
    for (int k = 0; k < 3; ++k) {
        const Point velocity = motion + (deforms ? make.coarse_point(2) : Point(0.0));
        moving.start[k] = there[k] - double(quarters) * velocity;
        moving.end[k] = there[k] + double(4 - quarters) * velocity;
    }
    return moving;
}

MovingPair<double> touching_pair(Maker& make, PairOf what) {
    const int quarters = make.integer(0, 4);
    const auto motion = [&] {
        const int speeds[] = {0, 1, 5, 40};
        return make.coarse_point(speeds[make.integer(0, 3)]);
    };
    MovingPair<double> pair{moving_over_origin(make, first_corners(what), quarters, motion()),
                            moving_over_origin(make, second_corners(what), quarters, motion())};
    keep_corners(pair.a, first_corners(what));
    keep_corners(pair.b, second_corners(what));
    return pair;
}

template <class Real, class Change>
MovingPair<Real> converted(const MovingPair<double>& pair, const Change& change) {
    MovingPair<Real> result;
    for (int k = 0; k < 3; ++k) {
        result.a.start[k] = cpu::Vec3<Real>(change(pair.a.start[k]));
        result.a.end[k] = cpu::Vec3<Real>(change(pair.a.end[k]));
        result.b.start[k] = cpu::Vec3<Real>(change(pair.b.start[k]));
        result.b.end[k] = cpu::Vec3<Real>(change(pair.b.end[k]));
    }
    return result;
}

// By turns as they are, far away, tiny and large: whole numbers stay exact in float.
template <class Real>
MovingPair<Real> placed(const MovingPair<double>& pair, std::size_t turn, Maker& make) {
    const Point offset = turn % 4 == 1 ? make.coarse_point(1 << 20) : Point(0.0);
    const double scale = turn % 4 == 2   ? std::exp2(-make.integer(5, 20))
                         : turn % 4 == 3 ? std::exp2(make.integer(3, 12))
                                         : 1.0;
    return converted<Real>(pair, [&](const Point& p) { return scale * (p + offset); });
}

template <class Real>
std::array<LongPoint, 3> corners_at(const Moving<Real, 3>& moving, long double time) {
    std::array<LongPoint, 3> corners;
    for (int k = 0; k < 3; ++k) {
        const LongPoint start(moving.start[k]), end(moving.end[k]);
        corners[k] = start + time * (end - start);
    }
    return corners;
}

long double edge_distance(const LongPoint& a, const LongPoint& b, const LongPoint& c, const LongPoint& d) {
    // Alternating projections onto the other edge's nearest point, from the lines' nearest points on.
    const LongPoint u = b - a, v = d - c, w = c - a;
    const long double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const auto fraction = [](long double along, long double squared_length) {
        return squared_length > 0 ? std::clamp(along / squared_length, 0.0L, 1.0L) : 0.0L;
    };
    const auto from_start = [&](long double s) {
        const long double t = fraction(glm::dot(s * u - w, v), vv);
        s = fraction(glm::dot(w + t * v, u), uu);
        return glm::length(a + s * u - (c + fraction(glm::dot(s * u - w, v), vv) * v));
    };
    const long double size = uu * vv - uv * uv;
    const long double line =
        size > 0 ? std::clamp((glm::dot(w, u) * vv - glm::dot(w, v) * uv) / size, 0.0L, 1.0L) : 0.0L;
    return std::min({from_start(line), from_start(0.0L), from_start(1.0L)});
}

// Infinite beside the face.
long double plane_distance(const LongPoint& p, const std::array<LongPoint, 3>& face) {
    const LongPoint normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    const long double size = glm::length(normal);
    if (!(size > 0)) return INFINITY;
    for (int k = 0; k < 3; ++k) {
        if (glm::dot(glm::cross(face[(k + 1) % 3] - face[k], p - face[k]), normal) < 0) return INFINITY;
    }
    return std::abs(glm::dot(p - face[0], normal)) / size;
}

// Of the fastest corners, as seen from a's first one: what the distance changes by in a step at most [m].
template <class Real>
double relative_speed(const MovingPair<Real>& pair) {
    const Point frame = Point(pair.a.end[0]) - Point(pair.a.start[0]);
    const auto fastest = [&](const Moving<Real, 3>& moving) {
        double speed = 0.0;
        for (int k = 0; k < 3; ++k)
            speed = std::max(speed, glm::length(Point(moving.end[k]) - Point(moving.start[k]) - frame));
        return speed;
    };
    return fastest(pair.a) + fastest(pair.b);
}

template <class Real>
cpu::Triangle<double> start_of(const Moving<Real, 3>& moving) {
    return {Point(moving.start[0]), Point(moving.start[1]), Point(moving.start[2])};
}

template <std::size_t N, class Real>
Moving<Real, N> reduced(const Moving<Real, 3>& moving) {
    Moving<Real, N> result;
    std::copy_n(moving.start.begin(), N, result.start.begin());
    std::copy_n(moving.end.begin(), N, result.end.begin());
    return result;
}

}  // namespace

template <class Real>
std::vector<MovingPair<Real>> random_moving_pairs(PairOf what, std::size_t count, unsigned seed) {
    Maker make(seed);
    std::vector<MovingPair<Real>> pairs(count);
    for (auto& result : pairs) {
        MovingPair<double> pair = random_pair(make);
        keep_corners(pair.a, first_corners(what));
        keep_corners(pair.b, second_corners(what));
        result = converted<Real>(pair, [](const Point& p) { return p; });
    }
    return pairs;
}

template <class Real>
std::vector<MovingPair<Real>> touching_pairs(PairOf what, std::size_t count, unsigned seed) {
    Maker make(seed);
    std::vector<MovingPair<Real>> pairs(count);
    for (std::size_t n = 0; n < count; ++n) pairs[n] = placed<Real>(touching_pair(make, what), n, make);
    return pairs;
}

template <class Real>
std::vector<MovingPair<Real>> nearly_touching_pairs(PairOf what, std::size_t count, unsigned seed) {
    Maker make(seed);
    std::vector<MovingPair<Real>> pairs(count);
    for (std::size_t n = 0; n < count; ++n) {
        MovingPair<double> pair = touching_pair(make, what);
        const Point shift = make.point(extent(pair) * make.magnitude(1e-8, 1e-2));
        for (int k = 0; k < 3; ++k) {
            pair.b.start[k] += shift;
            pair.b.end[k] += shift;
        }
        pairs[n] = placed<Real>(pair, n, make);
    }
    return pairs;
}

template <class Real>
std::optional<Real> impact(PairOf what, const MovingPair<Real>& pair) {
    switch (what) {
        case PairOf::node_and_face:
            return cpu::time_of_impact(reduced<1>(pair.a), pair.b);
        case PairOf::edges:
            return cpu::time_of_impact(reduced<2>(pair.a), reduced<2>(pair.b));
        case PairOf::faces:
            break;
    }
    return cpu::time_of_impact(pair.a, pair.b);
}

template <class Real>
double distance_at(const MovingPair<Real>& pair, double time) {
    const auto a = corners_at(pair.a, time), b = corners_at(pair.b, time);
    long double least = INFINITY;
    for (int i = 0; i < 3; ++i) {
        least = std::min({least, plane_distance(a[i], b), plane_distance(b[i], a)});
        for (int j = 0; j < 3; ++j)
            least = std::min(least, edge_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
    }
    return static_cast<double>(least);
}

template <class Real>
std::optional<double> comes_near(const MovingPair<Real>& pair, double distance) {
    if (cpu::triangles_overlap(start_of(pair.a), start_of(pair.b))) return 0.0;
    const double speed = relative_speed(pair);
    double time = 0.0;
    for (int steps = 0; steps < 10'000; ++steps) {
        const double apart = distance_at(pair, time);
        if (apart <= 2.0 * distance) return time;
        if (time == 1.0 || speed == 0.0) break;
        time = std::min(time + (apart - distance) / speed, 1.0);
    }
    return std::nullopt;
}

template <class Real>
double extent(const MovingPair<Real>& pair) {
    MovingPair<Real> moved = pair;
    const cpu::Vec3<Real> reach = cpu::impact::make_relative(moved.a, moved.b);
    return static_cast<double>(std::max({reach.x, reach.y, reach.z}));
}

#define GELATIN_INSTANTIATE(Real)                                                                      \
    template std::vector<MovingPair<Real>> random_moving_pairs<Real>(PairOf, std::size_t, unsigned);   \
    template std::vector<MovingPair<Real>> touching_pairs<Real>(PairOf, std::size_t, unsigned);        \
    template std::vector<MovingPair<Real>> nearly_touching_pairs<Real>(PairOf, std::size_t, unsigned); \
    template std::optional<Real> impact<Real>(PairOf, const MovingPair<Real>&);                        \
    template double distance_at<Real>(const MovingPair<Real>&, double);                                \
    template std::optional<double> comes_near<Real>(const MovingPair<Real>&, double);                  \
    template double extent<Real>(const MovingPair<Real>&);
GELATIN_INSTANTIATE(float)
GELATIN_INSTANTIATE(double)
#undef GELATIN_INSTANTIATE

}  // namespace gelatin::test
