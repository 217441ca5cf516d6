#include "gpu/view/mark_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "gpu/support/collision_scenarios.h"
#include "support/crowd.h"
#include "support/folded.h"

namespace gelatin {
namespace {

class MarkFacesParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, MarkFacesParityTest, ::testing::ValuesIn(test::mark_scenarios()),
                         test::name_of_scenario);

TEST_P(MarkFacesParityTest, MarksWhatTheCpuFinds) {
    EXPECT_LE(GetParam().error(), 1.0);
}

// Many faces of either kind, and some beyond the last full group.
TEST(MarkFaces, HasFacesToMarkAndOthers) {
    const Model crowd = test::make_crowd(30), rolled = test::make_folded(test::Deformation::rolled);
    EXPECT_NE(crowd.faces.size() % 64, 0u);
    std::set<std::uint32_t> marked;
    for (const auto& collision : test::find_collisions_on_cpu<float>(crowd, {}))
        marked.insert(collision.face);
    EXPECT_GT(marked.size(), 50u);
    EXPECT_LT(marked.size(), crowd.faces.size() - 50);
    const test::SelfContacts contacts = test::find_self_contacts_by_brute_force(rolled);
    EXPECT_GT(std::count_if(contacts.begin(), contacts.end(), [](std::uint32_t count) { return count > 0; }),
              50);
}

}  // namespace
}  // namespace gelatin
