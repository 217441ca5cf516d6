#include "cpu/contact/feasible_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "cpu/contact/nearest_pairs.h"
#include "cpu/contact/tuning.h"
#include "mesh/shapes.h"
#include "model/collision/node_faces.h"
#include "model/collision/surface_parts.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

// An object of each mesh, and how their pairs press.
class Surfaces {
public:
    explicit Surfaces(const std::vector<SurfaceMesh>& meshes) {
        for (const SurfaceMesh& mesh : meshes) append(mesh);
        model_.node_faces = make_node_faces(model_.node_count(), model_.faces);
        model_.surface_parts = make_surface_parts(model_.faces, model_.node_faces);
        surface_ = make_contact_surface(model_, {.friction = 0.4});
    }
    std::uint32_t first_node(std::size_t object) const { return model_.objects[object].nodes.first; }
    const Range& faces(std::size_t object) const { return model_.objects[object].faces; }
    void place(std::uint32_t node, const glm::dvec3& at) { positions_[node] = glm::dvec4(at, 1.0); }

    struct Pressure {
        double weight, gap;
    };
    Pressure of_node_and_face(std::uint32_t node, std::uint32_t f) const {
        const Face& face = model_.faces[f];
        return pressure({{node, face.a, face.b, face.c}, node, f, 0, face.object, 1, 0.1f});
    }
    double weight_of_node(std::uint32_t node, const glm::dvec3& apart) const {
        return cpu::FeasibleRegion<double>(model_, surface_, positions_).weight_of_node(node, apart);
    }
    glm::dvec3 at(std::uint32_t node) const { return glm::dvec3(positions_[node]); }
    // Of the edges between two nodes each.
    Pressure of_edges(const glm::uvec2& first, const glm::uvec2& second) const {
        const std::uint32_t e = edge(first), f = edge(second);
        const FaceEdge &a = model_.surface_parts.edges[e], &b = model_.surface_parts.edges[f];
        return pressure({{a.a, a.b, b.a, b.b}, e, f, a.object, b.object, 2, 0.1f});
    }

private:
    void append(const SurfaceMesh& mesh) {
        const auto object = static_cast<std::uint32_t>(model_.objects.size()), first = model_.node_count(),
                   first_face = static_cast<std::uint32_t>(model_.faces.size());
        for (const glm::dvec3& p : mesh.positions) {
            positions_.emplace_back(p, 1.0);
            model_.positions.emplace_back(positions_.back());
        }
        for (const glm::uvec3& f : mesh.faces)
            model_.faces.push_back({first + f.x, first + f.y, first + f.z, object});
        ModelObject& added = model_.objects.emplace_back();
        added.nodes = {first, static_cast<std::uint32_t>(mesh.positions.size())};
        added.faces = {first_face, static_cast<std::uint32_t>(mesh.faces.size())};
    }
    std::uint32_t edge(const glm::uvec2& ends) const {
        const std::vector<FaceEdge>& edges = model_.surface_parts.edges;
        const auto found = std::find_if(edges.begin(), edges.end(), [&](const FaceEdge& e) {
            return e.a == std::min(ends.x, ends.y) && e.b == std::max(ends.x, ends.y);
        });
        EXPECT_NE(found, edges.end());
        return static_cast<std::uint32_t>(found - edges.begin());
    }
    Pressure pressure(const cpu::ContactPair& pair) const {
        cpu::MeasuredPairs<double> m;
        cpu::measure_pairs(std::span(&pair, 1), positions_, m);
        const cpu::FeasibleRegion<double> region(model_, surface_, positions_);
        return {region.weight(pair, {m.apart[0][0], m.apart[1][0], m.apart[2][0]},
                              {m.weights[0][0], m.weights[1][0], m.weights[2][0], m.weights[3][0]}),
                m.gaps[0]};
    }

    Model model_;
    ContactSurface surface_;
    std::vector<glm::dvec4> positions_;
};

