#include "gpu/implicit/tries.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "gl/shader_source.h"
#include "gpu/implicit/step_buffers.h"
#include "model/shared_constants.h"
#include "support/gl_fixture.h"

namespace gelatin::gpu {
namespace {

// Counts the work groups of dispatches.
class TriesTest : public test::GlTest {
protected:
    TriesTest()
        : shader_("count.comp",
                  "layout(local_size_x = 1) in;\n"
                  "layout(std430) buffer Counts { uint counts[]; };\n"
                  "void main() { atomicAdd(counts[0], 1u); }\n"),
          program_(gl::Program::compute("count.comp")),
          counts_(std::vector<std::uint32_t>(1)) {
        program_.bind("Counts", counts_);
    }

    static StepClock clock(bool goes_on, std::uint32_t guards) {
        StepClock clock{};
        clock.goes_on = goes_on ? 1 : 0;
        clock.guards = guards;
        return clock;
    }
    template <class Run>
    std::uint32_t groups_of(const Run& run) {
        counts_.upload(std::vector<std::uint32_t>(1));
        run();
        return read(counts_)[0];
    }
    std::uint32_t groups(Tries::Where where, std::size_t wanted) {
        return groups_of([&] { tries_.run(where, program_, wanted); });
    }
    std::uint32_t counted_groups(std::uint32_t dispatch) {
        return groups_of([&] { tries_.run_counted(program_, dispatch); });
    }

    static constexpr auto kMakesPart = Tries::Where::makes_part, kGoesOn = Tries::Where::goes_on;
    gl::ShaderOverride shader_;
    gl::Program program_;
    gl::Buffer<std::uint32_t> counts_;
    Tries tries_;
};

TEST_F(TriesTest, LaunchNothingAtFirst) {
    EXPECT_EQ(groups(kMakesPart, 5), 0);
    EXPECT_EQ(groups(kGoesOn, 5), 0);
}

TEST_F(TriesTest, LaunchAllInAPart) {
    tries_.set_clock(clock(true, 0));
    EXPECT_EQ(groups(kMakesPart, 5), 5);
    EXPECT_EQ(groups(kGoesOn, 5), 5);
    EXPECT_EQ(groups(kGoesOn, 7), 7);  // though it was not known when the try began
}

TEST_F(TriesTest, LaunchTheGuardAlone) {
    groups(kMakesPart, 5);
    tries_.set_clock(clock(true, 2));
    EXPECT_EQ(groups(kMakesPart, 5), 0);
    EXPECT_EQ(groups(kGoesOn, 5), 5);
}

TEST_F(TriesTest, LaunchNothingAfterOneWasGivenUp) {
    tries_.set_clock(clock(true, 0));
    gl::barrier(gl::Barrier::buffer_update);
    tries_.set_count(try_dispatches::kRows, 130);
    EXPECT_EQ(counted_groups(try_dispatches::kRows), 3);
    tries_.set_clock(clock(false, 0));
    EXPECT_EQ(groups(kGoesOn, 5), 0);
    EXPECT_EQ(counted_groups(try_dispatches::kRows), 0);
    tries_.set_clock(clock(true, 0));
    EXPECT_EQ(counted_groups(try_dispatches::kRows), 0);  // until it is counted again
}

TEST_F(TriesTest, LaunchMoreGroupsThanADimensionHas) {
    tries_.set_clock(clock(true, 0));
    EXPECT_EQ(groups(kMakesPart, 70'000), 70'000);
}

}  // namespace
}  // namespace gelatin::gpu
