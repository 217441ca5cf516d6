#include "gl/readback.h"

#include <gmock/gmock.h>

#include <cstring>
#include <vector>

#include "gl/buffer.h"
#include "support/gl_fixture.h"

namespace gelatin::gl {
namespace {

using ::testing::ElementsAre;

class ReadbackTest : public test::GlTest {
protected:
    static std::vector<std::uint32_t> numbers(const std::vector<std::byte>& bytes) {
        std::vector<std::uint32_t> values(bytes.size() / 4);
        if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
};

TEST_F(ReadbackTest, GivesTheContentOfTheTimeOfBeginInOrder) {
    Buffer<std::uint32_t> buffer(2);
    Readback readback;
    for (std::uint32_t i = 0; i < 5; ++i) {
        buffer.upload(std::vector<std::uint32_t>{i, 10 * i});
        readback.begin(buffer.id(), i == 3 ? 4 : 8);
    }
    EXPECT_EQ(readback.pending(), 5u);
    EXPECT_THAT(numbers(readback.take()), ElementsAre(0, 0));
    EXPECT_THAT(numbers(readback.take()), ElementsAre(1, 10));
    EXPECT_THAT(numbers(readback.take()), ElementsAre(2, 20));
    EXPECT_THAT(numbers(readback.take()), ElementsAre(3));
    EXPECT_THAT(numbers(readback.take()), ElementsAre(4, 40));
    EXPECT_EQ(readback.pending(), 0u);
}

TEST_F(ReadbackTest, ReusesItsStagingBuffersWithoutMixingThem) {
    Buffer<std::uint32_t> buffer(1);
    Readback readback;
    for (std::uint32_t i = 0; i < 100; ++i) {
        buffer.upload(std::vector<std::uint32_t>{i});
        readback.begin(buffer.id(), 4);
        if (i == 0) continue;
        EXPECT_THAT(numbers(readback.take()), ElementsAre(i - 1));
    }
    EXPECT_THAT(numbers(readback.take()), ElementsAre(99));
}

TEST_F(ReadbackTest, BecomesReadyWithoutBeingTaken) {
    const Buffer<std::uint32_t> buffer(1);
    Readback readback;
    EXPECT_FALSE(readback.ready());
    readback.begin(buffer.id(), 4);
    while (!readback.ready()) continue;  // the test's time limit catches a fence that never comes
    EXPECT_EQ(readback.take().size(), 4u);
}

TEST_F(ReadbackTest, NothingIsAnEmptyCopy) {
    Readback readback;
    readback.begin(0, 0);
    EXPECT_TRUE(readback.take().empty());
}

}  // namespace
}  // namespace gelatin::gl
