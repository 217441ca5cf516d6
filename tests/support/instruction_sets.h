#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

namespace gelatin::test {

/// Calls check() once with each instruction set that Gelatin is compiled for and this processor has, down to
/// none, as other processors would choose them. Fails if there is only one.
template <class Check>
void with_each_instruction_set(const Check& check) {
    const auto choose = [](std::int64_t targets) {
        hwy::SetSupportedTargetsForTest(targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    const auto all = hwy::SupportedAndGeneratedTargets();
    EXPECT_GT(all.size(), 1u);
    for (const std::int64_t target : all) {
        SCOPED_TRACE(hwy::TargetName(target));
        choose(target);
        check();
    }
    choose(0);
}

}  // namespace gelatin::test
