#pragma once

#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "gl/shader_source.h"
#include "gpu/support/scenario.h"

namespace gelatin::test {

/// A shader broken on purpose: `from`, which stands once in `file` (below shaders/), becomes `to`.
struct Mutant {
    const char* name;
    const char* file;
    const char* from;
    const char* to;
};

/// Breaks a shader for as long as the object lives.
class BrokenShader {
public:
    /// @throws std::runtime_error if the file does not have `from` exactly once.
    explicit BrokenShader(const Mutant& mutant);

private:
    gl::ShaderOverride override_;
};

/// A mutant, and the scenarios of which one at least must fail with it.
struct MutantCase {
    Mutant mutant;
    Scenarios scenarios;
};

inline void PrintTo(const MutantCase& test, std::ostream* out) {
    *out << test.mutant.name;
}

std::vector<MutantCase> cases(std::span<const Mutant> mutants, const Scenarios& scenarios);

/// For INSTANTIATE_TEST_SUITE_P.
inline std::string name_of_case(const ::testing::TestParamInfo<MutantCase>& test) {
    return test.param.mutant.name;
}

/// Its one test is that the mutant is caught (tests/gpu/mutants_test.cpp).
class MutantsTest : public GlTest, public ::testing::WithParamInterface<MutantCase> {};

}  // namespace gelatin::test
