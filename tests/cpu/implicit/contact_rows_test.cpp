#include "cpu/implicit/contact_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "cpu/implicit/attachment_rows.h"
#include "support/contact_scenes.h"

namespace gelatin {
namespace {

// A block above a plane: of the nodes at its bottom those on one side are 0.1 mm above it, and the others as
// high as a test has them.
class ContactRowsTest : public testing::Test {
protected:
    ContactRowsTest() {
        ColliderDescription ground;
        ground.shape = PlaneCollider{{0, 1, 0}, 0.0};
        model_ = test::make_blocks({{}}, {0, -9.81, 0}, {ground});
        rows_of_ = std::make_unique<cpu::ContactRows<double>>(
            model_, std::make_shared<ContactSurface>(make_contact_surface(*model_, {})));
        compliances_.assign(model_->node_count(), 1e-6);
        expected_.assign(model_->node_count(), glm::dvec3(0.0));
    }
    std::vector<cpu::ContactRow<double>> rows(double height) {
        std::vector<glm::dvec4> positions(model_->positions.begin(), model_->positions.end());
        for (glm::dvec4& p : positions) p.y = p.y > 0.05 ? 0.3 : p.x < 0.15 ? 0.0001 : height;
        std::vector<cpu::ContactRow<double>> rows;
        rows_of_->make({positions, expected_, compliances_, kStep, kStep}, {},
                       cpu::AttachmentRows<double>(model_), rows);
        rows_of_->note(rows, expected_, std::vector<std::uint8_t>(1));
        rows_of_->remember();
        return rows;
    }

    static constexpr double kStep = 1.0 / 240.0;
    std::shared_ptr<const Model> model_;
    std::unique_ptr<cpu::ContactRows<double>> rows_of_;
    std::vector<double> compliances_;
    std::vector<glm::dvec3> expected_;
};

double strongest(const std::vector<cpu::ContactRow<double>>& rows) {
    double most = 0.0;
    for (const auto& row : rows) most = std::max(most, row.force_of(row.gap));
    return most;
}

// With all of their reach at once new contacts would bring in energy.
TEST_F(ContactRowsTest, NewOnesPressNoMoreThanThoseThatAreKnown) {
    const std::vector<cpu::ContactRow<double>> first = rows(0.2);
    ASSERT_GT(first.size(), 3u);
    EXPECT_EQ(strongest(first), 0.0);
    const double before = strongest(rows(0.2));  // their reach grows
    EXPECT_GT(before, 0.0);
    const std::vector<cpu::ContactRow<double>> all = rows(0.0001);
    ASSERT_GT(all.size(), first.size());
    EXPECT_LT(strongest(all), 3.0 * before);
}

TEST_F(ContactRowsTest, LiftOutWhatLiesInAPlane) {
    const std::vector<cpu::ContactRow<double>> first = rows(-0.05);
    const double none = strongest(first);
    EXPECT_LT(none, 1e-9);
    double before = none;
    for (int k = 0; k < 10; ++k) {
        const double now = strongest(rows(-0.05));
        EXPECT_GT(now, before);  // the place moves up
        before = now;
    }
}

// Else what hardly counts in a face whose other corners are held would be pressed away with all that these
// press together.
TEST(ContactRows, HeldNodesMakeNoneStiffer) {
    const auto model = test::make_blocks({test::Block{}, test::Block{.place = {0.03, 0.305, 0.02}}});
    const auto surface = std::make_shared<ContactSurface>(make_contact_surface(*model, {}));
    const std::vector<glm::dvec4> positions(model->positions.begin(), model->positions.end());
    const std::vector<glm::dvec3> expected(positions.size(), glm::dvec3(0.0));
    cpu::FindPairs<double> pairs(model, surface, false);
    pairs.begin({positions, positions});
    pairs.run({positions, positions});
    const auto stiffest = [&](const std::vector<double>& compliances) {
        std::vector<cpu::ContactRow<double>> rows;
        cpu::ContactRows<double>(model, surface)
            .make({positions, expected, compliances, 1.0 / 240.0, 1.0 / 240.0}, pairs.pairs(),
                  cpu::AttachmentRows<double>(model), rows);
        double most = 0.0;
        for (const auto& row : rows) most = std::max(most, row.stiffness);
        return most;
    };
    std::vector<double> compliances(positions.size(), 1e-6);
    const double all_free = stiffest(compliances);
    std::size_t touching = 0;
    for (std::uint32_t free = model->objects[0].nodes.first; free < model->objects[0].nodes.end(); ++free) {
        std::fill(compliances.begin(), compliances.end(), 0.0);
        compliances[free] = 1e-6;
        const double most = stiffest(compliances);
        EXPECT_LE(most, 4.001e6) << free;
        if (most > 0.0) ++touching;
    }
    EXPECT_GT(all_free, 1e6);
    EXPECT_GT(touching, 3u);
}

// Near a tie the reach is at most half of the gap when it was made, and firm ones leave none; elsewhere, and
// when it is broken, all is as ever.
TEST(ContactRowsOfAttachmentsTest, BodiesPressNearTheirTiesFromHalfOfTheirGapOn) {
    constexpr double kGap = 0.004;
    const auto model = test::make_blocks({test::Block{}, test::Block{.place = {0.03, 0.3 + kGap, 0.02}}});
    const auto surface = std::make_shared<ContactSurface>(make_contact_surface(*model, {}));
    const double reach = surface->reach(0, 1);
    ASSERT_GT(reach, kGap);
    const std::vector<glm::dvec4> positions(model->positions.begin(), model->positions.end());
    std::vector<glm::dvec3> expected(positions.size(), glm::dvec3(0.0));
    const Range& nodes = model->objects[1].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) expected[n].y = -0.4 * kGap;
    const std::vector<double> compliances(positions.size(), 1e-6);
    cpu::FindPairs<double> pairs(model, surface, false);
    pairs.begin({positions, positions});
    pairs.run({positions, positions});
    Attachment attachment;
    attachment.object = 1;
    attachment.other = 0;
    attachment.positions = std::make_shared<const std::vector<glm::vec4>>(model->positions);
    const auto lowest = std::min_element(positions.begin() + nodes.first, positions.end(),
                                         [](const auto& a, const auto& b) { return a.y < b.y; });
    attachment.ties.resize(1);
    attachment.ties[0].nodes[0] = static_cast<std::uint32_t>(lowest - positions.begin());
    attachment.ties[0].weights[0] = 1.0f;
    attachment.ties[0].count = 1;
    for (const auto& [is_broken, is_firm] :
         std::initializer_list<std::pair<bool, bool>>{{false, false}, {false, true}, {true, true}}) {
        attachment.is_broken = is_broken;
        attachment.is_firm = is_firm;
        cpu::AttachmentRows<double> attachments(model);
        attachments.set({attachment});
        std::vector<cpu::ContactRow<double>> rows;
        cpu::ContactRows<double>(model, surface)
            .make({positions, expected, compliances, 1.0 / 240.0, 1.0 / 240.0}, pairs.pairs(), attachments,
                  rows);
        std::size_t tied = 0;
        for (const auto& row : rows) {
            const auto end = row.nodes.begin() + row.count;
            if (is_broken || std::find(row.nodes.begin(), end, attachment.ties[0].nodes[0]) == end) {
                EXPECT_GT(row.reach, 0.9 * row.gap);
            } else {
                EXPECT_NEAR(row.reach, 0.5 * row.gap, 1e-6);
                ++tied;
            }
        }
        EXPECT_EQ(tied > 0, !is_broken && !is_firm);
    }
}

}  // namespace
}  // namespace gelatin
