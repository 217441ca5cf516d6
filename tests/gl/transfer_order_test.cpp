// What the host writes between two dispatches is seen by the later one alone: however long the earlier one
// reads, and whatever other programs run between. OpenGL orders it so without a barrier; a driver that does
// not fails here.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <vector>

#include "gl/barrier.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"

namespace gelatin::gl {
namespace {

constexpr std::uint32_t kRuns = 40;

using Values = Buffer<std::uint32_t>;

struct Case {
    const char* name;
    std::size_t size;     // of the buffer that is written, a power of two
    bool through_texels;  // the shader reads it so, otherwise as a block
    bool fills;           // the host fills it, otherwise it uploads
    bool takes_turns;     // another program runs after each dispatch
};

std::string name_of_case(const ::testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

// An invocation reads an element late, after a chain of operations whose end alone says which one.
class TransferOrderTest : public test::GlTest, public ::testing::WithParamInterface<Case> {
protected:
    TransferOrderTest() {
        folder_.add("late.comp", R"(
            layout(local_size_x = 1) in;
            #ifdef TEXELS
            uniform usamplerBuffer values;
            uint value_of(uint k) { return texelFetch(values, int(k)).x; }
            #else
            layout(std430) readonly buffer Values { uint values[]; };
            uint value_of(uint k) { return values[k]; }
            #endif
            layout(std430) buffer Seen { uint seen[]; };
            uniform uint run, rounds, last;
            void main() {
                uint x = run;
                for (uint i = 0u; i < rounds; ++i) x = x * 1664525u + 1013904223u;
                seen[run] = value_of(x & last);
            })");
        folder_.add("other.comp", R"(
            layout(local_size_x = 1) in;
            layout(std430) readonly buffer Seen { uint seen[]; };
            layout(std430) buffer Sum { uint sum; };
            void main() { sum += seen[0]; })");
    }

    test::ShaderFolder folder_;
};

TEST_P(TransferOrderTest, IsThatOfTheCalls) {
    const auto [name, size, through_texels, fills, takes_turns] = GetParam();
    const Program program = Program::compute("late.comp", through_texels ? Defines{"TEXELS"} : Defines{});
    Values values(size), seen(kRuns);
    const BufferTexture texels(values, TexelFormat::r32ui);
    if (through_texels) {
        program.bind("values", texels);
    } else {
        program.bind("Values", values);
    }
    program.bind("Seen", seen);
    const Program other = Program::compute("other.comp");
    const Values sum(1);
    other.bind("Seen", seen);
    other.bind("Sum", sum);
    program.set("rounds", takes_turns ? 10u : 100'000u);
    program.set("last", static_cast<std::uint32_t>(size) - 1u);
    for (std::uint32_t run = 0; run < kRuns; ++run) {
        if (fills) {
            values.fill(run);
        } else {
            values.upload(std::vector<std::uint32_t>(size, run));
        }
        program.set("run", run);
        program.dispatch(1);
        barrier(Barrier::storage | Barrier::texture_fetch);
        if (!takes_turns) continue;
        other.dispatch(1);
        barrier(Barrier::storage | Barrier::texture_fetch);
    }
    barrier(Barrier::buffer_update);
    std::vector<std::uint32_t> found(kRuns), expected(kRuns);
    seen.download(found);
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(found, expected);
}

std::vector<Case> cases() {
    return {{"FewUploadedToABlock", 32, false, false, false},
            {"FewUploadedToTexels", 32, true, false, false},
            {"ManyUploadedToABlock", 1 << 18, false, false, false},
            {"ManyUploadedToTexels", 1 << 18, true, false, false},
            {"FewFilledInABlock", 32, false, true, false},
            {"FewFilledInTexels", 32, true, true, false},
            {"ManyFilledInABlock", 1 << 18, false, true, false},
            {"ManyFilledInTexels", 1 << 18, true, true, false},
            {"FewUploadedToABlockByTurns", 32, false, false, true},
            {"FewUploadedToTexelsByTurns", 32, true, false, true},
            {"FewFilledInABlockByTurns", 32, false, true, true},
            {"FewFilledInTexelsByTurns", 32, true, true, true}};
}

INSTANTIATE_TEST_SUITE_P(All, TransferOrderTest, ::testing::ValuesIn(cases()), name_of_case);

}  // namespace
}  // namespace gelatin::gl
