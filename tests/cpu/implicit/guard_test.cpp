#include "cpu/implicit/guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "support/contact_scenes.h"
#include "support/overlaps.h"

namespace gelatin {
namespace {

// Two blocks of one cell, 0.1 m of size, side by side along x with a gap of 2 mm.
class GuardTest : public testing::Test {
protected:
    void SetUp() override {
        model_ = test::make_blocks({{.cells = {1, 1, 1}, .size = glm::dvec3(0.1)},
                                    {.place = {0.102, 0, 0}, .cells = {1, 1, 1}, .size = glm::dvec3(0.1)}});
        surface_ = std::make_shared<ContactSurface>(make_contact_surface(*model_, {}));
        from_.assign(model_->positions.begin(), model_->positions.end());
        compliances_.assign(from_.size(), 1.0);
    }
    // Where nodes go that are to go by these motions of the two blocks [m].
    std::vector<glm::dvec4> guarded(const glm::dvec3& first, const glm::dvec3& second) {
        std::vector<glm::dvec4> ends = from_;
        for (std::size_t n = 0; n < ends.size(); ++n)
            ends[n] += glm::dvec4(n < model_->objects[0].nodes.count ? first : second, 0.0);
        cpu::FindPairs<double> pairs(model_, surface_, false);
        for (int k = 0; k < 10; ++k) {  // nodes that are put beside their paths may meet others there
            const std::vector<glm::dvec4> wanted = ends;
            const cpu::Paths<double> paths{from_, wanted};
            pairs.begin(paths);
            pairs.run(paths);
            std::vector<std::uint8_t> is_blocked;
            if (guard_().run(paths, pairs.pairs(), compliances_, ends, is_blocked).empty()) return ends;
        }
        ADD_FAILURE() << "nodes leave their paths";
        return ends;
    }
    cpu::Guard<double>& guard_() {
        if (!made_) made_ = std::make_unique<cpu::Guard<double>>(model_, surface_);
        return *made_;
    }

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<glm::dvec4> from_;
    std::vector<double> compliances_;
    std::unique_ptr<cpu::Guard<double>> made_;
};

TEST_F(GuardTest, StopsWhatWouldPassThrough) {
    for (const double distance : {0.003, 0.05, 0.4}) {
        const std::vector<glm::dvec4> ends = guarded({distance, 0, 0}, {0, 0, 0});
        EXPECT_EQ(test::count_overlaps(*model_, ends), 0u);
        EXPECT_GT(guard_().clipped_pairs(), 0u);
    }
}

TEST_F(GuardTest, LeavesAloneWhatDoesNotMeet) {
    for (const glm::dvec3& motion :
         {glm::dvec3(0.0015, 0, 0), glm::dvec3(-0.2, 0, 0), glm::dvec3(0, 0.03, 0.02)}) {
        const std::vector<glm::dvec4> ends = guarded(motion, {0, 0, 0});
        for (std::size_t n = 0; n < model_->objects[0].nodes.count; ++n)
            EXPECT_EQ(glm::dvec3(ends[n]), glm::dvec3(from_[n]) + motion);
    }
    EXPECT_EQ(guard_().clipped_pairs(), 0u);
}

// Side by side, however far: what both have in common is no approach.
TEST_F(GuardTest, LetsIslandsGoOnTogether) {
    const std::vector<glm::dvec4> ends = guarded({0.5, 0.1, 0}, {0.5, 0.1, 0});
    for (std::size_t n = 0; n < ends.size(); ++n)
        EXPECT_EQ(glm::dvec3(ends[n]), glm::dvec3(from_[n]) + glm::dvec3(0.5, 0.1, 0));
}

// What is held and goes on takes with it what lies on it, and is not in its own way.
TEST_F(GuardTest, GoesWithWhatIsHeld) {
    for (std::size_t n = 0; n < model_->objects[0].nodes.count; ++n) from_[n].w = compliances_[n] = 0.0;
    const std::vector<glm::dvec4> ends = guarded({0.5, 0.1, 0}, {0.4, 0.1, 0});
    EXPECT_GT(guard_().clipped_pairs(), 0u);
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const glm::dvec3 d = glm::dvec3(ends[n] - from_[n]) - glm::dvec3(0.5, 0.1, 0);
        EXPECT_TRUE(from_[n].w > 0.0 || d == glm::dvec3(0));
        EXPECT_TRUE(from_[n].x > 0.15 || std::abs(d.x) < 0.002) << d.x;  // within the gap
    }
}

// The side that yields less goes farther.
TEST_F(GuardTest, DividesGapsByCompliance) {
    for (std::size_t n = 0; n < model_->objects[0].nodes.count; ++n) compliances_[n] = 9.0;
    const std::vector<glm::dvec4> ends = guarded({0.05, 0, 0}, {-0.05, 0, 0});
    double first = 0.0, second = 0.0;
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const double gone = ends[n].x - from_[n].x;
        (n < model_->objects[0].nodes.count ? first : second) += gone;
    }
    EXPECT_EQ(test::count_overlaps(*model_, ends), 0u);
    EXPECT_GT(first, 0.0);
    EXPECT_LT(second, 0.0);
}

// Pairs are left out that keep apart because both sides go on: so a node that stops on its way is not where
// it was expected, though it never left its straight path.
TEST_F(GuardTest, TellsWhichNodesEndElsewhere) {
    std::vector<glm::dvec4> expected = from_, ends = from_;
    for (std::size_t n = 0; n < ends.size(); ++n) expected[n].x += 0.05;
    for (std::size_t n = 0; n < ends.size(); ++n) ends[n].x += n == 3 ? 0.02 : n == 4 ? 0.0495 : 0.05;
    const cpu::Paths<double> paths{from_, expected};
    std::vector<std::uint8_t> is_blocked;
    EXPECT_EQ(guard_().run(paths, {}, compliances_, ends, is_blocked), std::vector<std::uint32_t>{3});
}

}  // namespace
}  // namespace gelatin
