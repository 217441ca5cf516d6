// Deliberately broken kernels must be caught: each mutant of tests/mutants/ is run in place of the
// true shader, and the parity test's own measure must say so.
#include <gtest/gtest.h>

#include <filesystem>

#include "mutants/collision_mutants.h"
#include "mutants/solver_mutants.h"
#include "support/crowd.h"
#include "support/descend_on_gpu.h"
#include "support/drive_on_gpu.h"
#include "support/folded.h"
#include "support/gl_fixture.h"
#include "support/lost_shapes.h"
#include "support/measure_on_gpu.h"
#include "support/parity.h"
#include "support/proximities.h"
#include "support/pull_on_gpu.h"
#include "support/shader_folder.h"
#include "support/source_path.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"
#include "support/tet_values.h"
#include "support/watched_runs.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 2e-4;     // [s]
constexpr double kLongStep = 0.1;  // on its way a block meets others [s]

// All shaders in a folder, one of them broken.
void break_shaders(const test::Break& mutant, test::ShaderFolder& folder) {
    const fs::path root = fs::path(test::source_path()) / "shaders";
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

const auto name_of_mutant = [](const auto& test) { return std::string(test.param.name); };

class StepMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::StepMutant> {};
INSTANTIATE_TEST_SUITE_P(All, StepMutantsTest, ::testing::ValuesIn(test::kStepMutants), name_of_mutant);

TEST_P(StepMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    const Model model = test::make_lively_model();
    const test::NodeArrays actual = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    const double error = test::worst_error(model, test::rounding_bounds(model, GetParam().solver, kStep),
                                           test::oracle_step(model, GetParam().solver, kStep),
                                           actual.positions, actual.velocities);
    const bool guarded = test::guard_is_untouched(actual.positions, model.node_count()) &&
                         test::guard_is_untouched(actual.velocities, model.node_count());
    EXPECT_TRUE(error > 1.0 || !guarded) << "the broken kernel passes: error / bound = " << error;
}

class MarkMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, MarkMutantsTest, ::testing::ValuesIn(test::kMarkMutants), name_of_mutant);

TEST_P(MarkMutantsTest, IsCaught) {
    const Model model = test::make_crowd(30);
    const std::vector<std::uint32_t> right =
        test::mark_faces_on_gpu(model);  // held against the CPU by another test
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    EXPECT_NE(test::mark_faces_on_gpu(model), right) << "the broken kernel passes";
}

class TetValueMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, TetValueMutantsTest, ::testing::ValuesIn(test::kTetValueMutants),
                         name_of_mutant);

TEST_P(TetValueMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    const test::Deformed bodies = test::make_deformed();
    bool caught = false;
    for (const Quantity quantity : {Quantity::stretch, Quantity::stress, Quantity::speed}) {
        caught =
            caught || test::worst_value_error(bodies, quantity, test::values_on_gpu(bodies, quantity)) > 1.0;
    }
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class WatchMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, WatchMutantsTest, ::testing::ValuesIn(test::kWatchMutants), name_of_mutant);

TEST_P(WatchMutantsTest, IsCaught) {
    const Model model = test::make_lively_model();
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    for (const test::WatchedRun& run : test::watched_runs(model))
        caught = caught || !test::agree(test::watch_on_gpu(model, run), test::watch_on_cpu(model, run));
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

bool is_wrong_by_depth(const Model& model) {
    return test::find_collisions_on_gpu(model, {.broad_phase = BroadPhase::depth}) !=
           test::find_collisions_on_cpu<float>(model, {});
}

class CollisionMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, CollisionMutantsTest, ::testing::ValuesIn(test::kCollisionMutants),
                         name_of_mutant);

TEST_P(CollisionMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    for (const int objects : {7, 30}) {
        Model model = test::make_crowd(objects, 1);
        test::move_pinned(model, {1.0f, -2.0f, 0.5f});
        for (const CollisionSettings& detection :
             {CollisionSettings{.broad_phase = BroadPhase::boxes}, CollisionSettings{},
              CollisionSettings{.detection = CollisionDetection::continuous}}) {
            caught = caught || test::find_collisions_on_gpu(model, detection, kLongStep) !=
                                   test::find_collisions_on_cpu<float>(model, detection, kLongStep);
        }
        caught = caught || is_wrong_by_depth(model);
        CollisionSettings settings{.friction = 0.4, .restitution = 0.7};
        caught = caught || test::worst_response_error(model, settings, kStep,
                                                      test::respond_on_gpu(model, settings, kStep)) > 1.0;
        settings.detection = CollisionDetection::continuous;
        caught = caught || test::worst_response_error(model, settings, kLongStep,
                                                      test::respond_on_gpu(model, settings, kLongStep)) > 1.0;
    }
    for (const double extent : {2.0, 4.0, 100.0})
        caught = caught || is_wrong_by_depth(test::make_far_pairs(100, extent));
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class DriveMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, DriveMutantsTest, ::testing::ValuesIn(test::kDriveMutants), name_of_mutant);

