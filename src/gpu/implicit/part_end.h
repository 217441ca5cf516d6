#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "core/stage_timer.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/implicit/step_state.h"
#include "gpu/implicit/step_system.h"
#include "gpu/model_buffers.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The end of a try to make a part of an implicit step, after its system is solved: where nodes are then, and
/// how fast; whether they have gained energy, and so whether the part is made, or has to be made again, which
/// the next try does; colliders, what is owed, and impacts. Bodies that touch each other are an island, by
/// the tables of the system's rows. All decisions are made on the device (StepClock). CPU twins:
/// cpu::ImplicitStep::run, EnergyAccount, Paces, Guard, Restitution, TimeScheme.
///
/// A guard of pairs of surfaces goes between finish() and settle(); with colliders alone run() does it all.
///
/// What it needs of the state where a try is solved: `from`, accelerations; of the clock size, left, step,
/// has_past, goes_on and is_over; of paces past, the body's mass beside the velocity, and of its island
/// is_held; of the system rows, their tables, and slips. A part that is
/// made ends in `from`.
class PartEnd {
public:
    /// @param state, system have to live as long
    /// @param contacts how objects press each other; null: they have no rows with each other
    PartEnd(const Model& model, StepState& state, StepSystem& system,
            const ContactSurface* contacts = nullptr);

    /// After StepSystem::grow.
    void grow();

    /// A step begins: finds the elastic energy of bodies in `from`, which may have been set from outside.
    /// Tries have the barrier for it.
    void begin_step(const ModelBuffers& model) const;
    /// After a solve. @param loads null: the model has none @pre they are those that the solve had
    /// Ends with the barrier for whoever reads the state.
    /// @param timer as of PartStart::run
    void run(const ModelBuffers& model, const SumLoads* loads, StageTimer* timer = nullptr) const;
    /// Its first part: where nodes are wanted, in state.to; and whether the part is made again by Euler's
    /// scheme. Ends with the barrier for whoever moves them as textures or storage.
    void finish(const ModelBuffers& model, const SumLoads* loads) const;
    /// What is left, after a guard has moved nodes in state.to, if it has.
    /// @pre there are contacts, and what has moved them ended with the barrier for textures
    void settle(const ModelBuffers& model) const;

    /// Nodes were set from outside.
    void forget();
    /// The same, but the next step goes on from these nodes and the velocities a step before, whose length
    /// was so much [s].
    void go_on(std::span<const glm::vec4> positions, std::span<const glm::vec4> velocities,
               std::span<const glm::vec4> earlier_velocities, double step);

    /// All that passes from part to part beside nodes. To read it blocks until the device has it, and needs
    /// barrier(buffer_update) since the last dispatch.
    struct Memory {
        std::vector<StepClock> clock;
        std::vector<BodyPace> paces;
        std::vector<glm::vec4> accelerations;
        std::vector<PlaneMemory> planes;
        std::vector<BodyEnergy> energies;
        std::vector<double> meetings, pair_meetings;
    };
    Memory memory() const;
    /// Of the right sizes.
    Memory empty_memory() const;
    /// @pre of these sizes, and barrier(buffer_update) since the last dispatch
    void set_memory(const Memory& memory);

    /// By object; by collider and object, end_sums::kMeeting each; and how many of two objects there are,
    /// with end_sums::kPairMeeting each.
    const gl::Buffer<BodyEnergy>& energies() const { return energies_; }
    const gl::Buffer<double>& meetings() const { return meetings_; }
    const gl::Buffer<double>& pair_meetings() const { return pair_meetings_; }
    /// What settle() has decided, by object; PairRows::remember needs it.
    const gl::Buffer<BodyChange>& changes() const { return changes_; }

private:
    struct Programs {
        Programs(const Model& model, const ContactSurface* contacts);
        std::vector<const gl::Program*> all() const;
        gl::Program sum_motions, finish, keep, sum_velocities, measure, sum_chunks, judge, guard,
            measure_guarded, judge_guarded, stop, settle, commit, find_energies, begin_energies;
        bool has_contacts, has_restitution;   // of objects with each other
        gl::Program tie_bodies, sum_guarded;  // with contacts
        gl::Program press_pairs, meet_pairs;  // with restitution
    };
    void bind_buffers() const;
    void make_room();
    std::vector<double> read_pair_meetings() const;
    void bind_contacts(const gl::Program& program) const;
    void bind_nodes() const;
    void run(const gl::Program& program, std::uint32_t groups) const;
    void end_guarded(const ModelBuffers& model) const;
    void end_part(const ModelBuffers& model) const;

    StepState* state_;
    StepSystem* system_;
    std::uint32_t chunk_count_, object_count_, collider_count_, body_node_count_;
    glm::vec3 gravity_;          // [m/s^2]
    bool has_colliders_;         // else there is nothing to be kept outside
    std::vector<Range> nodes_;   // of objects
    std::vector<float> masses_;  // of nodes
    Programs programs_;
    gl::TexelTable<Spring> springs_;
    gl::TexelTable<glm::uvec4> elements_;
    gl::TexelTable<glm::vec4> node_objects_;
    gl::TexelTable<std::uint32_t> kinds_;  // of objects, and restitutions of two kinds
    gl::TexelTable<float> restitutions_;
    std::uint32_t kind_count_, meeting_capacity_ = 0;
    StepBuffer<BodyMotion> rigid_velocities_;     // by object
    gl::Buffer<double> presses_, pair_meetings_;  // by pair of the tables; of objects
    gl::Buffer<double> finish_sums_, energy_sums_, part_sums_, guard_sums_;  // by chunk
    gl::Buffer<double> pressed_sums_, meetings_;                             // by collider
    gl::Buffer<double> object_sums_, island_sums_;                           // by object
    gl::Buffer<BodyEnergy> energies_;
    gl::Buffer<BodyChange> changes_;
};

}  // namespace gelatin::gpu
