#include "core/content_hash.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

template <class... Content>
std::string hash_of(const Content&... content) {
    ContentHash hash;
    (hash.add(content), ...);
    return hash.hex();
}

TEST(ContentHash, TellsContentsApart) {
    const std::string a = "ab", b = "c";
    EXPECT_EQ(hash_of(a, b), hash_of(a, b));
    EXPECT_EQ(hash_of(a, b).size(), 32u);
    EXPECT_NE(hash_of(a, b), hash_of(b, a));
    EXPECT_NE(hash_of(a, b), hash_of(std::string("a"), std::string("bc"))) << "texts run together";
    EXPECT_NE(hash_of(std::vector<int>{1, 2}, std::vector<int>{3}),
              hash_of(std::vector<int>{1}, std::vector<int>{2, 3}));
    EXPECT_NE(hash_of(std::vector<int>{}), hash_of(std::vector<int>{}, std::vector<int>{}));
}

}  // namespace
}  // namespace gelatin
