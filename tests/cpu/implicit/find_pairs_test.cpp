#include "cpu/implicit/find_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "cpu/contact/nearest_pairs.h"
#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using Key = std::tuple<bool, std::uint32_t, std::uint32_t>;

Key key_of(const cpu::ContactPair& pair) {
    return {pair.is_edges(), pair.first, pair.second};
}

// Two blocks beside each other that fly together, and a third in their way.
class FindPairsTest : public testing::Test {
protected:
    FindPairsTest()
        : model_(
              test::make_blocks({{.cells = {2, 2, 2}, .size = glm::dvec3(0.1)},
                                 {.place = {0.104, 0.01, 0.02}, .cells = {2, 2, 2}, .size = glm::dvec3(0.1)},
                                 {.place = {0.05, 0.12, 0}, .cells = {2, 2, 2}, .size = glm::dvec3(0.1)}})),
          surface_(std::make_shared<ContactSurface>(make_contact_surface(*model_, {}))),
          from_(model_->positions.begin(), model_->positions.end()),
          to_(from_) {
        for (std::size_t n = 0; n < to_.size(); ++n)
            to_[n] +=
                glm::dvec4(n < model_->objects[2].nodes.first ? glm::dvec3(0, 0.05, 0) : glm::dvec3(0), 0.0);
    }

    // Of all pairs of different bodies, those that come nearer than a part of their reach at some of 21
    // times.
    std::set<Key> near_on_the_way(const std::vector<glm::dvec4>& ends, double part = 1.0) const {
        cpu::FindPairs<double> all(model_, surface_, false);
        const cpu::Paths<double> paths{from_, ends, 1.0, 1e3};
        all.begin(paths);
        all.run(paths);
        std::set<Key> near;
        constexpr int kPlaces = 20;
        for (int k = 0; k <= kPlaces; ++k) {
            std::vector<glm::dvec4> there = from_;
            for (std::size_t n = 0; n < there.size(); ++n)
                there[n] += k / double(kPlaces) * (ends[n] - from_[n]);
            for (const cpu::NearPair<double>& pair : all.pairs()) {
                cpu::MeasuredPairs<double> measured;
                cpu::measure_pairs({&pair.pair, 1}, there, measured);
                if (measured.gaps[0] < part * static_cast<double>(pair.pair.reach))
                    near.insert(key_of(pair.pair));
            }
        }
        return near;
    }
    static std::set<Key> listed(const cpu::FindPairs<double>& found) {
        std::set<Key> keys;
        for (const cpu::NearPair<double>& near : found.pairs()) {
            EXPECT_TRUE(keys.insert(key_of(near.pair)).second) << "twice";
        }
        return keys;
    }
    static bool includes(const std::set<Key>& all, const std::set<Key>& some) {
        return std::includes(all.begin(), all.end(), some.begin(), some.end());
    }

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<glm::dvec4> from_, to_;
};

TEST_F(FindPairsTest, ListsAllThatComeNear) {
    cpu::FindPairs<double> pairs(model_, surface_, false);
    const cpu::Paths<double> paths{from_, to_};
    pairs.begin(paths);
    pairs.run(paths);
    const std::set<Key> near = near_on_the_way(to_);
    EXPECT_GT(near.size(), 20u);
    EXPECT_TRUE(includes(listed(pairs), near));
}

TEST_F(FindPairsTest, ListsAsNearAsIsAskedFor) {
    const auto list = [&](double nearness) {
        cpu::FindPairs<double> pairs(model_, surface_, false);
        pairs.begin({from_, to_, nearness, 0.0});
        pairs.run({from_, to_, nearness, 0.0});
        return listed(pairs);
    };
    const std::set<Key> few = list(0.02), all = list(1.0);
    EXPECT_LT(few.size(), all.size());
    EXPECT_TRUE(includes(all, few));
    EXPECT_TRUE(includes(few, near_on_the_way(to_, 0.02)));
}

