#include "cpu/contact/kept_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "support/contact_scenes.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

std::shared_ptr<const ContactSurface> surface_of(const Model& model) {
    return std::make_shared<const ContactSurface>(make_contact_surface(model, {.friction = 0.4}));
}

TEST(ConvexBodies, AreFound) {
    TetMesh block = test::make_block({4, 4, 4}, {0.4, 0.4, 0.4});
    const auto is_convex = [](const Model& model) { return surface_of(model)->is_convex[0] != 0; };
    EXPECT_TRUE(is_convex(test::make_model(test::make_body(block))));
    const auto parts_from = [&](const std::function<bool(const glm::dvec3&)>& leaves_out) {
        return is_convex(test::make_model(test::make_body(test::without(block, leaves_out))));
    };
    EXPECT_TRUE(parts_from([](const glm::dvec3& p) { return p.x > 0.2; }));
    EXPECT_FALSE(parts_from([](const glm::dvec3& p) { return p.x > 0.2 && p.y > 0.2; }));     // a notch
    EXPECT_FALSE(parts_from([](const glm::dvec3& p) { return std::abs(p.x - 0.2) < 0.1; }));  // two bodies
    EXPECT_FALSE(parts_from([](const glm::dvec3& p) {                                         // a hole
        const glm::dvec3 from_middle = glm::abs(p - 0.2);
        return std::max({from_middle.x, from_middle.y, from_middle.z}) < 0.1;
    }));
    for (glm::dvec3& p : block.positions)
        if (p == glm::dvec3(0.2, 0.2, 0.4)) p.z -= 0.01;  // a dent
    EXPECT_FALSE(is_convex(test::make_model(test::make_body(block))));
}

template <class Real>
bool keeps(cpu::KeptDistances<Real>& kept, Real part, std::span<const cpu::Vec4<Real>> positions) {
    return kept.find_lost_tets(0, part, positions, positions).empty();
}

struct ConvexBody {
    std::shared_ptr<const Model> model = std::make_shared<const Model>(
        test::make_model(test::make_body(test::make_block({4, 3, 3}, {0.8, 0.6, 0.5}))));
    cpu::KeptDistances<double> kept{model, *surface_of(*model)};
    cpu::KeptDistances<float> fast{model, *surface_of(*model)};

    std::vector<glm::dvec4> moved(const auto& move) const {
        std::vector<glm::dvec4> moved;
        for (const glm::vec4& p : model->positions)
            moved.emplace_back(move(glm::dvec3(glm::vec3(p))), static_cast<double>(p.w));
        return moved;
    }
    // Of all pairs of nodes, the least part of their distance that is left.
    double least_part(const std::vector<glm::dvec4>& positions) const {
        double least = 1e9;
        for (std::size_t a = 0; a < positions.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                least = std::min(least, glm::distance(glm::dvec3(positions[a]), glm::dvec3(positions[b])) /
                                            glm::distance(glm::dvec3(model->positions[a]),
                                                          glm::dvec3(model->positions[b])));
        return least;
    }
};

TEST(KeptDistances, AreNeverLessThanToldOfRandomShapes) {
    ConvexBody body;
    test::RandomMaker random(7);
    int kept = 0, lost = 0;
    for (int round = 0; round < 300; ++round) {
        glm::dmat3 linear(1.0);
        for (int k = 0; k < 3; ++k) linear[k] += random.point(0.7);
        const double uneven = random.uniform(0.0, 0.08);
        const glm::dquat turn = glm::normalize(glm::dquat(random.uniform(-1.0, 1.0), random.point(1.0)));
        const auto positions = body.moved([&](const glm::dvec3& p) {
            return turn * (linear * p + 0.3 * glm::dvec3(p.y * p.y, p.z * p.x, 0.0) + random.point(uneven));
        });
        const double part = random.uniform(0.05, 0.9);
        const bool is_kept = keeps<double>(body.kept, part, positions);
        ++(is_kept ? kept : lost);
        if (is_kept) {
            EXPECT_GE(body.least_part(positions), 0.999 * part) << round;
        }
        // The same in single precision, but for what rounding may decide.
        const std::vector<glm::vec4> rounded(positions.begin(), positions.end());
        const auto single = static_cast<float>(part);
        if (is_kept) {
            EXPECT_TRUE(keeps<float>(body.fast, single - 1e-3f, rounded)) << round;
        }
        if (!is_kept && !keeps<double>(body.kept, part - 1e-3, positions)) {
            EXPECT_FALSE(keeps<float>(body.fast, single, rounded)) << round;
        }
    }
    EXPECT_GT(kept, 30);
    EXPECT_GT(lost, 30);
}

TEST(KeptDistances, AreAllThereInRigidMotions) {
    ConvexBody body;
    test::RandomMaker random(2);
    for (int round = 0; round < 20; ++round) {
        const glm::dquat turn = glm::normalize(glm::dquat(random.uniform(-1.0, 1.0), random.point(1.0)));
        const glm::dvec3 way = random.point(10.0);
        EXPECT_TRUE(
            keeps<double>(body.kept, 0.999, body.moved([&](const glm::dvec3& p) { return turn * p + way; })));
        EXPECT_FALSE(keeps<double>(body.kept, 0.9,
                                   body.moved([&](const glm::dvec3& p) { return turn * (0.8 * p) + way; })));
    }
}

TEST(KeptDistances, AreLostWhereATetIsInsideOut) {
    ConvexBody body;
    std::vector<glm::dvec4> positions = body.moved([](const glm::dvec3& p) { return p; });
    const glm::uvec4& tet = body.model->tets[5];
    const glm::dvec3 a(positions[tet.x]);
    const glm::dvec3 beyond =
        (glm::dvec3(positions[tet.y]) + glm::dvec3(positions[tet.z]) + glm::dvec3(positions[tet.w])) / 1.5 -
        a;
    positions[tet.x] = glm::dvec4(beyond, positions[tet.x].w);
    EXPECT_FALSE(keeps<double>(body.kept, 0.01, positions));
}

// Whether a straight line passes through a box.
bool meets(const cpu::AxisBox<double>& box, const glm::dvec3& a, const glm::dvec3& b) {
    double first = 0.0, last = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double way = b[k] - a[k];
        if (way == 0.0 && (a[k] < box.min[k] || a[k] > box.max[k])) return false;
        if (way == 0.0) continue;
        const double to_min = (box.min[k] - a[k]) / way, to_max = (box.max[k] - a[k]) / way;
        first = std::max(first, std::min(to_min, to_max));
        last = std::min(last, std::max(to_min, to_max));
    }
    return first <= last;
}

