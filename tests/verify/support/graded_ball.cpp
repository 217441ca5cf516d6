#include "verify/support/graded_ball.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gelatin::test {
namespace {

// Rings of vertices about the y axis, from the lowest point up. Edges grow with the distance from `patch`.
class GradedSphere {
public:
    GradedSphere(double radius, double edge, double patch) : radius_(radius) {
        constexpr double kPi = std::numbers::pi, kLongest = 0.14, kTop = 0.1;
        double arc = 0.0;
        Ring below = add_ring(0.0, 1);
        while (below.first == 0 || below.count > 1) {
            const double length = edge + 0.25 * std::max(0.0, arc - patch);
            arc += std::min(length, kLongest * radius);
            const bool is_top = arc > (kPi - kTop) * radius;
            const double angle = is_top ? kPi : arc / radius;
            const double count = 2 * kPi * radius * std::sin(angle) / length;
            const Ring ring = add_ring(angle, is_top ? 1 : static_cast<std::uint32_t>(std::max(6.0, count)));
            join(below, ring);
            below = ring;
        }
    }
    SurfaceMesh mesh;

private:
    struct Ring {
        std::uint32_t first, count;

        // Around from the first vertex to the k-th, from 0 to 1.
        double place(std::uint32_t k) const { return static_cast<double>(k) / count; }
        std::uint32_t vertex(std::uint32_t k) const { return first + k % count; }
        std::uint32_t steps() const { return count > 1 ? count : 0; }  // a pole has none
    };

    Ring add_ring(double angle, std::uint32_t count) {
        const Ring ring{static_cast<std::uint32_t>(mesh.positions.size()), count};
        for (std::uint32_t k = 0; k < count; ++k) {
            const double around = 2 * std::numbers::pi * ring.place(k);
            const glm::dvec3 direction(std::sin(angle) * std::cos(around), -std::cos(angle),
                                       std::sin(angle) * std::sin(around));
            mesh.positions.push_back(radius_ * direction);
        }
        return ring;
    }
    // Triangles between two rings, of any number of vertices.
    void join(const Ring& low, const Ring& high) {
        for (std::uint32_t i = 0, j = 0; i < low.steps() || j < high.steps();) {
            const bool on_low =
                j == high.steps() || (i < low.steps() && low.place(i + 1) < high.place(j + 1));
            mesh.faces.emplace_back(low.vertex(i), high.vertex(j),
                                    on_low ? low.vertex(i + 1) : high.vertex(j + 1));
            ++(on_low ? i : j);
        }
    }

    double radius_;
};

}  // namespace

// Spheres inside one another, each nearly touching the last one below: at the depth where edges of this
// length are wanted.
SurfaceMesh make_graded_ball(double radius, double edge) {
    constexpr double kGrowth = 0.3, kDeepest = 0.3, kShrinking = 0.6;
    const double patch = 0.2 * radius;
    SurfaceMesh ball = GradedSphere(radius, edge, patch).mesh;
    double depth = edge, inner = kShrinking * radius;
    while (depth < kDeepest * radius) {
        const double length = edge + kGrowth * depth;
        if (inner < 2.5 * length) break;  // the next one would not be inside
        const SurfaceMesh layer = GradedSphere(inner, length, patch).mesh;
        const auto first = static_cast<std::uint32_t>(ball.positions.size());
        for (const glm::dvec3& p : layer.positions)
            ball.positions.push_back(p + glm::dvec3(0.0, inner - radius + depth, 0.0));
        for (const glm::uvec3& f : layer.faces) ball.faces.push_back(f + first);
        depth += length;
        inner *= kShrinking;
    }
    return ball;
}

}  // namespace gelatin::test
