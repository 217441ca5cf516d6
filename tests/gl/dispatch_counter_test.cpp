#include "gl/dispatch_counter.h"

#include <gmock/gmock.h>

#include <array>
#include <vector>

#include "core/current_stage.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"

namespace gelatin::gl {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

using Groups = std::array<std::uint32_t, 3>;

class DispatchCounterTest : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        folder_.add("work.comp",
                    "layout(local_size_x = 64) in;\n"
                    "layout(std430) writeonly buffer Out { uint values[]; };\n"
                    "void main() { values[gl_GlobalInvocationID.x] = 1u; }\n");
        // What the device finds: work groups for the second of two dispatches alone.
        folder_.add("plan.comp",
                    "layout(local_size_x = 1) in;\n"
                    "layout(std430) writeonly buffer Plan { uint groups[]; };\n"
                    "void main() { groups[0] = 0u; groups[3] = 1u; }\n");
        work_ = Program::compute("work.comp");
        work_.bind("Out", buffer_);
        plan_ = Program::compute("plan.comp");
        plan_.bind("Plan", groups_);
    }

    void work(std::size_t invocations) const {
        work_.dispatch(invocations);
        barrier(Barrier::storage);
    }
    void plan() const {
        plan_.dispatch(1);
        barrier(Barrier::storage | Barrier::command);
    }
    void follow_plan() const {
        for (const std::size_t dispatch : {0, 1}) {
            work_.dispatch_indirect(groups_.id(), dispatch * sizeof(Groups));
            barrier(Barrier::storage);
        }
    }

    test::ShaderFolder folder_;
    Buffer<std::uint32_t> buffer_{64};
    Buffer<Groups> groups_{std::vector<Groups>{{1, 1, 1}, {1, 1, 1}}};
    Program work_, plan_;
};

TEST_F(DispatchCounterTest, CountsByStageAndProgram) {
    DispatchCounter counter;
    work(64);
    work(0);  // launches nothing
    {
        const CurrentStage stage("plan");
        plan();
        plan();
        work(64);
    }
    EXPECT_THAT(counter.take(),
                ElementsAre(Pair("", ElementsAre(Pair("work.comp", DispatchCount{1, 1}))),
                            Pair("plan", ElementsAre(Pair("plan.comp", DispatchCount{2, 2}),
                                                     Pair("work.comp", DispatchCount{1, 1})))));
    EXPECT_THAT(counter.take(), IsEmpty());
}

TEST_F(DispatchCounterTest, ReadsWhichDispatchesHaveWork) {
    DispatchCounter counter;
    follow_plan();
    EXPECT_THAT(counter.take()[""], ElementsAre(Pair("work.comp", DispatchCount{2, 2})));
    plan();
    follow_plan();
    EXPECT_THAT(counter.take()[""],
                ElementsAre(Pair("plan.comp", DispatchCount{1, 1}), Pair("work.comp", DispatchCount{2, 1})));
}

// Nothing reads arguments, or grows, where nobody counts.
TEST_F(DispatchCounterTest, CountsOnlyWhileItLives) {
    follow_plan();
    {
        DispatchCounter counter;
        EXPECT_EQ(dispatch_counter, &counter);
        EXPECT_THAT(counter.take(), IsEmpty());
    }
    EXPECT_EQ(dispatch_counter, nullptr);
    follow_plan();
    DispatchCounter counter;
    EXPECT_THAT(counter.take(), IsEmpty());
}

}  // namespace
}  // namespace gelatin::gl
