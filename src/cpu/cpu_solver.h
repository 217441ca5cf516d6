#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "cpu/collision/collision.h"
#include "cpu/collision/contact.h"
#include "cpu/collision/find_self_collisions.h"
#include "cpu/collision/respond_to_self.h"
#include "cpu/descent/block_descent.h"
#include "cpu/descent/match_shapes.h"
#include "cpu/drive/pulls.h"
#include "cpu/explicit/advance_nodes.h"
#include "cpu/nodes.h"
#include "cpu/proximity/find_proximities.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// The solver on the processor. `double` is the reference for the tests of every kernel. `float`, with SIMD
/// and all cores, is the CPU backend. The same bits for any number of threads.
template <class Real>
class CpuSolver : public Solver {
public:
    /// @param device that makes the sweeps of bodies with contacts; null: the host makes them; must outlive
    /// this
    CpuSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
              const CollisionSettings& collision = {}, const DescentSettings& descent = {},
              DeviceSweeps* device = nullptr);

    void apply_kinematics(std::span<const HandleMotion> motions) override;
    void set_load_factors(std::span<const float> factors) override;
    void set_pulls(std::vector<Pull> pulls) override;
    void move_pull(std::size_t pull, const glm::dvec3& target) override { pulls_.move_pull(pull, target); }
    void set_forces(std::span<const glm::vec3> forces) override;
    void advance_nodes(double step) override;
    void update_boxes() override { collision_.update_boxes(current_.positions, previous_.positions); }
    void find_object_pairs() override { collision_.find_object_pairs(); }
    void find_face_collisions() override {
        collision_.find_face_collisions(current_.positions, previous_.positions);
    }
    void find_self_collisions() override { self_->collision.run(current_.positions); }
    void find_proximities() override { proximities_->run(current_.positions); }
    void respond(double step) override;
    void watch_nodes(std::uint32_t step_number, double most_energy) override;
    Alarm alarm(bool /*wait*/) override { return alarm_; }
    void begin_measure() override;
    std::vector<ObjectMeasure> end_measure() override;
    std::uint32_t lost_pairs() const override { return 0; }
    ProximityMeasure proximities() const override { return measured_proximities_; }
    ContactForces contact_forces() const override;
    HoldingForces holding_forces() const override;
    std::vector<std::uint32_t> held_up(std::span<const HandlePose> poses) const override;
    State read_state() const override;
    std::span<const glm::vec4> host_positions() const override;
    std::span<const glm::vec4> host_velocities() const override;
    void write_state(const State& state) override;
    StageTimer& stage_timer() override { return timer_; }
    std::string device() const override;

    /// The nodes in full precision.
    const Nodes<Real>& nodes() const { return current_; }
    const Collision<Real>& collision() const { return collision_; }
    /// True if a face touches another object, or another part of its own.
    bool collides(std::uint32_t face) const;

private:
    void sum_loads(const Nodes<Real>& nodes);
    void add_pulls(const Nodes<Real>& nodes, Real step);
    void clear_pulled_forces();
    const Pulls<Real>* acting_pulls() const { return pulls_.nodes().empty() ? nullptr : &pulls_; }
    void find_volume_stresses(const Nodes<Real>& nodes);
    void run_pass(const Pass<Real>& pass);
    void run_scheme(double step);

    // Vertex block descent, and what gives bodies their shape back before it.
    struct Descent {
        BlockDescent<Real> solver;
        ShapeMatcher<Real> shape_matcher;
    };
    void descend(Descent& descent, double step);

    std::shared_ptr<const Model> model_;
    ExplicitScheme scheme_;
    ForceMethod forces_;
    std::optional<Descent> descent_;  // instead of the scheme
    Nodes<Real> current_, previous_;  // swapped by each step: its end, and its start
    bool has_earlier_ = false;        // previous_ is one step earlier
    Nodes<Real> stage_[2];            // between the passes of one step
    Nodes<Real> sums_;
    std::vector<Vec4<Real>> spring_forces_, node_forces_;
    double step_ = 0.0;                     // the last one [s]
    std::vector<glm::dvec3> held_changes_;  // of handle nodes' velocities as it began [m/s]
    std::vector<float> load_factors_;
    std::vector<Vec4<Real>> load_forces_;  // [N], shape [nodes]; empty without loads
    Pulls<Real> pulls_;
    TetBlocks pass_tets_;                // in float, for explicit schemes
    std::vector<Real> volume_stresses_;  // [Pa], shape [nodes]; empty if no explicit scheme needs them
    Collision<Real> collision_;
    ContactProperties contact_;
    struct SelfStages {
        FindSelfCollisions<Real> collision;
        RespondToSelf<Real> response;
    };
    std::unique_ptr<SelfStages> self_;
    std::optional<FindProximities<Real>> proximities_;
    Alarm alarm_ = kNoAlarm;
    struct Measured {
        std::vector<ObjectMeasure> objects;
        ProximityMeasure proximities;
    };
    std::deque<Measured> measures_;
    ProximityMeasure measured_proximities_;
    HostStageTimer timer_;
};

}  // namespace gelatin::cpu