// As many nodes end elsewhere as a test asks for, up to 3 cm from where they were expected.
TEST_F(FindPairsTest, ListsPairsOfNodesAnewThatEndElsewhere) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> offset(-0.03, 0.03);
    cpu::FindPairs<double> pairs(model_, surface_, false);
    bool any_new = false;
    for (int round = 0; round < 10; ++round) {
        std::vector<glm::dvec4> ends = to_;
        const cpu::Paths<double> paths{from_, ends};
        pairs.begin(paths);
        pairs.run(paths);
        const std::set<Key> before = listed(pairs);
        std::vector<std::uint32_t> strays;
        for (std::uint32_t n = static_cast<std::uint32_t>(round) % 7; n < ends.size(); n += 7) {
            ends[n] += glm::dvec4(offset(random), offset(random), offset(random), 0.0);
            strays.push_back(n);
        }
        pairs.update(paths, strays);
        const std::set<Key> near = near_on_the_way(ends);
        any_new = any_new || !includes(before, near);
        EXPECT_TRUE(includes(listed(pairs), near)) << "round " << round;
    }
    EXPECT_TRUE(any_new);
}

// A block that flies below a collider's edge, 3 mm from it, has that above its way, and ahead of it without
// one.
TEST_F(FindPairsTest, LooksBesideTheWayOfWhatPasses) {
    const glm::dvec3 way(0.05, 0, 0);
    ColliderDescription wall;
    wall.shape = BoxShape{glm::dvec3(0.1)};
    wall.position = {0.17, 0.153, 0.05};
    model_ = test::make_blocks({{.cells = {1, 1, 1}, .size = glm::dvec3(0.1)}}, {0, 0, 0}, {wall});
    surface_ = std::make_shared<ContactSurface>(make_contact_surface(*model_, {}));
    from_.assign(model_->positions.begin(), model_->positions.end());
    to_ = from_;
    std::vector<glm::dvec4> velocities(from_.size(), glm::dvec4(0.0));
    for (std::uint32_t n = 0; n < model_->objects[0].nodes.count; ++n) {
        to_[n] += glm::dvec4(way, 0.0);
        velocities[n] = glm::dvec4(way / 0.01, 0.0);
    }
    const auto least_upwards = [&](const cpu::Paths<double>& paths) {  // of normals
        cpu::FindPairs<double> found(model_, surface_, false);
        found.begin(paths);
        found.run(paths);
        EXPECT_GT(found.pairs().size(), 4u);
        double least = 1.0;
        for (const cpu::NearPair<double>& near : found.pairs()) {
            const double towards = near.pair.object == 0 ? 1.0 : -1.0;
            least = std::min(least, towards * near.normal.y);
            EXPECT_GT(near.gap, 0.0);
            EXPECT_NEAR(cpu::separation<double>(near.pair, near.normal, from_), near.gap, 1e-12);
        }
        return least;
    };
    EXPECT_LT(least_upwards({.from = from_, .to = to_}), 0.2);
    EXPECT_NEAR(least_upwards({.from = from_, .to = to_, .velocities = velocities, .step = 0.01}), 1.0, 0.01);
    EXPECT_LT(least_upwards({.from = from_, .to = to_, .velocities = velocities, .step = 1e-4}), 0.2);
}

// In reaches: of two that fly together past the third, beside it; with self-contact, what nodes of one go
// beside each other.
TEST_F(FindPairsTest, KnowsHowFarBodiesGoBesideEachOther) {
    const auto fastest = [&](bool own) {
        cpu::FindPairs<double> found(model_, surface_, own);
        const cpu::Paths<double> paths{from_, to_};
        found.begin(paths);
        return found.fastest_approach(paths);
    };
    EXPECT_NEAR(fastest(false), 0.05 / surface_->reach(0, 2), 1e-9);
    EXPECT_NEAR(fastest(true), 0.05 / surface_->reach(0, 2), 1e-9);
    const std::uint32_t last = model_->objects[2].nodes.end() - 1;
    to_[last].x += 2.0;
    EXPECT_LT(fastest(false), 0.2 / surface_->reach(0, 2));
    EXPECT_GT(fastest(true), 1.9 / surface_->reach(2, 2));
}

}  // namespace
}  // namespace gelatin
