#include "gl/buffer.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <glm/vec4.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "gelatin/error.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"

namespace gelatin::gl {
namespace {

using ::testing::HasSubstr;

class BufferTest : public test::GlTest {};

std::vector<float> ramp(std::size_t count) {
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 0.5f);
    return values;
}

std::vector<float> content(const Buffer<float>& buffer) {
    std::vector<float> out(buffer.size(), std::numeric_limits<float>::quiet_NaN());
    buffer.download(out);
    return out;
}

TEST_F(BufferTest, GivesBackWhatItWasMadeOf) {
    const std::vector<float> values = ramp(1001);
    const Buffer<float> buffer{std::span<const float>(values)};
    EXPECT_EQ(buffer.size(), 1001u);
    EXPECT_EQ(content(buffer), values);
}

TEST_F(BufferTest, UploadReplacesTheContent) {
    Buffer<float> buffer(33);
    const std::vector<float> values = ramp(33);
    buffer.upload(values);
    EXPECT_EQ(content(buffer), values);
}

TEST_F(BufferTest, FillSetsEveryElement) {
    Buffer<std::uint32_t> buffer(1001);
    buffer.fill(0xfedcba98u);
    std::vector<std::uint32_t> out(1001);
    buffer.download(out);
    EXPECT_EQ(out, std::vector<std::uint32_t>(1001, 0xfedcba98u));
    Buffer<std::uint32_t>().fill(1);
}

TEST_F(BufferTest, OneOfNoElementsHoldsNothingAndCanBeBound) {
    Buffer<float> buffer{std::span<const float>()};
    EXPECT_TRUE(buffer.empty());
    EXPECT_NE(buffer.id(), 0u);
    EXPECT_EQ(Buffer<float>().id(), 0u);
    buffer.upload({});
    EXPECT_TRUE(content(buffer).empty());
}

TEST_F(BufferTest, MovedFromIsEmptyAndTheTargetsOldBufferIsFreed) {
    const std::vector<float> values = ramp(5);
    Buffer<float> source{std::span<const float>(values)};
    Buffer<float> target(7);
    const unsigned old = target.id();
    target = std::move(source);
    // NOLINTBEGIN(bugprone-use-after-move,clang-analyzer-cplusplus.Move): what is tested
    EXPECT_TRUE(source.empty());
    EXPECT_EQ(source.id(), 0u);
    // NOLINTEND(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
    EXPECT_EQ(content(target), values);
    EXPECT_FALSE(glIsBuffer(old));
}

TEST_F(BufferTest, MoreThanTheBlockLimitNamesBothSizes) {
    const std::size_t limit = context().device().max_storage_block_bytes;
    try {
        const Buffer<std::uint32_t> buffer(limit / 4 + 1);
        FAIL() << "expected GlError";
    } catch (const GlError& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::to_string(limit / 4 * 4 + 4) + " bytes"));
        EXPECT_THAT(error.what(), HasSubstr("limit of " + std::to_string(limit)));
    }
}

TEST_F(BufferTest, TextureShowsTheBuffersTexels) {
    test::ShaderFolder folder;
    folder.add("copy.comp", R"(
        layout(local_size_x = 64) in;
        uniform samplerBuffer source;
        layout(std430) buffer Out { vec2 values[]; };
        void main() { if (gl_GlobalInvocationID.x < 5u) values[gl_GlobalInvocationID.x] =
                          texelFetch(source, int(gl_GlobalInvocationID.x)).rg; }
    )");
    const Program program = Program::compute("copy.comp");
    const std::vector<float> values = ramp(10);
    const Buffer<float> source{std::span<const float>(values)};
    const Buffer<float> copy(10);
    const BufferTexture texture(source, TexelFormat::rg32f);
    program.bind("source", texture);
    program.bind("Out", copy);
    program.dispatch(5);
    barrier(Barrier::buffer_update);
    EXPECT_EQ(content(copy), values);
}

TEST_F(BufferTest, TextureOfTooManyTexelsNamesTheLimit) {
    const std::size_t limit = context().device().max_texture_buffer_texels;
    const Buffer<float> small(4);
    try {
        const BufferTexture texture(small.id(), (limit + 1) * 4, TexelFormat::r32f);
        FAIL() << "expected GlError";
    } catch (const GlError& error) {
        EXPECT_THAT(error.what(), HasSubstr(std::to_string(limit + 1) + " texels"));
        EXPECT_THAT(error.what(), HasSubstr("limit of " + std::to_string(limit)));
    }
}

// What a shader reads of a table's texel at `index`.
glm::vec4 texel_of(const TexelTable<glm::vec4>& table, std::size_t index) {
    test::ShaderFolder folder;
    folder.add("texel.comp", R"(
        layout(local_size_x = 64) in;
        uniform samplerBuffer table;
        layout(std430) buffer Out { vec4 value; };
        uniform uint index;
        void main() { if (gl_GlobalInvocationID.x == 0u) value = texelFetch(table, int(index)); }
    )");
    const Program program = Program::compute("texel.comp");
    const Buffer<glm::vec4> out(1);
    program.bind("table", table);
    program.bind("Out", out);
    program.set("index", static_cast<std::uint32_t>(index));
    program.dispatch(1);
    barrier(Barrier::buffer_update);
    glm::vec4 value(std::numeric_limits<float>::quiet_NaN());
    out.download({&value, 1});
    return value;
}

TEST_F(BufferTest, TablesMayBeLargerThanAStorageBlock) {
    const DeviceInfo& device = context().device();
    const std::size_t texels = device.max_storage_block_bytes / sizeof(glm::vec4) + 2;
    if (texels > (std::size_t{1} << 24)) GTEST_SKIP() << "storage blocks of " << texels << " texels";
    ASSERT_LE(texels, static_cast<std::size_t>(device.max_texture_buffer_texels));
    std::vector<glm::vec4> values(texels);
    values.back() = {1, 2, 3, 4};
    EXPECT_EQ(texel_of({values, TexelFormat::rgba32f}, texels - 1), glm::vec4(1, 2, 3, 4));
}

TEST_F(BufferTest, ATableOfNothingHasOneTexelOfZeros) {
    EXPECT_EQ(texel_of({std::vector<glm::vec4>(), TexelFormat::rgba32f}, 0), glm::vec4(0.0f));
}

TEST_F(BufferTest, NoTableIsNotBound) {
    EXPECT_THROW(texel_of({}, 0), GlError);
    TexelTable<glm::vec4> source(std::vector{glm::vec4(6.0f)}, TexelFormat::rgba32f);
    const TexelTable<glm::vec4> target = std::move(source);
    EXPECT_EQ(texel_of(target, 0), glm::vec4(6.0f));
    EXPECT_TRUE(source.is_empty());  // NOLINT(bugprone-use-after-move): what is tested
}

}  // namespace
}  // namespace gelatin::gl
