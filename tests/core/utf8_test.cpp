#include "core/utf8.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gelatin {
namespace {

// 0 for what is not UTF-8.
std::vector<char32_t> decode(const std::string& text) {
    std::vector<char32_t> all;
    for (std::size_t at = 0; at < text.size();) all.push_back(next_code_point(text, at).value_or(0));
    return all;
}

TEST(Utf8, CodePointsOfOneToFourBytes) {
    EXPECT_EQ(decode("a\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80z"),
              (std::vector<char32_t>{U'a', 0xe9, 0x20ac, 0x1f600, U'z'}));
}

// One byte further each time, so that what follows is found again.
TEST(Utf8, WhatIsNot) {
    EXPECT_EQ(decode("\xff"
                     "a"),
              (std::vector<char32_t>{0, U'a'}));
    EXPECT_EQ(decode("\x80"), (std::vector<char32_t>{0}));
    EXPECT_EQ(decode("\xc3"), (std::vector<char32_t>{0})) << "cut short";
    EXPECT_EQ(decode("\xc0\xaf"), (std::vector<char32_t>{0, 0})) << "overlong";
    EXPECT_EQ(decode("\xed\xa0\x80"), (std::vector<char32_t>{0, 0, 0})) << "a surrogate";
    EXPECT_EQ(decode("\xf4\x90\x80\x80"), (std::vector<char32_t>{0, 0, 0, 0})) << "above U+10FFFF";
    EXPECT_EQ(decode("\xe2\x82"
                     "a"),
              (std::vector<char32_t>{0, 0, U'a'}));
}

}  // namespace
}  // namespace gelatin
