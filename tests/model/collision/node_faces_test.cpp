#include "model/collision/node_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/corners.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

TEST(NodeFaces, AreThoseThatNameTheNode) {
    const Model model = test::make_model(test::make_body(test::make_block({3, 2, 4}, {3, 2, 4})));
    const NodeFaces around = make_node_faces(model.node_count(), model.faces);
    ASSERT_EQ(around.starts.size(), model.node_count() + 1);
    EXPECT_EQ(around.starts.back(), 3 * model.faces.size());
    int inside = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            if (has_corner(model.faces[f], n)) expected.push_back(f);
        }
        const std::vector<std::uint32_t> actual(around.faces.begin() + around.starts[n],
                                                around.faces.begin() + around.starts[n + 1]);
        EXPECT_EQ(actual, expected);
        inside += actual.empty() ? 1 : 0;
    }
    EXPECT_EQ(inside, 2 * 1 * 3);
}

}  // namespace
}  // namespace gelatin