// One node after another is drawn somewhere else, up to where tets are inside out. Looked at are points in
// the tets beside it, and in these or others.
TEST(KeptDistances, AreLostAtMostBetweenWhatIsTold) {
    ConvexBody body;
    const std::vector<glm::dvec4> at_start = body.moved([](const glm::dvec3& p) { return p; });
    test::RandomMaker random(11);
    const auto any_of = [&](const std::vector<glm::uvec4>& tets) {
        return tets[static_cast<std::size_t>(random.integer(0, static_cast<int>(tets.size()) - 1))];
    };
    constexpr double kPart = 0.3;
    int kept = 0, between = 0;
    for (int round = 0; round < 60; ++round) {
        std::vector<glm::dvec4> positions = at_start;
        const auto drawn =
            static_cast<std::uint32_t>(random.integer(0, static_cast<int>(at_start.size()) - 1));
        positions[drawn] += glm::dvec4(random.point(0.4), 0.0);
        std::vector<glm::uvec4> beside;
        for (const glm::uvec4& tet : body.model->tets)
            if (glm::any(glm::equal(tet, glm::uvec4(drawn)))) beside.push_back(tet);
        std::vector<cpu::AxisBox<double>> lost;
        for (const cpu::LostTets& tets : body.kept.find_lost_tets(0, kPart, positions, positions))
            lost.push_back(body.kept.box_of(0, tets));
        struct Point {
            glm::dvec3 at_start{0.0}, now{0.0};
        };
        const auto point_in = [&](const glm::uvec4& tet) {
            glm::dvec4 weights = 0.5 + glm::dvec4(random.point(0.5), random.uniform(-0.5, 0.5));
            weights /= weights.x + weights.y + weights.z + weights.w;
            Point point;
            for (int k = 0; k < 4; ++k) {
                point.at_start += weights[k] * glm::dvec3(at_start[tet[k]]);
                point.now += weights[k] * glm::dvec3(positions[tet[k]]);
            }
            return point;
        };
        for (int k = 0; k < 2000; ++k) {
            const Point a = point_in(any_of(beside)), b = point_in(any_of(k % 2 ? beside : body.model->tets));
            if (std::any_of(lost.begin(), lost.end(),
                            [&](const auto& box) { return meets(box, a.at_start, b.at_start); })) {
                ++between;
                continue;
            }
            ++kept;
            EXPECT_GE(glm::distance(a.now, b.now), 0.999 * kPart * glm::distance(a.at_start, b.at_start))
                << round;
        }
    }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(between, 1000);
}

TEST(KeptDistances, TellOfNoMoreThanATenthOfABodyWhereOneTetIsLost) {
    const auto model = std::make_shared<const Model>(
        test::make_model(test::make_body(test::make_block({10, 10, 10}, {1.0, 1.0, 1.0}))));
    cpu::KeptDistances<float> kept(model, *surface_of(*model));
    std::vector<glm::vec4> positions = model->positions;
    const glm::uvec4& tet = model->tets[model->tets.size() / 2];
    positions[tet.x] += 1.5f * (positions[tet.y] - positions[tet.x]);
    const auto lost = kept.find_lost_tets(0, 0.01f, positions, positions);
    ASSERT_FALSE(lost.empty());
    EXPECT_LT(8 * lost.size(), model->tets.size() / 10);
    EXPECT_TRUE(keeps<float>(kept, 0.01f, model->positions));
}

}  // namespace
}  // namespace gelatin
