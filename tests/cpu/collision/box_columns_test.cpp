#include "cpu/collision/box_columns.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/instruction_sets.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

template <class Real>
class BoxColumnsTest : public testing::Test {
protected:
    BoxColumnsTest() : columns_(kCount) {
        for (std::size_t k = 0; k < kCount; ++k) columns_.set(k, columns_boxes_.emplace_back(make_box()));
        for (int k = 0; k < 5; ++k) boxes_.push_back(make_box());
        columns_.set(7, boxes_[0]);  // the same
        columns_boxes_[7] = boxes_[0];
        cpu::AxisBox<Real> beside = boxes_[0];  // with a face in common
        beside.min.x = boxes_[0].max.x;
        beside.max.x = beside.min.x + Real(1);
        columns_.set(8, columns_boxes_[8] = beside);
        columns_.set(9, columns_boxes_[9] = cpu::AxisBox<Real>());  // empty
    }

    cpu::AxisBox<Real> make_box() {
        cpu::AxisBox<Real> box;
        for (int k = 0; k < 2; ++k)
            box.add(cpu::Vec3<Real>(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0),
                                    random_.uniform(-1.0, 1.0)));
        return box;
    }

    static constexpr std::size_t kCount = 61;
    test::RandomMaker random_{11};
    std::vector<cpu::AxisBox<Real>> columns_boxes_, boxes_;
    cpu::BoxColumns<Real> columns_;
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxColumnsTest, Reals);

TYPED_TEST(BoxColumnsTest, FindsWhatMeets) {
    // Up to the last column, of several lengths, none among them.
    const std::vector<Range> ranges{{0, 3}, {5, 17}, {30, 0}, {44, 17}};
    std::vector<cpu::BoxPair> expected;
    for (std::uint32_t b = 0; b < this->boxes_.size(); ++b)
        for (const Range& range : ranges)
            for (std::uint32_t k = range.first; k < range.end(); ++k)
                if (meet(this->boxes_[b], this->columns_boxes_[k])) expected.push_back({b, k});
    ASSERT_GT(expected.size(), 20u);
    test::with_each_instruction_set([&] {
        std::vector<cpu::BoxPair> found;
        cpu::find_meeting(this->boxes_, this->columns_, ranges, found);
        EXPECT_EQ(found, expected);
    });
}

TYPED_TEST(BoxColumnsTest, KnowsWhetherAnyMeets) {
    test::with_each_instruction_set([&] {
        for (int k = 0; k < 200; ++k) {
            cpu::AxisBox<TypeParam> box = this->make_box();
            box.max = box.min + TypeParam(0.2) * (box.max - box.min);
            for (const std::uint32_t count : {0u, 1u, 8u, 13u, 61u}) {
                bool any = false;
                for (std::uint32_t c = 0; c < count; ++c) any = any || meet(box, this->columns_boxes_[c]);
                EXPECT_EQ(any_meets(box, this->columns_, count), any) << count;
            }
        }
    });
}

TYPED_TEST(BoxColumnsTest, Grows) {
    cpu::BoxColumns<TypeParam> columns;
    for (const cpu::AxisBox<TypeParam>& box : this->columns_boxes_) columns.add(box);
    ASSERT_EQ(columns.size(), this->columns_boxes_.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
        EXPECT_EQ(columns.at(k).min, this->columns_boxes_[k].min);
        EXPECT_EQ(columns.at(k).max, this->columns_boxes_[k].max);
    }
}

}  // namespace
}  // namespace gelatin
