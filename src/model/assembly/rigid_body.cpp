#include "model/assembly/rigid_body.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gelatin {
namespace {

// Of a symmetric matrix S >= 0, L with L L^T = S; the least eigenvalue.
struct Root {
    glm::dmat3 root;
    double least;
};

Root square_root(const glm::dmat3& s) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m(i, j) = s[j][i];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(m);
    Root result{glm::dmat3(0.0), solved.eigenvalues().minCoeff()};
    for (int j = 0; j < 3; ++j) {
        const double length = std::sqrt(std::max(solved.eigenvalues()(j), 0.0));
        for (int i = 0; i < 3; ++i) result.root[j][i] = length * solved.eigenvectors()(i, j);
    }
    return result;
}

// Of nodes, a third of their faces; all together 1.
std::vector<double> shares_of_area(const SurfaceMesh& surface) {
    std::vector<double> shares(surface.positions.size(), 0.0);
    double sum = 0.0;
    for (const glm::uvec3& face : surface.faces) {
        const glm::dvec3& a = surface.positions[face.x];
        const double area =
            glm::length(glm::cross(surface.positions[face.y] - a, surface.positions[face.z] - a));
        for (int k = 0; k < 3; ++k) shares[face[k]] += area;
        sum += 3.0 * area;
    }
    for (double& share : shares) share /= sum;
    return shares;
}

}  // namespace

MassMoments solid_moments(const SurfaceMesh& surface, double density) {
    const glm::dvec3 origin = surface.positions[surface.faces[0].x];  // near, against cancellation
    double volume = 0.0;
    glm::dvec3 first(0.0);
    glm::dmat3 second(0.0);
    // A tet from the origin to each face, negative where that is seen from behind.
    for (const glm::uvec3& face : surface.faces) {
        const glm::dvec3 a = surface.positions[face.x] - origin, b = surface.positions[face.y] - origin,
                         c = surface.positions[face.z] - origin, sum = a + b + c;
        const double v = glm::dot(a, glm::cross(b, c)) / 6.0;
        volume += v;
        first += v / 4.0 * sum;
        second += v / 20.0 *
                  (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                   glm::outerProduct(sum, sum));
    }
    const glm::dvec3 middle = first / volume;
    return {density * volume, origin + middle,
            density * (second - volume * glm::outerProduct(middle, middle))};
}

MassMoments with_description(MassMoments moments, const RigidDescription& description,
                             const glm::dquat& orientation) {
    if (description.mass) {
        moments.square *= *description.mass / moments.mass;
        moments.mass = *description.mass;
    }
    if (description.inertia) {
        const glm::dvec3& i = *description.inertia;
        const glm::dmat3 axes = glm::mat3_cast(orientation);
        const glm::dvec3 squares = glm::dvec3(0.5 * (i.x + i.y + i.z)) - i;
        moments.square = glm::dmat3(0.0);
        for (int k = 0; k < 3; ++k) moments.square += squares[k] * glm::outerProduct(axes[k], axes[k]);
    }
    return moments;
}

// The mass m of all is divided into e m on the surface, around c + d, with the second moment e m A about c,
// and the rest, whose centre is therefore c - e / (1 - e) d, with the second moment about that of
//   S - e m A - e^2 m / (1 - e) d d^T.
// Surfaces are farther out than what they enclose, so e has to be small enough for that to be one of masses.
RigidNodes make_rigid_nodes(const SurfaceMesh& surface, const MassMoments& moments) {
    constexpr double kMostOnSurface = 0.25, kLeastOnSurface = 1e-3;
    const std::vector<double> shares = shares_of_area(surface);
    glm::dvec3 d(0.0);
    glm::dmat3 of_surface(0.0);
    for (std::size_t n = 0; n < shares.size(); ++n) {
        const glm::dvec3 r = surface.positions[n] - moments.center;
        d += shares[n] * r;
        of_surface += shares[n] * glm::outerProduct(r, r);
    }
    const double least = square_root(moments.square).least;
    double e = 2.0 * kMostOnSurface;
    Root left{};
    do {
        e *= 0.5;
        left = square_root(moments.square - e * moments.mass * of_surface -
                           e * e / (1.0 - e) * moments.mass * glm::outerProduct(d, d));
    } while (left.least < 0.25 * least && e > kLeastOnSurface);
    RigidNodes nodes{{surface.positions, {}, surface.faces}, {}};
    for (const double share : shares) nodes.masses.push_back(e * moments.mass * share);
    const double mass = (1.0 - e) * moments.mass;
    constexpr std::array<glm::dvec3, 4> kTetrahedron{glm::dvec3(1.0, 1.0, 1.0), glm::dvec3(1.0, -1.0, -1.0),
                                                     glm::dvec3(-1.0, 1.0, -1.0),
                                                     glm::dvec3(-1.0, -1.0, 1.0)};
    for (const glm::dvec3& corner : kTetrahedron) {
        nodes.mesh.positions.push_back(moments.center - e / (1.0 - e) * d +
                                       left.root * corner / std::sqrt(mass));
        nodes.masses.push_back(0.25 * mass);
    }
    return nodes;
}

}  // namespace gelatin