// A flat sheet of squares of 1 m with its border at 0 and `cells`, in the plane z = 0. Neighbouring squares
// are halved differently.
SurfaceMesh make_sheet(unsigned cells) {
    SurfaceMesh sheet;
    for (unsigned y = 0; y <= cells; ++y)
        for (unsigned x = 0; x <= cells; ++x) sheet.positions.emplace_back(x, y, 0);
    for (unsigned y = 0; y < cells; ++y) {
        for (unsigned x = 0; x < cells; ++x) {
            const unsigned a = y * (cells + 1) + x, b = a + 1, c = b + cells + 1, d = c - 1;
            if ((x + y) % 2 == 0) {
                sheet.faces.insert(sheet.faces.end(), {{a, b, c}, {a, c, d}});
            } else {
                sheet.faces.insert(sheet.faces.end(), {{b, d, a}, {c, d, b}});
            }
        }
    }
    return sheet;
}

const SurfaceMesh kNode{{glm::dvec3(0)}, {}};

// Where a surface is convex, each point outside of it has one nearest point. One face presses there. Pairs
// through a body are never listed, of which this is half as thick.
constexpr double kFarthest = 1.0;  // [m]

void expect_one_face_presses(Surfaces& surfaces, const glm::dvec3& point) {
    const std::uint32_t node = surfaces.first_node(1);
    surfaces.place(node, point);
    double sum = 0.0, pressing_gap = 0.0, least_gap = 1e30;
    const Range& faces = surfaces.faces(0);
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        const auto [weight, gap] = surfaces.of_node_and_face(node, f);
        if (gap > kFarthest) continue;
        sum += weight;
        pressing_gap += weight * gap;
        least_gap = std::min(least_gap, gap);
    }
    EXPECT_EQ(sum, 1.0) << point.x << " " << point.y << " " << point.z;
    // Beside an edge another face may press, at its point on the edge.
    const double most = 0.5 * cpu::tuning::kHardly * cpu::tuning::kHardly * least_gap;
    EXPECT_NEAR(pressing_gap, least_gap, most + 1e-12) << point.x << " " << point.y << " " << point.z;
}

// Points above faces, edges and nodes of a sheet, beside its border and beyond its corners.
TEST(FeasibleRegion, OneFaceOfASheetPressesANode) {
    Surfaces surfaces({make_sheet(3), kNode});
    for (const double height : {0.25, -0.5})
        for (double x = -0.5; x < 3.75; x += 0.25)
            for (double y = -0.5; y < 3.75; y += 0.25) expect_one_face_presses(surfaces, {x, y, height});
    test::RandomMaker random(1);
    for (int k = 0; k < 300; ++k)
        expect_one_face_presses(surfaces, glm::dvec3(1.5, 1.5, 0) + glm::dvec3(2, 2, 0.7) * random.point());
}

// Straight away from the inside of a sheet, hardly towards another node of it; in all directions in which a
// corner is the farthest node.
TEST(FeasibleRegion, NodesPressAwayFromTheirSurface) {
    const Surfaces sheet({make_sheet(3)});
    const std::uint32_t inside = 5;  // at (1, 1, 0)
    for (const double up : {1.0, -1.0}) {
        EXPECT_EQ(sheet.weight_of_node(inside, {0.0, 0.0, 0.3 * up}), 1.0);
        EXPECT_EQ(sheet.weight_of_node(inside, {0.01, 0.0, 0.3 * up}), 1.0);
        EXPECT_NEAR(sheet.weight_of_node(inside, {0.02, 0.0, 0.3 * up}), 0.34, 0.1);
        EXPECT_EQ(sheet.weight_of_node(inside, {0.1, 0.0, 0.3 * up}), 0.0);
    }
    const Surfaces cube({make_box({glm::dvec3(2), glm::ivec3(1)})});
    for (std::uint32_t n = 0; n < 8; ++n) {
        const glm::dvec3 corner = cube.at(n);
        EXPECT_EQ(cube.weight_of_node(n, corner), 1.0);
        EXPECT_EQ(cube.weight_of_node(n, {corner.x, 0.0, 0.0}), 1.0);
        EXPECT_EQ(cube.weight_of_node(n, {-corner.x, corner.y, corner.z}), 0.0);
    }
}

