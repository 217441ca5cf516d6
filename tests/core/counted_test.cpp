#include "core/counted.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

TEST(Counted, HasAnSButForOne) {
    EXPECT_EQ(counted(0, "node"), "0 nodes");
    EXPECT_EQ(counted(1, "node"), "1 node");
    EXPECT_EQ(counted(12345678901, "node"), "12345678901 nodes");
    EXPECT_EQ(counted(1, "vertex", "vertices"), "1 vertex");
    EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
}

}  // namespace
}  // namespace gelatin
