#include "model/descent/descent_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/crowd.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// The nodes of a batch's rows, colour by colour.
std::vector<std::set<std::uint32_t>> colors_of(const DescentRows& rows, const DescentBatch& batch) {
    std::vector<std::set<std::uint32_t>> colors;
    for (const Range& range : batch.colors) {
        std::set<std::uint32_t>& nodes = colors.emplace_back();
        for (std::uint32_t r = range.first; r < range.end(); ++r) {
            if (rows.nodes[r] == kNoNode) continue;
            EXPECT_TRUE(nodes.insert(rows.nodes[r]).second) << rows.nodes[r];
        }
    }
    return colors;
}

TEST(DescentRows, HaveEachNodeOfABatchOnceAndNoNeighboursInAColour) {
    const Model model = test::make_crowd(9, 3);
    const std::uint32_t body = model.objects.front().nodes.count;
    for (const std::uint32_t nodes_a_batch : {1u, 3 * body, model.node_count()}) {
        const DescentRows rows = make_descent_rows(model, nodes_a_batch);
        std::uint32_t objects = 0, nodes = 0, tets = 0, first_row = 0;
        for (const DescentBatch& batch : rows.batches) {
            EXPECT_EQ(batch.objects.first, objects);
            EXPECT_EQ(batch.nodes.first, nodes);
            EXPECT_EQ(batch.tets.first, tets);
            EXPECT_TRUE(batch.nodes.count <= nodes_a_batch || batch.objects.count == 1);
            objects = batch.objects.end();
            nodes = batch.nodes.end();
            tets = batch.tets.end();

            std::set<std::uint32_t> all;
            for (const std::set<std::uint32_t>& color : colors_of(rows, batch)) {
                for (const std::uint32_t n : color) EXPECT_TRUE(all.insert(n).second) << n;
                for (const Spring& spring : model.springs)
                    EXPECT_FALSE(color.contains(spring.i) && color.contains(spring.j));
            }
            EXPECT_EQ(all.size(), batch.nodes.count);
            EXPECT_EQ(*all.begin(), batch.nodes.first);
            EXPECT_EQ(*all.rbegin(), batch.nodes.end() - 1);
            for (const Range& color : batch.colors) {
                EXPECT_EQ(color.first, first_row);
                EXPECT_EQ(color.count % HalfSprings::kSlice, 0u);
                first_row = color.end();
            }
        }
        EXPECT_EQ(objects, model.objects.size());
        EXPECT_EQ(nodes, model.node_count());
        EXPECT_EQ(tets, model.tets.size());
        EXPECT_EQ(first_row, rows.nodes.size());
    }
}

TEST(Corrections, AreCounted) {
    int count = 0;
    for (int sweeps = 1; sweeps <= 30; ++sweeps) {
        EXPECT_EQ(correction_count(sweeps), count) << sweeps;
        count += (sweeps - 1) % kSweepsACorrection == 0 ? 1 : 0;  // if another sweep comes
    }
}

TEST(DescentRows, FillBatchesUp) {
    const Model model = test::make_crowd(9, 3);
    EXPECT_EQ(make_descent_rows(model).batches.size(), 1u);
    EXPECT_EQ(make_descent_rows(model, 1).batches.size(), model.objects.size());
    std::uint32_t least = model.node_count();  // of two batches beside each other: else they would be one
    const DescentRows rows = make_descent_rows(model, model.node_count() / 2);
    ASSERT_GE(rows.batches.size(), 2u);
    for (std::size_t b = 0; b + 1 < rows.batches.size(); ++b)
        least = std::min(least, rows.batches[b].nodes.count +
                                    model.objects[rows.batches[b + 1].objects.first].nodes.count);
    EXPECT_GT(least, model.node_count() / 2);
}

}  // namespace
}  // namespace gelatin