TEST_P(DriveMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    const Model model = test::make_driven_model();
    bool caught = false;
    for (const double time : {0.3, 1.2}) {
        const auto motions = handle_motions(model.handles, time, kStep);
        caught = caught || test::worst_kinematics_error(model, motions,
                                                        test::apply_kinematics_on_gpu(model, motions)) > 1.0;
    }
    const std::vector<float> factors{0.3f, 0.8f, 0.7f, 1.0f};
    caught = caught || test::worst_load_error(model, factors, test::sum_loads_on_gpu(model, factors)) > 1.0;
    for (const SolverKind solver : {test::kSemiImplicit, SolverKind::rk4}) {
        const test::NodeArrays actual = test::step_on_gpu(model, solver, test::kFused, kStep);
        caught = caught || test::worst_error(model, test::rounding_bounds(model, solver, kStep),
                                             test::oracle_step(model, solver, kStep), actual.positions,
                                             actual.velocities) > 1.0;
    }
    const Model bodies = test::make_bodies_to_descend(0.01, 0.25, MaterialModel::mass_spring, true);
    const test::Descent descent{1.0 / 60.0, {3}};
    caught =
        caught || test::worst_descent_error(bodies, descent, test::descend_on_gpu(bodies, descent)) > 1.0;
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class DescentMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, DescentMutantsTest, ::testing::ValuesIn(test::kDescentMutants), name_of_mutant);

TEST_P(DescentMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    const auto look = [&](const Model& model, const test::Descent& descent) {
        caught =
            caught || test::worst_descent_error(model, descent, test::descend_on_gpu(model, descent)) > 1.0;
    };
    constexpr double kFrame = 1.0 / 60.0;
    for (const double damping : {0.0, 0.01}) look(test::make_bodies_to_descend(damping), {kFrame, {4}});
    for (const double poisson_ratio : {0.1, 0.4})
        look(test::make_bodies_to_descend(0.0, poisson_ratio), {kFrame, {4}});
    const Model model = test::make_bodies_to_descend(0.0);
    look(model, {kFrame, {3}});
    look(model, {kFrame, {5}});
    look(model, {kFrame, {1}, model.velocities});
    look(model, {kFrame, {2}, {}, test::rotated_start(model)});
    caught = caught || test::degenerate_descent_error(1) > 1.0 || test::sliding_descent_error() > 1.0;
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class MatchingMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, MatchingMutantsTest, ::testing::ValuesIn(test::kMatchingMutants),
                         name_of_mutant);

TEST_P(MatchingMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    EXPECT_GT(test::worst_matching_error(), 1.0) << "the broken kernel passes";
}

class NeoHookeanMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, NeoHookeanMutantsTest, ::testing::ValuesIn(test::kNeoHookeanMutants),
                         name_of_mutant);

bool step_of_tets_is_wrong(const Model& model, ForceMethod forces) {
    constexpr SolverKind kSolver = SolverKind::semi_implicit_euler;
    const test::NodeArrays actual = test::step_on_gpu(model, kSolver, forces, kStep);
    return test::worst_error(model, test::rounding_bounds(model, kSolver, kStep),
                             test::oracle_step(model, kSolver, kStep), actual.positions,
                             actual.velocities) > 1.0;
}

bool descent_is_wrong(const Model& model) {
    const test::Descent descent{1.0 / 60.0, {2}};
    return test::worst_descent_error(model, descent, test::descend_on_gpu(model, descent)) > 1.0;
}

// At rest and then set in motion, so that bounds are tight.
Model make_calm_tets(double damping) {
    Material material;
    material.model = MaterialModel::neo_hookean;
    material.damping = damping;
    Model model =
        test::make_model(test::make_body(test::make_block({6, 5, 4}, {0.6, 0.5, 0.4}, 0.2), material));
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        model.velocities[n].x = 0.5f * static_cast<float>(n % 7) - 1.5f;
    return model;
}

