#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "gl/timer.h"
#include "gpu/collision_stages.h"
#include "gpu/descent/block_descent.h"
#include "gpu/descent/match_shapes.h"
#include "gpu/drive/apply_kinematics.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/explicit/advance_nodes.h"
#include "gpu/explicit/divide_and_merge.h"
#include "gpu/explicit/find_volume_stresses.h"
#include "gpu/measure/measure.h"
#include "gpu/measure/watch_nodes.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// The solver in OpenGL compute shaders. The context in which it was made must be current.
class GpuSolver : public Solver {
public:
    GpuSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
              const CollisionSettings& collision = {}, const DescentSettings& descent = {});

    void apply_kinematics(std::span<const HandleMotion> motions) override;
    void set_load_factors(std::span<const float> factors) override { sum_loads_->set_factors(factors); }
    void set_pulls(std::vector<Pull> pulls) override { buffers_.pulls.set_pulls(std::move(pulls)); }
    void move_pull(std::size_t pull, const glm::dvec3& target) override {
        buffers_.pulls.move_pull(pull, target);
    }
    void set_forces(std::span<const glm::vec3> forces) override { buffers_.pulls.set_forces(forces); }
    void advance_nodes(double step) override;
    void update_boxes() override;
    void find_object_pairs() override;
    void find_face_collisions() override;
    void find_self_collisions() override;
    void find_proximities() override;
    void respond(double step) override;
    void watch_nodes(std::uint32_t step_number, double most_energy) override {
        watch_nodes_.run(buffers_, current_, step_number, most_energy);
    }
    Alarm alarm(bool wait) override { return watch_nodes_.alarm(wait); }
    void begin_measure() override;
    std::uint32_t lost_pairs() const override { return measure_.lost_pairs(); }
    ProximityMeasure proximities() const override { return measure_.proximities(); }
    std::vector<ObjectMeasure> end_measure() override { return measure_.end(); }
    State read_state() const override;
    void write_state(const State& state) override;
    StageTimer& stage_timer() override { return timer_; }
    std::string device() const override { return device_; }

    /// The present nodes; another buffer after each step.
    const NodeBuffers& nodes() const { return current_; }
    const ModelBuffers& model_buffers() const { return buffers_; }
    /// @pre the scene has collisions, of two objects or of one with itself, or update_boxes was called
    const Collision& collision() const { return *collision_; }
    bool has_collision() const { return collision_.has_value(); }

protected:
    /// What a step has led to that was made elsewhere: instead of advance_nodes.
    void take_step(std::span<const glm::vec4> positions, std::span<const glm::vec4> velocities);

private:
    // Vertex block descent, and what gives bodies their shape back before it.
    struct Descent {
        BlockDescent solver;
        ShapeMatcher shape_matcher;
    };
    // What moves the nodes: an explicit scheme in one kernel or in the paper's three, or block descent.
    // None where steps are made elsewhere.
    using Integrator = std::variant<std::monostate, AdvanceNodes, DivideAndMerge, Descent>;
    static Integrator make_integrator(const Model& model, const ExplicitScheme& scheme, SolverKind solver,
                                      ForceMethod forces, const CollisionSettings& collision,
                                      const DescentSettings& descent);
    void descend(Descent& descent, double step);
    void run_scheme(double step);

    std::shared_ptr<const Model> model_;
    std::string device_;
    ExplicitScheme scheme_;
    CollisionSettings collision_settings_;
    ModelBuffers buffers_;
    NodeBuffers current_, previous_;  // swapped by each step: its end, and its start
    NodeBuffers stage_[2], sums_;     // between the passes of one step
    Integrator integrator_;
    bool has_earlier_ = false;                                // previous_ is one step earlier
    std::optional<ApplyKinematics> apply_kinematics_;         // once a held node moves
    std::optional<SumLoads> sum_loads_;                       // if the model has loads
    std::optional<FindVolumeStresses> find_volume_stresses_;  // if an explicit scheme needs them
    std::optional<Collision> collision_;  // if something can collide, or boxes were requested
    WatchNodes watch_nodes_;
    Measure measure_;
    gl::TimestampStageTimer timer_;
};

}  // namespace gelatin::gpu
