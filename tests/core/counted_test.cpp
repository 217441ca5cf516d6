#include "core/counted.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

TEST(Counted, HasAnSButForOne) {
    EXPECT_EQ(counted(0, "node"), "0 nodes");
    EXPECT_EQ(counted(1, "node"), "1 node");
    EXPECT_EQ(counted(12345678901, "node"), "12345678901 nodes");
}

}  // namespace
}  // namespace gelatin
