#include "model/assembly/rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numeric>

#include "mesh/shapes.h"
#include "model/assembly/build_model.h"

namespace gelatin::rigid_body_test {
namespace {

// Of points with masses.
MassMoments moments_of(const std::vector<glm::dvec3>& points, const std::vector<double>& masses) {
    MassMoments moments;
    for (std::size_t n = 0; n < points.size(); ++n) {
        moments.mass += masses[n];
        moments.center += masses[n] * points[n];
    }
    moments.center /= moments.mass;
    for (std::size_t n = 0; n < points.size(); ++n) {
        const glm::dvec3 r = points[n] - moments.center;
        moments.square += masses[n] * glm::outerProduct(r, r);
    }
    return moments;
}

void expect_same(const MassMoments& found, const MassMoments& wanted) {
    const double size = std::sqrt(wanted.square[0][0] + wanted.square[1][1] + wanted.square[2][2]);
    EXPECT_NEAR(found.mass, wanted.mass, 1e-12 * wanted.mass);
    EXPECT_LT(glm::distance(found.center, wanted.center), 1e-12 * size);
    for (int k = 0; k < 3; ++k)
        EXPECT_LT(glm::distance(found.square[k], wanted.square[k]), 1e-12 * size * size) << k;
}

SurfaceMesh moved(SurfaceMesh mesh, const glm::dquat& rotation, const glm::dvec3& by) {
    for (glm::dvec3& p : mesh.positions) p = rotation * p + by;
    return mesh;
}

TEST(SolidMoments, OfABoxAreExact) {
    const glm::dvec3 size(1.0, 0.2, 0.5), at(3.0, -2.0, 7.0);
    const MassMoments found =
        solid_moments(moved(make_box({size, {2, 1, 3}}), {1.0, 0.0, 0.0, 0.0}, at), 500.0);
    const double mass = 500.0 * 0.1;
    expect_same(found, {mass, at,
                        mass / 12.0 *
                            glm::dmat3(size.x * size.x, 0.0, 0.0,  //
                                       0.0, size.y * size.y, 0.0,  //
                                       0.0, 0.0, size.z * size.z)});
}

TEST(SolidMoments, OfABallAreNearlyExact) {
    const MassMoments found = solid_moments(make_sphere({0.5, 30}), 1000.0);
    const double mass = 1000.0 * 4.0 / 3.0 * 3.141592653589793 * 0.125;
    EXPECT_NEAR(found.mass, mass, 2e-3 * mass);
    EXPECT_NEAR(found.square[1][1], mass * 0.25 / 5.0, 4e-3 * mass * 0.05);
}

// Whatever the shape, nodes have its mass, centre and inertia, and none too little mass.
TEST(RigidNodes, HaveTheMomentsOfWhatTheyStandFor) {
    const glm::dquat turned = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
    for (const SurfaceMesh& shape :
         {make_box({{1.0, 0.2, 0.5}, {1, 1, 1}}), make_box({{1.0, 1.0, 0.01}, {4, 4, 1}}),
          make_sphere({0.3, 4}), make_capsule({0.1, 1.0, 4})}) {
        const SurfaceMesh mesh = moved(shape, turned, {0.3, 0.1, -2.0});
        const MassMoments wanted = solid_moments(mesh, 700.0);
        const RigidNodes nodes = make_rigid_nodes(mesh, wanted);
        ASSERT_EQ(nodes.masses.size(), mesh.positions.size() + 4);
        expect_same(moments_of(nodes.mesh.positions, nodes.masses), wanted);
        const double of_surface =
            std::accumulate(nodes.masses.begin(), nodes.masses.end() - 4, 0.0) / wanted.mass;
        EXPECT_GT(of_surface, 0.01);
        EXPECT_LE(of_surface, 0.25 + 1e-12);
        for (const double mass : nodes.masses) EXPECT_GT(mass, 0.0);
    }
}

TEST(RigidNodes, HaveMassAndInertiaAsGiven) {
    const glm::dquat turned = glm::angleAxis(0.5, glm::dvec3(0.0, 0.0, 1.0));
    const SurfaceMesh mesh = moved(make_box({{1.0, 0.2, 0.5}, {1, 1, 1}}), turned, {1.0, 0.0, 0.0});
    RigidDescription description;
    description.mass = 3.0;
    const MassMoments of_shape = solid_moments(mesh, 1000.0),
                      by_mass = with_description(of_shape, description, turned);
    EXPECT_NEAR(by_mass.mass, 3.0, 1e-12);
    EXPECT_NEAR(by_mass.square[2][2], of_shape.square[2][2] * 3.0 / of_shape.mass, 1e-12);
    description.inertia = glm::dvec3(0.5, 0.4, 0.3);
    const MassMoments given = with_description(of_shape, description, turned);
    const RigidNodes nodes = make_rigid_nodes(mesh, given);
    const MassMoments found = moments_of(nodes.mesh.positions, nodes.masses);
    expect_same(found, given);
    const double trace = found.square[0][0] + found.square[1][1] + found.square[2][2];
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0.0);
        axis[k] = 1.0;
        axis = turned * axis;
        EXPECT_NEAR(trace - glm::dot(axis, found.square * axis), (*description.inertia)[k], 1e-12) << k;
    }
}

}  // namespace
}  // namespace gelatin::rigid_body_test
