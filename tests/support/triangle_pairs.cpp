#include "support/triangle_pairs.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "support/random_maker.h"

namespace gelatin::test {
namespace {

using cpu::Triangle;
using Point = glm::dvec3;

class PairMaker : public RandomMaker {
public:
    using RandomMaker::RandomMaker;

    Point grid_point() { return {integer(0, 3), integer(0, 3), integer(0, 3)}; }
    Triangle<double> triangle() { return {point(), point(), point()}; }

    Point on_edge(const Triangle<double>& t) { return glm::mix(t[0], t[1], uniform(-0.1, 1.1)); }
    Point on_face(const Triangle<double>& t) {
        const double b = uniform(-0.1, 0.6), c = uniform(-0.1, 0.6);
        return t[0] + b * (t[1] - t[0]) + c * (t[2] - t[0]);
    }
    // Coordinates with few bits stay exact where they are placed, so that sums and halves of them do, too.
    Point coarse_point() { return glm::round(point() * 64.0) / 64.0; }

    TrianglePair<double> random_pair() {
        TrianglePair<double> pair;
        const double size_of_s = magnitude(0.1, 1.0), size_of_t = magnitude(0.1, 1.0);
        const Point apart = point(0.4 * std::max(size_of_s, size_of_t));
        for (int i = 0; i < 3; ++i) {
            pair.s[i] = size_of_s * point();
            pair.t[i] = size_of_t * point() + apart;
        }
        return pair;
    }

    TrianglePair<double> pair_of(PairKind kind) {
        TrianglePair<double> pair{triangle(), triangle()};
        auto& [s, t] = pair;
        switch (kind) {
            case PairKind::shared_vertex:
                t[0] = s[0];
                break;
            case PairKind::shared_edge:
                t[0] = s[1];
                t[1] = s[0];
                break;
            case PairKind::identical:
                t = s;
                break;
            case PairKind::vertex_on_face:
                t[0] = on_face(s);
                break;
            case PairKind::edge_on_edge:
                t[0] = 2.0 * on_edge(s) - t[1];
                break;
            case PairKind::vertex_on_edge:
                t[0] = on_edge(s);
                break;
            case PairKind::coplanar:
                make_coplanar(pair);
                break;
            case PairKind::parallel: {
                const Point shift = point(1e-7);
                for (int i = 0; i < 3; ++i) t[i] = on_face(s) + shift;
                break;
            }
            case PairKind::sliver:
                s[2] = on_edge(s) + point(1e-7);
                t[2] = on_edge(t) + point(1e-7);
                if (integer(0, 1) == 1) t[0] = on_edge(s);
                break;
            case PairKind::segment:
                make_segment(pair);
                break;
            case PairKind::point:
                t[0] = integer(0, 1) == 1 ? s[integer(0, 2)] : on_face(s);
                t[1] = t[2] = t[0];
                if (integer(0, 3) == 0) s = {s[0], s[0], s[0]};
                break;
            case PairKind::collinear: {
                const Point origin = coarse_point(), along = coarse_point();
                for (Point& p : s) p = origin + double(integer(0, 6)) * along;
                for (Point& p : t) p = origin + double(integer(3, 9)) * along;
                break;
            }
            case PairKind::integer_grid:
                for (int i = 0; i < 3; ++i) {
                    s[i] = grid_point();
                    t[i] = grid_point();
                }
                break;
        }
        return pair;
    }

    // By up to four units in the last place; zero stays, as its neighbours are subnormal.
    template <class Real>
    Real nudge(Real value) {
        const int steps = integer(-4, 4);
        const Real limit = std::copysign(std::numeric_limits<Real>::max(), Real(steps));
        for (int i = 0; i < std::abs(steps) && value != Real(0); ++i) value = std::nextafter(value, limit);
        return value;
    }

private:
    void make_coplanar(TrianglePair<double>& pair) {
        auto& [s, t] = pair;
        if (integer(0, 1) == 1) {  // in a plane of two axes
            const int axis = integer(0, 2);
            for (int i = 0; i < 3; ++i) s[i][axis] = t[i][axis] = s[0][axis];
            return;
        }
        const Point origin = coarse_point(), u = coarse_point(), v = coarse_point();
        for (int i = 0; i < 3; ++i) {
            s[i] = origin + double(integer(0, 4)) * u + double(integer(0, 4)) * v;
            t[i] = origin + double(integer(2, 6)) * u + double(integer(0, 4)) * v;
        }
    }

    void make_segment(TrianglePair<double>& pair) {
        auto& [s, t] = pair;
        t[0] = coarse_point();
        t[1] = coarse_point();
        switch (integer(0, 3)) {
            case 0:
                t[2] = t[1];
                break;
            case 1:
                t[2] = 0.5 * (t[0] + t[1]);
                break;
            case 2:
                t[2] = 2.0 * t[1] - t[0];
                break;
            default:  // two segments that cross, near a common point
                t[1] = t[2] = 2.0 * on_edge(s) - t[0];
                s[2] = s[0];
        }
    }
};

template <class Real>
Triangle<Real> rounded(const Triangle<double>& t, double scale, const Point& offset) {
    Triangle<Real> result;
    for (int i = 0; i < 3; ++i) result[i] = cpu::Vec3<Real>(scale * t[i] + offset);
    return result;
}

}  // namespace

template <class Real>
std::vector<TrianglePair<Real>> random_pairs(std::size_t count, unsigned seed) {
    PairMaker make(seed);
    std::vector<TrianglePair<Real>> pairs(count);
    for (auto& pair : pairs) {
        const TrianglePair<double> made = make.random_pair();
        pair = {rounded<Real>(made.s, 1.0, Point(0.0)), rounded<Real>(made.t, 1.0, Point(0.0))};
    }
    return pairs;
}

template <class Real>
std::vector<TrianglePair<Real>> degenerate_pairs(PairKind kind, std::size_t count, unsigned seed) {
    PairMaker make(seed);
    std::vector<TrianglePair<Real>> pairs(count);
    for (std::size_t n = 0; n < count; ++n) {
        const TrianglePair<double> made = make.pair_of(kind);
        double scale = 1.0;  // powers of two: scaling rounds nothing
        Point offset(0.0);
        switch (n / 2 % 4) {
            case 1:
                offset = glm::round(make.point(1.0) * make.magnitude(1e3, 1e6));
                break;
            case 2:
                scale = std::exp2(-make.integer(20, 30));
                break;
            case 3:
                scale = std::exp2(make.integer(10, 20));
                break;
            default:
                break;
        }
        pairs[n] = {rounded<Real>(made.s, scale, offset), rounded<Real>(made.t, scale, offset)};
        if (n % 2 == 0) continue;
        for (Triangle<Real>* t : {&pairs[n].s, &pairs[n].t}) {
            cpu::Vec3<Real>& p = (*t)[make.integer(0, 2)];
            for (int axis = 0; axis < 3; ++axis) p[axis] = make.nudge(p[axis]);
        }
    }
    return pairs;
}

template std::vector<TrianglePair<float>> random_pairs<float>(std::size_t, unsigned);
template std::vector<TrianglePair<double>> random_pairs<double>(std::size_t, unsigned);
template std::vector<TrianglePair<float>> degenerate_pairs<float>(PairKind, std::size_t, unsigned);
template std::vector<TrianglePair<double>> degenerate_pairs<double>(PairKind, std::size_t, unsigned);

}  // namespace gelatin::test
