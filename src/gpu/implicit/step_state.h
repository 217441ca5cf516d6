#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/step_buffers.h"
#include "gpu/implicit/tries.h"
#include "gpu/node_buffers.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::gpu {

/// What an implicit step knows on the device, from part to part, and passes on from stage to stage. Each
/// buffer is known by the name of its block and that of its sampler in shaders/sim/implicit/.
class StepState {
public:
    StepState(const Model& model, const ContactSurface& surface);

    /// Bodies begin to rest anew: nodes were set from outside.
    void wake();
    /// What the program's source names; but for what is bound to it by another name.
    void bind(const gl::Program& program) const;

    NodeBuffers from, to;  ///< where a part begins, and ends
    Tries tries;
    StepBuffer<BodyPace> paces;   ///< by object: Paces, paces
    StepBuffer<glm::vec4> goals;  ///< where handles have held nodes at the end of the step [m]: Goals, goals
    /// By how much velocities of held nodes have changed since the step before [m/s]: HeldChanges. By node.
    StepBuffer<glm::vec4> held_changes;
    /// Displacements without forces of elements and contacts [m]; w: 1 / h of contacts, 0 of held nodes
    /// [m/N]: Predicted, predicted. By node, as are goals.
    StepBuffer<glm::vec4> predicted;
    StepBuffer<glm::vec4>
        accelerations;             ///< a_0 of TimeScheme [m/s^2], by node: Accelerations, accelerations
    gl::Buffer<RestState> rest;    ///< one; block Rest, rest[0]
    gl::Buffer<glm::vec4> places;  ///< that nodes keep to while bodies rest [m]; w: inverse mass: Places
    /// Of contacts with planes, by collider and then by nodes of bodies: what was passed on, and what this
    /// part passes on if it is made: PlaneMemories and PlaneNotes.
    gl::Buffer<PlaneMemory> plane_memories, plane_notes;

private:
    gl::TexelTable<float> stiffness_, thicknesses_;  // ContactSurface's: node_stiffness, thicknesses
    gl::TexelTable<float> masses_;                   // of nodes: masses [kg]
    gl::TexelTable<float> rest_distances_;           // of nodes from their places, at most [m]
    std::uint32_t body_count_, body_nodes_;
};

}  // namespace gelatin::gpu
