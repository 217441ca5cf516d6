#include "core/packed_arrays.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

TEST(PackedArrays, ComeBackInTheirOrder) {
    ArrayWriter writer;
    writer.add(std::vector<double>{1.5, -2.0});
    writer.add(std::vector<int>{});
    writer.add(std::vector<char>{'x'});
    ArrayReader reader(writer.bytes());
    std::vector<double> doubles;
    std::vector<int> ints{7};
    std::vector<char> chars;
    EXPECT_TRUE(reader.take(doubles) && reader.take(ints));
    EXPECT_FALSE(reader.at_end());
    EXPECT_TRUE(reader.take(chars));
    EXPECT_TRUE(reader.at_end());
    EXPECT_EQ(doubles, (std::vector<double>{1.5, -2.0}));
    EXPECT_TRUE(ints.empty());
    EXPECT_EQ(chars, std::vector<char>{'x'});
    EXPECT_FALSE(reader.take(chars)) << "nothing is left";
}

TEST(PackedArrays, BytesThatAreCutOffOrCountTooManyAreRefused) {
    ArrayWriter writer;
    writer.add(std::vector<double>{1.0, 2.0, 3.0});
    std::vector<double> taken;
    for (std::size_t size = 0; size < writer.bytes().size(); ++size) {
        const std::string cut = writer.bytes().substr(0, size);
        EXPECT_FALSE(ArrayReader(cut).take(taken)) << size;
    }
    std::string huge = writer.bytes();
    huge.replace(0, 8, std::string(8, '\xff'));  // so many that their size in bytes wraps round
    EXPECT_FALSE(ArrayReader(huge).take(taken));
}

}  // namespace
}  // namespace gelatin
