#pragma once

#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/find_pairs.h"
#include "gpu/implicit/pair_buffers.h"
#include "gpu/implicit/pair_guard.h"
#include "gpu/implicit/pair_rows.h"
#include "gpu/implicit/step_state.h"
#include "gpu/implicit/step_system.h"
#include "gpu/model_buffers.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// What contact between bodies, of bodies with themselves, and with surfaces of colliders adds to a try of a
/// part: near pairs of surfaces, their rows in the system, and the guard. The order of a try:
/// PartStart::predict, find(), PartStart::find_rows and linearise, StepSystem::solve, note(),
/// PartEnd::finish, guard(), PartEnd::settle, remember(). CPU twin: cpu::ImplicitStep.
class BodyContacts {
public:
    /// @param own whether bodies meet themselves @param room at first; it grows
    /// @param model, state, system have to live as long
    /// @pre the system's capacity is capacity_of(model, room)
    BodyContacts(const Model& model, const ContactSurface& surface, StepState& state, StepSystem& system,
                 bool own, const PairCapacity& room);

    /// Of the system with so much room for pairs.
    static RowCapacity capacity_of(const Model& model, const PairCapacity& room);

    /// Pairs that may come near each other where nodes go by state.predicted, or in a try with the guard
    /// alone by the paths that it has left. Ends with the barrier for PartStart::find_rows. @param follows as
    /// FindPairs::run has it
    void find(const ModelBuffers& model, bool follows = false) const;
    /// What contacts hold, after the solve.
    void note() const { rows.note(); }
    /// Nodes of state.to, as PartEnd::finish wants them, go as far as nothing crosses; or the next try goes
    /// on with that. Ends with the barrier for PartEnd::settle.
    void guard(const ModelBuffers& model) const;
    /// Where a step begins: takes bodies from state.from to where shapes were put back, state.to, if nothing
    /// is in their way; else they stay. Ends with the barrier for who reads nodes.
    void follow(const ModelBuffers& model) const;
    /// If the part is made, what contacts held in it. @param changes of PartEnd::settle
    void remember(const gl::Buffer<BodyChange>& changes) const { rows.remember(changes); }

    /// For what had no room, when the clock says that a list was full. Blocks until the device has ended its
    /// tries.
    PairCapacity needed() const;
    /// Makes room for so many pairs, after which tries may go on. PartStart::bind_buffers and PartEnd::grow
    /// have to follow.
    void grow(const PairCapacity& capacity);

    /// What contacts exert where the last part that was made has ended. Blocks until the device has ended its
    /// tries.
    ContactForces forces() const;

    PairBuffers pairs;
    FindPairs finder;
    PairRows rows;

private:
    const Model* model_;
    StepState* state_;
    StepSystem* system_;
    PairGuard guard_;
    gl::Program row_forces_, begin_follow_, end_follow_;
};

}  // namespace gelatin::gpu