TEST_P(NeoHookeanMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    for (const double damping : {0.0, 0.01}) {
        const Model lively = test::make_lively_tets(damping);
        caught = caught || step_of_tets_is_wrong(lively, ForceMethod::fused) ||
                 step_of_tets_is_wrong(lively, ForceMethod::divide_and_merge) ||
                 test::worst_energy_error(lively, test::measure_on_gpu(lively)) > 1.0;
        Model falling = test::make_bodies_to_descend(damping, 0.45, MaterialModel::neo_hookean);
        const Range& point = falling.objects[2].nodes;
        for (std::uint32_t n = point.first; n < point.end(); ++n)
            falling.positions[n] = glm::vec4(0.0f, 1.0f, 1.0f, falling.positions[n].w);
        caught = caught || descent_is_wrong(falling) || descent_is_wrong(make_calm_tets(damping));
    }
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class VolumeTermMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, VolumeTermMutantsTest, ::testing::ValuesIn(test::kVolumeTermMutants),
                         name_of_mutant);

TEST_P(VolumeTermMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    for (const double poisson_ratio : {0.0, 0.45}) {
        Model model = test::make_bodies_to_descend(0.0, poisson_ratio);
        for (glm::vec4& p : model.positions) p.x *= 1.02f;  // no body is at rest
        caught = caught || test::worst_energy_error(model, test::measure_on_gpu(model)) > 1.0 ||
                 step_of_tets_is_wrong(model, ForceMethod::fused) ||
                 step_of_tets_is_wrong(model, ForceMethod::divide_and_merge);
    }
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class SelfCollisionMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, SelfCollisionMutantsTest, ::testing::ValuesIn(test::kSelfCollisionMutants),
                         name_of_mutant);

TEST_P(SelfCollisionMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    for (const test::Deformation deformation : test::kDeformations) {
        const Model model = test::make_folded(deformation);
        std::uint32_t restless = 0;
        std::size_t expected_restless = 0;
        caught = caught || test::find_self_contacts_on_gpu(model, &restless) !=
                               test::find_self_contacts_on_cpu<float>(model, &expected_restless);
        // Calm enough, too: what is needless costs.
        caught = caught || restless > expected_restless + expected_restless / 10 + 3;
    }
    const Model rigid = test::make_folded(test::Deformation::rigid);
    Model moved = rigid;
    for (glm::vec4& p : moved.positions) p.x += 1.0f;
    std::uint32_t fitted = 0;
    test::find_self_contacts_on_gpu_after(rigid, moved, &fitted);
    caught = caught || fitted > 0;  // which costs
    const Model poked = test::make_folded(test::Deformation::poked);
    caught = caught || test::find_self_contacts_on_gpu_after(rigid, poked) !=
                           test::find_self_contacts_on_cpu<float>(poked);
    caught = caught || test::find_self_contacts_on_gpu_after(poked, rigid) !=
                           test::find_self_contacts_on_cpu<float>(rigid);
    const Model rolled = test::make_folded(test::Deformation::rolled);
    const CollisionSettings settings{.friction = 0.4, .restitution = 0.7};
    caught =
        caught || test::worst_self_response_error(
                      rolled, settings, kStep, test::respond_to_self_on_gpu(rolled, settings, kStep)) > 1.0;
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class ProximityMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::Break> {};
INSTANTIATE_TEST_SUITE_P(All, ProximityMutantsTest, ::testing::ValuesIn(test::kProximityMutants),
                         name_of_mutant);

TEST_P(ProximityMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    bool caught = false;
    for (const test::ProximityScene& scene : test::kProximityScenes) {
        if (caught) break;
        const Model model = scene.make();
        const CollisionSettings settings{.self_collision = true, .proximity_radius = scene.radius};
        const test::FoundOnGpu found = test::find_proximities_on_gpu(model, settings);
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& proximity : found.proximities) nearest = std::min(nearest, proximity.distance);
        caught = !found.is_guarded || found.lost_pairs > 0 || found.measure.nearest != nearest ||
                 !test::check_proximities<float>(model, settings, found).are_none();
    }
    EXPECT_TRUE(caught) << "the broken kernel passes";
}

class PullMutantsTest : public test::GlTest, public ::testing::WithParamInterface<test::PullMutant> {};
INSTANTIATE_TEST_SUITE_P(All, PullMutantsTest, ::testing::ValuesIn(test::kPullMutants), name_of_mutant);

TEST_P(PullMutantsTest, IsCaught) {
    test::ShaderFolder folder;
    break_shaders(GetParam(), folder);
    const bool descends = GetParam().solver == SolverKind::vbd;
    const Model model = descends ? test::make_bodies_to_descend(0.01) : test::make_lively_model();
    const double error =
        test::worst_pull_error(model, GetParam().solver, ForceMethod::fused, descends ? 1.0 / 60.0 : kStep);
    EXPECT_GT(error, 1.0) << "the broken kernel passes";
}

}  // namespace
}  // namespace gelatin
