#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "gl/timer.h"
#include "gpu/collision_stages.h"
#include "gpu/drive/apply_kinematics.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/measure/measure.h"
#include "gpu/measure/watch_nodes.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/collision/collision_stages.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// What all solvers in OpenGL share: the nodes, what drives and measures them, and the stages of collision.
/// How nodes move is each one's own: ExplicitSolver, ImplicitSolver. The context in which it was made must be
/// current.
class GpuSolver : public Solver {
public:
    void advance(const Step& step) final;
    void set_pulls(std::vector<Pull> pulls) override;
    void move_pull(std::size_t pull, const glm::dvec3& target) override;
    void set_forces(std::span<const glm::vec3> forces) override;
    void watch_nodes(std::uint32_t step_number, double most_energy) override {
        watch_nodes_.run(buffers_, current_, step_number, most_energy);
    }
    Alarm alarm(bool wait) override { return watch_nodes_.alarm(wait); }
    void begin_measure() override;
    Measurement end_measure() override { return measure_.end(); }
    // No kernel finds forces.
    ContactForces contact_forces() override { return {}; }
    HoldingForces holding_forces() override { return {}; }
    std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> /*places*/) override { return {}; }
    State read_state() override;
    HostNodes host_nodes() const override { return {}; }
    void write_state(const State& state) override;
    StageTimer& stage_timer() override { return timer_; }
    std::string device() const override { return device_; }

    /// The present nodes; another buffer after each step.
    const NodeBuffers& nodes() const { return current_; }
    const ModelBuffers& model_buffers() const { return buffers_; }
    /// Null if nothing can collide.
    const Collision* collision() const { return collision_ ? &*collision_ : nullptr; }
    /// Of the present nodes, for the nodes of Model::face_trees; also where nothing can collide.
    const gl::Buffer<Box>& update_tree_boxes();

protected:
    GpuSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision);

    /// Makes what is left of the step before, where a device was not given all of it at once: before nodes
    /// are read, or anything changes that the step depends on.
    virtual void complete() {}
    virtual void apply_kinematics(const Step& step);
    /// Forces and integration, collisions with colliders included.
    virtual void advance_nodes(const Step& step) = 0;

    /// As Measure has them.
    void set_contact_distances(const std::vector<float>& distances) {
        measure_.set_contact_distances(distances);
    }
    /// Made when they are first needed.
    CollisionStages collision_stages();
    /// Null in models without loads. @return with the step's factors
    SumLoads* loads_of(const Step& step);

    std::shared_ptr<const Model> model_;
    ModelBuffers buffers_;
    NodeBuffers current_, previous_;  // swapped by each step: its end, and its start
    bool has_earlier_ = false;        // previous_ is one step earlier: implicit solvers read it
    gl::TimestampStageTimer timer_;

private:
    std::string device_;
    CollisionSettings settings_;
    CollisionPlan plan_;
    std::optional<Collision> collision_;               // if something can collide, or boxes were requested
    std::optional<ApplyKinematics> apply_kinematics_;  // once a held node moves
    std::optional<SumLoads> sum_loads_;                // if the model has loads
    std::vector<float> whole_loads_;                   // the factors of loads that all act
    WatchNodes watch_nodes_;
    Measure measure_;
};

}  // namespace gelatin::gpu
