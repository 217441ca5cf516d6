// Deliberately broken kernels must be caught: each mutant of tests/mutants/mutants.h is run in place of the
// true shader, and the parity test's own measure must say so.
#include "mutants/mutants.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/gl_fixture.h"
#include "support/parity.h"
#include "support/shader_folder.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 2e-4;  // [s]

class MutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Mutant> {};
INSTANTIATE_TEST_SUITE_P(All, MutantsTest, ::testing::ValuesIn(test::kMutants),
                         [](const auto& test) { return std::string(test.param.name); });

void copy_shaders(const test::Mutant& mutant, test::ShaderFolder& folder) {
    const fs::path root = fs::path(GELATIN_SOURCE_DIR) / "shaders";
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (!entry.is_regular_file()) continue;
        const std::string name = fs::relative(entry.path(), root).generic_string();
        std::string text = read_file(entry.path());
        if (name == mutant.file) {
            const std::size_t at = text.find(mutant.from);
            ASSERT_NE(at, std::string::npos) << mutant.file << " no longer has: " << mutant.from;
            text.replace(at, std::string(mutant.from).size(), mutant.to);
        }
        folder.add(name, text);
    }
}

TEST_P(MutantsTest, IsCaught) {
    test::ShaderFolder folder;
    copy_shaders(GetParam(), folder);
    const Model model = test::make_lively_model();
    const test::NodeArrays actual = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    const double error = test::worst_error(model, test::rounding_bounds(model, GetParam().solver, kStep),
                                           test::oracle_step(model, GetParam().solver, kStep),
                                           actual.positions, actual.velocities);
    const bool guarded = test::guard_is_untouched(actual.positions, model.node_count()) &&
                         test::guard_is_untouched(actual.velocities, model.node_count());
    EXPECT_TRUE(error > 1.0 || !guarded) << "the broken kernel passes: error / bound = " << error;
}

}  // namespace
}  // namespace gelatin