// Beyond the faces, the edges and the corners of a cube.
TEST(FeasibleRegion, OneFaceOfACubePressesANode) {
    Surfaces surfaces({make_box({glm::dvec3(2), glm::ivec3(2)}), kNode});
    const auto is_outside = [](const glm::dvec3& p) {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 1.0;
    };
    for (double x = -1.5; x < 1.75; x += 0.25)
        for (double y = -1.5; y < 1.75; y += 0.25)
            for (double z = -1.5; z < 1.75; z += 0.25)
                if (is_outside({x, y, z})) expect_one_face_presses(surfaces, {x, y, z});
    test::RandomMaker random(2);
    for (int k = 0; k < 300; ++k) {
        const glm::dvec3 point = random.point(1.5);
        if (is_outside(point)) expect_one_face_presses(surfaces, point);
    }
}

// An edge along x between two faces, and one at right angles to it in a direction from it, whose face is
// behind it as seen from there.
// @param inwards of the first edge's faces, unit @return the weight, whichever edge comes first
double weight_between(const std::vector<glm::dvec3>& inwards, const glm::dvec3& direction) {
    SurfaceMesh roof{{{-1, 0, 0}, {1, 0, 0}}, {}};
    for (const glm::dvec3& in : inwards) {
        const auto corner = static_cast<unsigned>(roof.positions.size());
        roof.positions.push_back(glm::dvec3(0.3, 0, 0) + in);
        roof.faces.push_back(corner == 2 ? glm::uvec3(0, 1, corner) : glm::uvec3(1, 0, corner));
    }
    const glm::dvec3 middle = 0.2 * direction, along = glm::cross(direction, glm::dvec3(1, 0, 0));
    const SurfaceMesh other{{middle - along, middle + along, middle + direction}, {{0, 1, 2}}};
    const Surfaces surfaces({roof, other});
    const std::uint32_t second = surfaces.first_node(1);
    const glm::uvec2 one(0, 1), two(second, second + 1);
    const double weight = surfaces.of_edges(one, two).weight;
    EXPECT_NEAR(surfaces.of_edges(two, one).weight, weight, 1e-12);
    return weight;
}

// 1/2 - 10 cos of the angle to each face's inside, the least of them (docs/contact.md).
TEST(FeasibleRegion, RidgesPressAndValleysDoNot) {
    for (double slope = -0.3; slope < 0.31; slope += 0.02) {  // [rad]; positive: a ridge
        const glm::dvec3 left(0, -std::cos(slope), -std::sin(slope)), right(0, std::cos(slope), left.z);
        EXPECT_NEAR(weight_between({left, right}, {0, 0, 1}),
                    std::clamp(0.5 + 12.5 * std::sin(slope), 0.0, 1.0), 1e-6)
            << slope;
    }
}

TEST(FeasibleRegion, CubeEdgesPressBetweenTheirFacesNormals) {
    for (double angle = -0.2; angle < glm::radians(90.0) + 0.2; angle += 0.02) {
        const glm::dvec3 direction(0, std::cos(angle), std::sin(angle));
        const double least = std::min(direction.y, direction.z);  // minus the greater cosine
        EXPECT_NEAR(weight_between({{0, -1, 0}, {0, 0, -1}}, direction),
                    std::clamp(0.5 + 12.5 * least, 0.0, 1.0), 1e-6)
            << angle;
    }
}

TEST(FeasibleRegion, BordersPressAwayFromTheirFace) {
    for (double angle = -3.1; angle < 3.1; angle += 0.1) {
        const glm::dvec3 direction(0, std::cos(angle), std::sin(angle));
        EXPECT_NEAR(weight_between({{0, -1, 0}}, direction), std::clamp(0.5 + 12.5 * direction.y, 0.0, 1.0),
                    1e-6)
            << angle;
    }
}

// There nodes and faces press.
TEST(FeasibleRegion, EdgesDoNotPressAtTheirEnds) {
    const SurfaceMesh ridge{{{-1, 0, 0}, {1, 0, 0}, {0, -1, -1}, {0, 1, -1}}, {{0, 1, 2}, {1, 0, 3}}};
    for (double x = -2.125; x < 2.2; x += 0.25) {
        const SurfaceMesh other{{{x, -1, 0.1}, {x, 1, 0.1}, {x, 0, 1}}, {{0, 1, 2}}};
        const Surfaces surfaces({ridge, other});
        const std::uint32_t second = surfaces.first_node(1);
        EXPECT_EQ(surfaces.of_edges({0, 1}, {second, second + 1}).weight, std::abs(x) < 1.0 ? 1.0 : 0.0) << x;
    }
}

}  // namespace
}  // namespace gelatin
