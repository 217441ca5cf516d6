#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "support/gl_fixture.h"

namespace gelatin::test {

/// Something that kernels compute, held against a reference. The test of parity and the mutants of its
/// kernels run the same scenarios: that a broken kernel fails one of them proves the test.
struct Scenario {
    std::string name;  ///< of letters, digits and underscores
    /// Runs it. The largest error over its bound, so that at most 1 is a pass; infinite where something is
    /// not finite, not equal that must be, or written where nothing may be.
    std::function<double()> error;
};
using Scenarios = std::vector<Scenario>;

inline void PrintTo(const Scenario& scenario, std::ostream* out) {
    *out << scenario.name;
}

/// The error of what is either right or wrong.
inline double error_if(bool is_wrong) {
    return is_wrong ? std::numeric_limits<double>::infinity() : 0.0;
}

/// All of them, in their order.
Scenarios joined(const std::vector<Scenarios>& lists);

/// A test with scenarios as its parameter.
class ParityTest : public GlTest, public ::testing::WithParamInterface<Scenario> {};

/// For INSTANTIATE_TEST_SUITE_P.
inline std::string name_of_scenario(const ::testing::TestParamInfo<Scenario>& test) {
    return test.param.name;
}

}  // namespace gelatin::test
