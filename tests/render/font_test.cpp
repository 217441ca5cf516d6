#include "render/font.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gelatin::render {
namespace {

int ink_of(const TextPicture& text) {
    return static_cast<int>(
        std::count_if(text.coverage.begin(), text.coverage.end(), [](auto c) { return c > 127; }));
}

TEST(Font, PaintsALineOfItsHeight) {
    const Font font(20);
    const TextPicture text = font.paint("Gelatin");
    EXPECT_EQ(text.height, font.line_height());
    EXPECT_GE(font.line_height(), 20);
    EXPECT_LT(font.line_height(), 30);
    EXPECT_EQ(text.coverage.size(),
              static_cast<std::size_t>(text.width) * static_cast<std::size_t>(text.height));
    EXPECT_GT(ink_of(text), 100);
}

TEST(Font, LettersStandBesideEachOther) {
    const Font font(20);
    EXPECT_EQ(font.paint("mi").width, font.paint("m").width + font.paint("i").width);
    EXPECT_GT(font.paint("m").width, font.paint("i").width);
    EXPECT_EQ(ink_of(font.paint("mi")), ink_of(font.paint("m")) + ink_of(font.paint("i")));
}

// The stem of a p goes below the line on which an l stands, and the stem of the l is higher.
TEST(Font, RowsAreFromTheBottom) {
    const Font font(32);
    const auto lowest = [](const TextPicture& text) {
        const auto first = std::ranges::find_if(text.coverage, [](auto c) { return c > 127; });
        return (first - text.coverage.begin()) / text.width;
    };
    const TextPicture p = font.paint("p"), l = font.paint("l");
    EXPECT_GT(lowest(p), 0);
    EXPECT_GE(lowest(l), lowest(p) + 4);
}

TEST(Font, DrawsABoxForWhatIsNotUtf8AndWhatItLacks) {
    const Font font(20);
    EXPECT_GT(ink_of(font.paint("\xff")), 0);
    EXPECT_EQ(font.paint("\xff").coverage, font.paint("\xef\xbf\xbd").coverage) << "U+FFFD";
    EXPECT_GT(ink_of(font.paint("\xf4\x8f\xbf\xbf")), 0) << "U+10FFFF";
    EXPECT_NE(font.paint("\xc3\xa9").coverage, font.paint("e").coverage);
}

TEST(Font, NothingIsNothing) {
    const TextPicture text = Font(20).paint("");
    EXPECT_EQ(text.width, 0);
    EXPECT_EQ(text.at(0, 0), 0);
}

}  // namespace
}  // namespace gelatin::render
