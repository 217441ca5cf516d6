#include "bench/stages.h"

#include <algorithm>
#include <numeric>

#include "bench/threads.h"
#include "cpu/explicit/explicit_solver.h"
#include "gpu/explicit/explicit_solver.h"
#include "model/explicit/stability.h"

namespace gelatin {
namespace {

constexpr double kStageSampleTime = 20.0;  // [ms]
constexpr int kMostStageSteps = 200;
constexpr SolverKind kSolver = SolverKind::semi_implicit_euler;

const BenchStage kAdvanceNodes{"advance_nodes",
                               [](StagedSolver& s, double step) { s.advance_nodes({step}); }};
const BenchStage kUpdateBoxes{"update_boxes", [](StagedSolver& s, double) { s.update_boxes(); }};
const BenchStage kFindObjectPairs{"find_object_pairs",
                                  [](StagedSolver& s, double) { s.find_object_pairs(); }};
const BenchStage kFindFaceCollisions{"find_face_collisions",
                                     [](StagedSolver& s, double) { s.find_face_collisions(); }};
const BenchStage kFindSelfCollisions{"find_self_collisions",
                                     [](StagedSolver& s, double) { s.find_self_collisions(); }};
const BenchStage kRespond{"respond", [](StagedSolver& s, double step) { s.respond(step); }};

// @tparam Explicit a backend's ExplicitSolver
template <class Explicit>
class StagesOf final : public StagedSolver, Explicit {
public:
    StagesOf(const std::shared_ptr<const Model>& model, const CollisionSettings& collision)
        : Explicit(model, kSolver, ForceMethod::fused, collision) {}

    Solver& solver() override { return *this; }
    void advance_nodes(const Step& step) override { Explicit::advance_nodes(step); }
    void update_boxes() override { this->collision_stages().update_boxes(this->previous_, this->current_); }
    void find_object_pairs() override { this->collision_stages().find_object_pairs(this->current_); }
    void find_face_collisions() override {
        this->collision_stages().find_face_collisions(this->previous_, this->current_);
    }
    void find_self_collisions() override { this->collision_stages().find_self_collisions(this->current_); }
    void respond(double step) override {
        this->collision_stages().respond(step, this->previous_, this->current_);
    }
};

std::unique_ptr<StagedSolver> make_solver(const std::shared_ptr<const Model>& model,
                                          CollisionSettings collision, bool uses_gl) {
    collision.response = CollisionResponse::restore;
    if (uses_gl) return std::make_unique<StagesOf<gpu::ExplicitSolver>>(model, collision);
    return std::make_unique<StagesOf<cpu::ExplicitSolver<float>>>(model, collision);
}

}  // namespace

std::vector<BenchStage> query_stages() {
    return {kUpdateBoxes, kFindObjectPairs, kFindFaceCollisions};
}
std::vector<BenchStage> step_stages() {
    return {kAdvanceNodes, kUpdateBoxes, kFindObjectPairs, kFindFaceCollisions, kRespond};
}
std::vector<BenchStage> self_stages() {
    return {kAdvanceNodes, kUpdateBoxes, kFindSelfCollisions};
}

std::vector<StageSystem> stage_systems(bool use_gl) {
    std::vector<StageSystem> systems;
    for (const int threads : measured_thread_counts())
        systems.push_back({describe_cpu(threads), false, threads});
    if (use_gl) systems.push_back({"OpenGL", true, 0});
    return systems;
}

StagePlayer::StagePlayer(const std::shared_ptr<const Model>& model, const CollisionSettings& collision,
                         const StageSystem& system, std::vector<BenchStage> stages)
    : system_(system),
      stages_(std::move(stages)),
      staged_(make_solver(model, collision, system.uses_gl)),
      step_(0.5 * largest_stable_step(kSolver, *model)),
      start_(staged_->solver().read_state()) {}

StagePlayer::Trial StagePlayer::try_out() {
    sample(1);
    double ms = 0.0;
    for (const auto& [stage, time] : sample(1)) ms += time;
    return {ms, std::clamp(static_cast<int>(kStageSampleTime / std::max(ms, 1e-3)), 1, kMostStageSteps)};
}

std::map<std::string, double> StagePlayer::sample(int steps) {
    const ThreadLimit limit(system_.threads);
    staged_->solver().write_state(start_);
    StageTimer& timer = staged_->solver().stage_timer();
    for (int s = 0; s < steps; ++s) {
        for (const BenchStage& stage : stages_) {
            timer.begin(stage.name);
            stage.run(*staged_, step_);
            timer.end();
        }
    }
    if (system_.uses_gl) gl::finish();
    std::map<std::string, double> means;
    for (const auto& [stage, times] : timer.take())
        means[stage] = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
    return means;
}

Measurement StagePlayer::measure() {
    staged_->solver().begin_measure();
    return staged_->solver().end_measure();
}

}  // namespace gelatin
