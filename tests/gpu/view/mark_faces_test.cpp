#include "gpu/view/mark_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/crowd.h"
#include "support/folded.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

class MarkFacesTest : public test::GlTest {};

TEST_F(MarkFacesTest, MarksThoseThatTheCpuFinds) {
    const Model model = test::make_crowd(30);
    ASSERT_NE(model.faces.size() % 64, 0u);
    std::vector<std::uint32_t> expected(model.faces.size(), 0);
    for (const auto& [face, other, touch] : test::find_collisions_on_cpu<float>(model, {}))
        expected[face] = 1;
    const auto marked = static_cast<std::size_t>(std::count(expected.begin(), expected.end(), 1u));
    EXPECT_GT(marked, 50u);
    EXPECT_LT(marked, expected.size() - 50);
    EXPECT_EQ(test::mark_faces_on_gpu(model), expected);
}

TEST_F(MarkFacesTest, MarksThoseThatTouchTheirOwnObject) {
    const Model model = test::make_folded(test::Deformation::rolled);
    std::vector<std::uint32_t> expected = test::find_self_contacts_by_brute_force(model);
    for (std::uint32_t& mark : expected) mark = mark > 0 ? 1 : 0;
    EXPECT_GT(std::count(expected.begin(), expected.end(), 1u), 50);
    for (const auto& [face, other, touch] : test::find_collisions_by_brute_force(model)) expected[face] = 1;
    EXPECT_EQ(test::mark_faces_on_gpu(model, {.self_collision = true}), expected);
}

}  // namespace
}  // namespace gelatin
