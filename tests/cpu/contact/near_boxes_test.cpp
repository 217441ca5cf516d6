#include "cpu/contact/near_boxes.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <vector>

#include "cpu/collision/walk_tree.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

// Any number of boxes, some of which touch the one compared, in their order and no others.
template <class Real>
void expect_those_that_meet() {
    test::RandomMaker random(3);
    cpu::NearBoxes<Real> near;
    int met = 0;
    for (std::uint32_t count = 0; count < 40; ++count) {
        std::vector<cpu::AxisBox<Real>> boxes;
        near.clear();
        for (std::uint32_t k = 0; k < count; ++k) {
            const auto center = cpu::Vec3<Real>(random.point(1.0)),
                       half = glm::abs(cpu::Vec3<Real>(random.point(0.4)));
            boxes.push_back({center - half, center + half});
            near.add(2 * k + 1, boxes.back());
        }
        EXPECT_EQ(near.is_empty(), count == 0);
        for (int round = 0; round < 50; ++round) {
            const auto center = cpu::Vec3<Real>(random.point(1.0)),
                       half = glm::abs(cpu::Vec3<Real>(random.point(0.4)));
            cpu::AxisBox<Real> box{center - half, center + half};
            if (count > 0 && round % 3 == 0) box.min.x = boxes[0].max.x;  // touches it, or is inside out
            std::vector<std::uint32_t> expected, found;
            for (std::uint32_t k = 0; k < count; ++k)
                if (cpu::meet(box, boxes[k])) expected.push_back(2 * k + 1);
            near.for_meeting(box, [&](std::uint32_t index) { found.push_back(index); });
            ASSERT_EQ(found, expected) << count << ' ' << round;
            met += static_cast<int>(found.size());
        }
    }
    EXPECT_GT(met, 1000);
}

TEST(NearBoxes, AreThoseThatMeet) {
    expect_those_that_meet<float>();
    expect_those_that_meet<double>();
}

}  // namespace
}  // namespace gelatin
