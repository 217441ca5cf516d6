#pragma once

#include <deque>
#include <memory>
#include <utility>

#include "cpu/collision_stages.h"
#include "cpu/drive/pulls.h"
#include "cpu/nodes.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// What all solvers on the processor share: the nodes, what drives and measures them, and the stages of
/// collision. How nodes move is each one's own: ExplicitSolver, ImplicitSolver. `double` is the reference for
/// the tests of every kernel. `float`, with SIMD and all cores, is the CPU backend. The same bits for any
/// number of threads.
template <class Real>
class CpuSolver : public Solver {
public:
    void advance(const Step& step) final;
    void set_pulls(std::vector<Pull> pulls) override { pulls_.set_pulls(std::move(pulls)); }
    void move_pull(std::size_t pull, const glm::dvec3& target) override { pulls_.move_pull(pull, target); }
    void set_forces(std::span<const glm::vec3> forces) override { pulls_.set_forces(forces); }
    void watch_nodes(std::uint32_t step_number, double most_energy) override;
    Alarm alarm(bool /*wait*/) override { return alarm_; }
    void begin_measure() override;
    Measurement end_measure() override;
    State read_state() override;
    HostNodes host_nodes() const override;
    void write_state(const State& state) override;
    StageTimer& stage_timer() override { return timer_; }
    std::string device() const override;

    /// The nodes in full precision.
    const Nodes<Real>& nodes() const { return current_; }
    /// True if a face touches another object, or another part of its own.
    bool collides(std::uint32_t face) const { return collision_ && collision_->collides(face); }
    /// Of the present nodes, for the nodes of Model::face_trees; also where nothing can collide.
    const std::vector<AxisBox<Real>>& update_tree_boxes();

protected:
    CpuSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision);

    virtual void apply_kinematics(const Step& step);
    /// Forces and integration, collisions with colliders included.
    virtual void advance_nodes(const Step& step) = 0;

    /// Whether nodes are changed after each step, where faces collide.
    bool has_response() const { return plan_.has_response(); }
    /// Made when they are first needed.
    CollisionStages<Real>& collision_stages();
    std::span<const float> load_factors(const Step& step) const {
        return step.load_factors.empty() ? std::span(whole_loads_) : step.load_factors;
    }
    /// Into load_forces_, where there are loads.
    void sum_loads(const Step& step, const Nodes<Real>& nodes);
    const Pulls<Real>* acting_pulls() const { return pulls_.nodes().empty() ? nullptr : &pulls_; }

    std::shared_ptr<const Model> model_;
    Nodes<Real> current_, previous_;       // swapped by each step: its end, and its start
    bool has_earlier_ = false;             // previous_ is one step earlier: implicit solvers read it
    std::vector<Vec4<Real>> load_forces_;  // [N], shape [nodes]; empty without loads
    Pulls<Real> pulls_;
    HostStageTimer timer_;

private:
    CollisionSettings settings_;
    CollisionPlan plan_;
    std::vector<float> whole_loads_;                    // the factors of loads that all act
    std::unique_ptr<CollisionStages<Real>> collision_;  // if something can collide, or boxes were requested
    Alarm alarm_ = kNoAlarm;
    std::deque<Measurement> measures_;
};

}  // namespace gelatin::cpu
