#include "model/collision/rest_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "support/test_models.h"

namespace gelatin {
namespace {

// Points of a face.
std::vector<glm::dvec3> sample(const Model& model, const Face& face) {
    constexpr int kSteps = 8;
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; i + j <= kSteps; ++j) {
            const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
            points.push_back((1.0 - u - v) * glm::dvec3(model.positions[face.a]) +
                             u * glm::dvec3(model.positions[face.b]) +
                             v * glm::dvec3(model.positions[face.c]));
        }
    }
    return points;
}

bool neighbours(const Face& f, const Face& g) {
    for (const std::uint32_t p : {f.a, f.b, f.c})
        for (const std::uint32_t q : {g.a, g.b, g.c})
            if (p == q) return true;
    return false;
}

// Nothing is nearer than the clearance says, and it says no less than a good part of what is true.
TEST(RestShape, ClearanceIsALowerBoundOfTheDistance) {
    const Model model = test::make_model(test::make_body(test::make_block({4, 3, 1}, {4, 3, 0.7}, 0.25)));
    const RestShapes shapes = make_rest_shapes(model);
    ASSERT_EQ(shapes.clearances.size(), model.faces.size());
    double ratio_sum = 0.0;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        double nearest = std::max(
            {glm::distance(glm::dvec3(model.positions[face.a]), glm::dvec3(model.positions[face.b])),
             glm::distance(glm::dvec3(model.positions[face.b]), glm::dvec3(model.positions[face.c])),
             glm::distance(glm::dvec3(model.positions[face.c]), glm::dvec3(model.positions[face.a]))});
        const std::vector<glm::dvec3> points = sample(model, face);
        for (const Face& other : model.faces) {
            if (neighbours(face, other)) continue;
            for (const glm::dvec3& q : sample(model, other))
                for (const glm::dvec3& p : points) nearest = std::min(nearest, glm::distance(p, q));
        }
        EXPECT_LE(static_cast<double>(shapes.clearances[f]), nearest);
        ratio_sum += static_cast<double>(shapes.clearances[f]) / nearest;
    }
    EXPECT_GT(ratio_sum / static_cast<double>(model.faces.size()), 0.85);
}

// The matrix inverts the moment of the offsets, and offsets are from the middle.
TEST(RestShape, HoldsOffsetsAndTheirMoment) {
    const Model model = pack_bodies({test::make_body(test::make_block({2, 3, 4}, {1, 2, 3}, 0.2)),
                                     test::make_body(test::make_block({3, 1, 1}, {1, 1, 1}, 0.2))},
                                    {}, glm::dvec3(0.0));
    const RestShapes shapes = make_rest_shapes(model);
    ASSERT_EQ(shapes.objects.size(), 2u);
    ASSERT_EQ(shapes.offsets.size(), model.positions.size());
    for (std::size_t o = 0; o < 2; ++o) {
        const Range& nodes = model.objects[o].nodes;
        glm::dmat3 moment(0.0);
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 offset(shapes.offsets[n]);
            moment += glm::outerProduct(offset, offset);
            sum += offset;
            EXPECT_LT(
                glm::distance(offset - glm::dvec3(shapes.offsets[nodes.first]),
                              glm::dvec3(model.positions[n]) - glm::dvec3(model.positions[nodes.first])),
                1e-6);
        }
        EXPECT_LT(glm::length(sum), 1e-5);
        const RestShape& rest = shapes.objects[o];
        const glm::dmat3 product =
            moment * glm::dmat3(glm::dvec3(rest.inverse_moment_x), glm::dvec3(rest.inverse_moment_y),
                                glm::dvec3(rest.inverse_moment_z));
        for (int k = 0; k < 3; ++k) EXPECT_LT(glm::distance(product[k], glm::dmat3(1.0)[k]), 1e-5);
    }
}

}  // namespace
}  // namespace gelatin
