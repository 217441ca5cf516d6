#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "attach_tool.h"
#include "gelatin/simulator.h"
#include "gl/fence.h"
#include "pace.h"
#include "picking.h"
#include "readings.h"
#include "scene_source.h"
#include "sim/simulator_internals.h"
#include "worker.h"

namespace gelatin::viewer {

/// A simulation that runs beside the window.
///
/// Steps are made in batches: on a separate thread if the CPU simulates; submitted to the GPU and followed by
/// a fence if the GPU does. While a batch runs, the window draws the result of the previous one, and requests
/// wait until the batch is done. Use it from one thread, with the context current in which it was made.
class Session {
public:
    /// @param earlier continues from its state, at its speed; null: from the start. @pre that is not
    ///   computing
    /// @throws as Simulator
    Session(LoadedScene loaded, Backend backend, const Session* earlier = nullptr);

    /// Once for each picture: takes the results of a batch and starts the next. Never waits for the
    /// simulation.
    /// @param now real time [s]. @return true if there is something new to draw
    bool update(double now);

    void play(bool is_playing);
    bool is_playing() const { return is_playing_; }
    /// Makes steps while paused; many, in several batches.
    void make_steps(int count) { steps_asked_ += count; }
    void reset();
    /// What it plays; null: it simulates.
    const Recording* recording() const { return simulator_.recording(); }
    /// Shows a frame of the recording, once the running batch is done. @param index in the recording
    void show_recorded(std::size_t index) { index_asked_ = index; }
    void set_speed(double speed) { pace_.set_speed(speed); }
    const Pace& pace() const { return pace_; }
    void show(const Overlays& overlays);

    /// Starts a pull at the body that the ray meets first, if it meets any, once the running batch is done.
    void reach(const Ray& ray);
    enum class Hand { free, reaching, holding };
    Hand hand() const { return hand_; }
    /// The point where the pull holds the body [m]. @pre it holds something
    const glm::vec3& held_point() const { return held_point_; }
    void move_hand(const glm::vec3& target) { hand_target_ = target; }
    /// Ends the pull; the body keeps its momentum.
    void let_go();
    /// The region that would be pinned, and one of its nodes. @pre a pull holds something
    SphereRegion held_region() const { return region_of(pull_, model()); }
    std::uint32_t held_node() const { return pull_.nodes.front().node; }

    /// What pins and handles hold, as of the last completed batch.
    const std::vector<HeldNodes>& held_nodes() const { return held_nodes_; }
    /// Drags one of them to a target, from the next batch on.
    void drag(std::size_t held, const Drag& target);

    /// Attaches by two clicks; each takes effect once the running batch is done.
    AttachTool& attach_tool() { return attach_tool_; }
    const AttachTool& attach_tool() const { return attach_tool_; }
    /// In the order of scene().attachments, as of the last completed batch; empty for recordings.
    const std::vector<AttachmentStatus>& attachments() const { return attachments_; }
    /// Breaks an attachment, from the next batch on.
    void detach(std::size_t attachment) { detached_.push_back(attachment); }
    /// What the motor of a joint does, from the next batch on.
    void set_motor(std::size_t attachment, const JointMotor& motor) { motors_asked_[attachment] = motor; }
    /// What it does at present; empty: the joint has none.
    std::optional<JointMotor> motor(std::size_t attachment) const;
    /// By object, as of the last completed batch.
    const std::vector<CavityStatus>& cavities() const { return cavities_; }
    /// The gas of a cavity, from the next batch on.
    void set_cavity(std::size_t cavity, const CavityGas& gas) { gas_asked_[cavity] = gas; }
    /// What it has at present.
    CavityGas cavity_gas(std::size_t cavity) const;
    /// Puts what was set here into a scene of the same objects, in place of keyframes.
    void save_gas(Scene& scene) const;
    /// The scene's own attachments with their present motors, then those that were made here and are not
    /// broken, where their points are at the start.
    std::vector<AttachmentDescription> attachments_to_save() const;
    /// What was made, and why something could not be, since the last call; empty if there is nothing.
    std::string take_news() { return std::exchange(news_, {}); }
    std::string take_refusal() { return std::exchange(refusal_, {}); }

    /// True while a batch is running: the simulator must not be accessed.
    bool is_computing() const { return worker_.is_busy() || !fence_.is_passed(); }

    /// True while there is something to wait for.
    bool is_busy() const { return is_playing_ || steps_asked_ > 0 || is_computing(); }

    /// As of the last completed batch.
    double time() const { return time_; }
    int frame() const { return frame_; }
    std::size_t index() const { return index_; }  ///< of the frame in the recording; 0 without one
    const RenderView& view() const { return view_; }
    const Readings& readings() const { return readings_; }
    /// The error that stopped it; empty if there is none. reset() continues.
    const std::string& problem() const { return problem_; }

    const std::string& device() const { return device_; }

    /// Constant properties.
    const Scene& scene() const { return simulator_.scene(); }
    /// Without the attachments that were made here.
    Scene own_scene() const;
    const Model& model() const { return model_of(simulator_); }
    /// @pre !is_computing(), for properties that change
    const Simulator& simulator() const { return simulator_; }

private:
    void take_over();
    void go_back();
    void follow_recording();
    void follow_hand();
    void follow_drags();
    void follow_attachments();
    void follow_cavities();
    void change_attachments();
    void start_batch(int steps, double now);
    void run_batch(int steps, bool measure);
    void fail(const std::string& problem);

    Simulator simulator_;
    std::string device_;
    Pace pace_;
    Readings readings_;
    RenderView view_;
    Overlays overlays_;
    bool is_playing_ = true;
    bool is_reset_asked_ = false;
    bool is_view_old_ = true;
    int steps_asked_ = 0;
    Hand hand_ = Hand::free;
    bool is_pulled_ = false;  // the simulator knows of a hand
    Ray reach_{};
    Pull pull_;
    std::vector<HeldNodes> held_nodes_;
    std::vector<std::pair<std::size_t, Drag>> drags_asked_;
    AttachTool attach_tool_;
    std::vector<AttachmentStatus> attachments_;
    std::size_t own_attachments_;  // of the scene; the others were made here
    std::vector<std::size_t> detached_;
    std::map<std::size_t, JointMotor> motors_, motors_asked_;  // that were set here
    std::vector<CavityStatus> cavities_;
    std::map<std::size_t, CavityGas> gas_, gas_asked_;  // that were set here
    std::string news_, refusal_;
    glm::vec3 held_point_{0.0f}, hand_target_{0.0f};
    double last_update_ = 0.0, last_measure_ = -1.0;  // [s]
    double time_ = 0.0;
    int frame_ = 0;
    std::size_t index_ = 0;
    std::optional<std::size_t> index_asked_;
    std::string problem_;
    std::vector<FrameStatistics> measured_;  // of the running batch
    gl::Fence fence_;                        // of the batch, if the GPU simulates
    Worker worker_;                          // last: its thread uses the others
};

}  // namespace gelatin::viewer
