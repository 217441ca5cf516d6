#include "cpu/contact/own_gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/overlaps.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using Move = std::function<glm::dvec3(const glm::dvec3&)>;

// A body in two pieces, one on each side of a gap in a bar along x.
struct Bar {
    std::shared_ptr<const Model> model = std::make_shared<const Model>(test::make_model(
        test::make_body(test::without(test::make_block({12, 2, 3}, {1.2, 0.2, 0.3}),
                                      [](const glm::dvec3& p) { return p.x > 0.5 && p.x < 0.7; }))));
    std::shared_ptr<const ContactSurface> surface =
        std::make_shared<const ContactSurface>(make_contact_surface(*model, {.friction = 0.4}));
    double reach = surface->reach(0, 0);
    cpu::OwnGaps<double> gaps{model, surface};

    std::vector<glm::dvec4> moved(const Move& move) const {
        std::vector<glm::dvec4> moved;
        for (const glm::vec4& p : model->positions)
            moved.emplace_back(move(glm::dvec3(glm::vec3(p))), static_cast<double>(p.w));
        return moved;
    }
    bool stay_open(const Move& from, const Move& to) { return gaps.stay_open(0, moved(from), moved(to)); }
};

const Move kAtRest = [](const glm::dvec3& p) { return p; };

// The right piece lies over the left one, or under it, at some height.
Move folded(double height) {
    return [=](const glm::dvec3& p) { return p.x > 0.61 ? glm::dvec3(1.25 - p.x, p.y + height, p.z) : p; };
}

TEST(OwnGaps, StayOpenWhereABodyMovesRigidly) {
    Bar bar;
    test::RandomMaker random(3);
    for (int round = 0; round < 20; ++round) {
        const glm::dquat turn = glm::normalize(glm::dquat(1.0, random.point(1.0)));
        const glm::dvec3 way = random.point(30.0);
        EXPECT_TRUE(bar.stay_open(kAtRest, [&](const glm::dvec3& p) { return turn * p + way; }));
    }
}

TEST(OwnGaps, StayOpenWhileItBends) {
    Bar bar;
    const auto bent = [](double curvature) {
        return [=](const glm::dvec3& p) {
            const double radius = 1.0 / curvature - p.y;
            return glm::dvec3(radius * std::sin(curvature * p.x),
                              1.0 / curvature - radius * std::cos(curvature * p.x), p.z);
        };
    };
    for (const double curvature : {0.5, 1.0, 2.0})
        EXPECT_TRUE(bar.stay_open(bent(curvature), bent(curvature + 0.1))) << curvature;
}

TEST(OwnGaps, AreClosedWherePartsPress) {
    Bar bar;
    const double touching = 0.2;  // where their surfaces meet
    EXPECT_TRUE(bar.stay_open(folded(touching + 3.0 * bar.reach), folded(touching + 1.2 * bar.reach)));
    EXPECT_FALSE(bar.stay_open(folded(touching + 3.0 * bar.reach), folded(touching + 0.9 * bar.reach)));
    EXPECT_FALSE(bar.stay_open(folded(touching + 0.9 * bar.reach), folded(touching + 3.0 * bar.reach)));
}

// Nothing overlaps before the step, or after it.
TEST(OwnGaps, AreClosedWhereOnePartPassesThroughAnother) {
    Bar bar;
    for (const double height : {0.3, 0.5}) {
        for (const Move& move : {folded(height), folded(-height)})
            EXPECT_EQ(test::count_overlaps(*bar.model, bar.moved(move), test::Overlaps::all), 0u);
        EXPECT_TRUE(bar.stay_open(folded(height), folded(height + 0.1)));
        EXPECT_FALSE(bar.stay_open(folded(height), folded(-height)));
    }
}

// A look that ends where it finds parts that press tells nothing of others.
TEST(OwnGaps, HoldNoMoreAfterALookThatEnded) {
    Bar bar;
    const auto at_rest = bar.moved(kAtRest), apart = bar.moved(folded(0.5));
    EXPECT_TRUE(bar.gaps.hold(0, at_rest));
    EXPECT_TRUE(bar.gaps.stay_open(0, apart, apart));
    EXPECT_TRUE(bar.gaps.hold(0, apart));
    EXPECT_FALSE(bar.gaps.stay_open(0, apart, bar.moved(folded(-0.5))));
    EXPECT_FALSE(bar.gaps.hold(0, apart));
    EXPECT_FALSE(bar.gaps.hold(0, at_rest));
}

// The gap of the bar is between its pieces at the start; what is beside it, and one end, are not.
TEST(OwnGaps, AreLookedAtWhereSomethingIsBetween) {
    Bar bar;
    const auto above = bar.moved(folded(0.5)), below = bar.moved(folded(-0.5));
    using Boxes = std::vector<cpu::AxisBox<double>>;
    const Boxes gap = {{{0.55, -1.0, -1.0}, {0.65, 1.0, 1.0}}}, beside = {{{0.0, 0.5, 0.0}, {1.2, 1.0, 0.3}}},
                none;
    EXPECT_FALSE(bar.gaps.stay_open(0, above, below, gap));
    EXPECT_TRUE(bar.gaps.stay_open(0, above, below, beside));
    EXPECT_TRUE(bar.gaps.stay_open(0, above, below, none));
    EXPECT_FALSE(bar.gaps.stay_open(0, above, below));
    EXPECT_TRUE(bar.gaps.stay_open(0, above, above, gap));
    EXPECT_FALSE(bar.gaps.hold(0, above));  // others were not looked at
    EXPECT_TRUE(bar.gaps.stay_open(0, above, above));
    EXPECT_TRUE(bar.gaps.hold(0, above));
}

TEST(OwnGaps, TellWhetherABodyPassesThroughItself) {
    Bar bar;
    for (const double height : {-0.5, -0.22, -0.15, 0.1, 0.19, 0.21, 0.5}) {
        const std::vector<glm::dvec4> positions = bar.moved(folded(height));
        EXPECT_EQ(bar.gaps.passes_through_itself(0, positions),
                  test::count_overlaps(*bar.model, positions, test::Overlaps::all) > 0)
            << height;
        EXPECT_EQ(bar.gaps.passes_through_itself(0, positions), std::abs(height) < 0.2) << height;
    }
}

// Parts of a mesh that are that near at rest do not press before half of their distance is left.
TEST(OwnGaps, OfWhatIsNarrowAtRestCloseLater) {
    Bar bar;
    const Move thin = [](const glm::dvec3& p) { return glm::dvec3(p.x, 0.8 * p.y, p.z); };
    const Move thinner = [](const glm::dvec3& p) { return glm::dvec3(p.x, 0.4 * p.y, p.z); };
    auto wide = std::make_shared<ContactSurface>(*bar.surface);
    wide->thicknesses[0] = 0.2;  // all of the bar is within its reach
    cpu::OwnGaps<double> gaps(bar.model, wide);
    EXPECT_TRUE(gaps.stay_open(0, bar.moved(kAtRest), bar.moved(thin)));
    EXPECT_FALSE(gaps.stay_open(0, bar.moved(kAtRest), bar.moved(thinner)));
}

}  // namespace
}  // namespace gelatin
