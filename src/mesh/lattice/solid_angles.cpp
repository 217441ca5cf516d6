#include "mesh/lattice/solid_angles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace gelatin::lattice {
namespace {

constexpr double kNear =
    3.0;  // times the radius of the faces; the accuracy that the header states follows from this

/// Adds up half solid angles, each the angle of a complex number. The numbers are multiplied, so that one
/// atan2 does for several: with the signs of the angles that are added it is known where the sum passes pi.
class AngleSum {
public:
    void add(double real, double imaginary) {
        if (real == 0.0 && imaginary == 0.0) return;  // at a corner of the face
        const bool is_up = imaginary_ > 0.0, is_down = imaginary_ < 0.0;
        const double product = real_ * real - imaginary_ * imaginary;
        imaginary_ = real_ * imaginary + imaginary_ * real;
        real_ = product;
        if (is_up && imaginary > 0.0 && imaginary_ < 0.0) ++turns_;
        if (is_down && imaginary < 0.0 && imaginary_ > 0.0) --turns_;
        if (++factors_ == kMostFactors || std::abs(real_) + std::abs(imaginary_) < kSmall) finish();
    }
    double sum() {
        finish();
        return sum_;
    }

private:
    static constexpr int kMostFactors = 8;
    static constexpr double kSmall = 1e-100;  // before they underflow

    void finish() {
        sum_ += std::atan2(imaginary_, real_) + 2.0 * std::numbers::pi * turns_;
        real_ = 1.0;
        imaginary_ = 0.0;
        turns_ = factors_ = 0;
    }

    double sum_ = 0.0, real_ = 1.0, imaginary_ = 0.0;
    int turns_ = 0, factors_ = 0;
};

double sum_of_half_angles(std::span<const Triangle> faces, const glm::dvec3& p) {
    AngleSum sum;
    for (const Triangle& face : faces) {
        const glm::dvec3 a = face[0] - p, b = face[1] - p, c = face[2] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum.add(la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb,
                glm::dot(a, glm::cross(b, c)));
    }
    return sum.sum();
}

glm::dvec3 area_vector(const Triangle& face) {
    return 0.5 * glm::cross(face[1] - face[0], face[2] - face[0]);
}

}  // namespace

double exact_winding_number(std::span<const Triangle> faces, const glm::dvec3& p) {
    return sum_of_half_angles(faces, p) / (2.0 * std::numbers::pi);
}

SolidAngles::SolidAngles(const FaceTree& tree) : tree_(tree), moments_(tree.nodes().size()) {
    tbb::parallel_for(std::size_t{0}, moments_.size(),
                      [&](std::size_t n) { moments_[n] = moments_of(tree_.faces_of(tree_.nodes()[n])); });
}

SolidAngles::Moments SolidAngles::moments_of(std::span<const Triangle> faces) {
    Moments moments;
    double area = 0.0;
    for (const Triangle& face : faces) {
        const double weight = glm::length(area_vector(face));
        moments.center += weight / 3.0 * (face[0] + face[1] + face[2]);
        area += weight;
    }
    moments.center = area > 0.0 ? moments.center / area : faces[0][0];
    double radius = 0.0;
    for (const Triangle& face : faces) {
        const glm::dvec3 n = area_vector(face), a = face[0] - moments.center, b = face[1] - moments.center,
                         c = face[2] - moments.center, mean = (a + b + c) / 3.0;
        radius = std::max({radius, glm::length(a), glm::length(b), glm::length(c)});
        moments.normal += n;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            moments.first[i] += n[i] * mean[i];
            moments.first[3 + i] += n[i] * mean[j] + n[j] * mean[i];
        }
        // Of x_j x_k over the triangle, by its area.
        const auto square = [&](int j, int k) {
            return (a[j] * a[k] + b[j] * b[k] + c[j] * c[k] + 9.0 * mean[j] * mean[k]) / 12.0;
        };
        const double xx = square(0, 0), yy = square(1, 1), zz = square(2, 2), xy = square(0, 1),
                     yz = square(1, 2), zx = square(2, 0);
        moments.trace += glm::dvec3(n.x * xx + n.y * xy + n.z * zx, n.x * xy + n.y * yy + n.z * yz,
                                    n.x * zx + n.y * yz + n.z * zz) +
                         0.5 * (xx + yy + zz) * n;
        const std::array<double, 10> second = {n.x * xx,
                                               n.y * yy,
                                               n.z * zz,
                                               2.0 * n.x * xy + n.y * xx,
                                               2.0 * n.x * zx + n.z * xx,
                                               2.0 * n.y * xy + n.x * yy,
                                               2.0 * n.y * yz + n.z * yy,
                                               2.0 * n.z * zx + n.x * zz,
                                               2.0 * n.z * yz + n.y * zz,
                                               2.0 * (n.x * yz + n.y * zx + n.z * xy)};
        for (std::size_t k = 0; k < second.size(); ++k) moments.second[k] += second[k];
    }
    moments.near = kNear * radius;
    return moments;
}

// With G(x) = x / |x|^3, the field whose flux through a face is its solid angle:
// flux = n.G + n_i x_j dG_i/dx_j + n_i x_j x_k d2G_i/dx_j dx_k / 2, all at the center.
double SolidAngles::expand(const Moments& m, const glm::dvec3& d, double distance) {
    const double r1 = 1.0 / distance, r2 = r1 * r1, r3 = r1 * r2, r5 = r3 * r2, r7 = r5 * r2;
    const double x = d.x, y = d.y, z = d.z;
    const double zeroth = glm::dot(m.normal, d) * r3;
    const double along = m.first[0] * x * x + m.first[1] * y * y + m.first[2] * z * z + m.first[3] * x * y +
                         m.first[4] * y * z + m.first[5] * z * x;
    const double first = (m.first[0] + m.first[1] + m.first[2]) * r3 - 3.0 * along * r5;
    const double cubic = m.second[0] * x * x * x + m.second[1] * y * y * y + m.second[2] * z * z * z +
                         m.second[3] * x * x * y + m.second[4] * x * x * z + m.second[5] * y * y * x +
                         m.second[6] * y * y * z + m.second[7] * z * z * x + m.second[8] * z * z * y +
                         m.second[9] * x * y * z;
    const double second = -3.0 * glm::dot(m.trace, d) * r5 + 7.5 * cubic * r7;
    return zeroth + first + second;
}

double SolidAngles::operator()(const glm::dvec3& p) const {
    double solid_angle = 0.0;
    if (moments_.empty()) return 0.0;
    std::array<std::uint32_t, BoxNodes::kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Moments& moments = moments_[index];
        const BoxNode& node = tree_.nodes()[index];
        const glm::dvec3 d = moments.center - p;
        const double distance = glm::length(d);
        if (distance > moments.near) {
            solid_angle += expand(moments, d, distance);
        } else if (node.right == 0) {
            solid_angle += 2.0 * sum_of_half_angles(tree_.faces_of(node), p);
        } else {
            stack[size++] = node.right;
            stack[size++] = index + 1;
        }
    }
    return solid_angle / (4.0 * std::numbers::pi);
}

}  // namespace gelatin::lattice
