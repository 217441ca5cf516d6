#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/pair_buffers.h"
#include "gpu/implicit/step_state.h"
#include "gpu/implicit/step_system.h"
#include "gpu/model_buffers.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The rows of near pairs: of PartStart, where bodies touch each other. Islands, and the tables of the
/// system, with rows of planes among them, as make_row_tables() has them, but that an island has the number
/// of its first body. Nothing is read back. CPU twins: cpu::ContactRows, cpu::Islands, cpu::Paces.
class PairRows {
public:
    /// @param state, pairs have to live as long, as has what the system owns
    /// @pre the system's capacity has a pair for each body and each slot
    PairRows(const Model& model, const ContactSurface& surface, StepState& state, StepSystem& system,
             const PairBuffers& pairs);

    /// After PairBuffers::grow and StepSystem::grow. What contacts held is known further on.
    void grow();

    /// @name Stages of PartStart::run
    /// Each ends with the barrier for who reads what it has made.
    /// @{
    void weigh(const ModelBuffers& model);  ///< which pairs have rows
    /// Where rows go, when planes are counted, too, and those of pairs. Or the try is given up.
    /// @param has_forces whether loads or hands act
    void place(bool has_forces) const;
    void sort() const;  ///< when those of planes are made, too
    /// @}

    /// Of each object the least one with which it is connected by near pairs: for the guard, when pairs are
    /// found. Ends with the barrier for who reads it. @param labels output, shape [objects]
    void find_guard_islands(const gl::Buffer<std::uint32_t>& labels) const;
    /// What contacts hold, after a solve.
    void note() const;
    /// If the part is made, that is what they held before. Ends with the barrier for the next part.
    /// @param changes of bodies, as PartEnd has settled them
    void remember(const gl::Buffer<BodyChange>& changes) const;

    /// What contacts held when the last part was made: for other buffers of the same model.
    struct Memory {
        std::vector<std::uint32_t> starts, entries;  ///< by node: 4 row + place
        std::vector<RowMemory> rows;
    };
    Memory memory() const;  ///< blocks
    /// @pre the capacity of rows is enough for it
    void set_memory(const Memory& memory);
    void forget();

    /// For programs of PartStart that are made with PAIRS.
    void bind(const gl::Program& program) const;
    std::vector<const gl::Program*> programs() const;  ///< that PartStart binds its own buffers to

private:
    struct Programs {
        Programs();
        std::vector<const gl::Program*> all() const;
        gl::Program weigh, count_slot_rows, label, label_all, order, place, place_slot_rows, couple,
            sum_islands, count_entries, start_entries, make, sort, note, remember;
    };
    void make_room();
    void bind_buffers() const;
    void bind_tables(const gl::Program& program) const;
    void run(const gl::Program& program, std::size_t groups) const;

    std::uint32_t node_count_, body_count_, collider_count_, chunk_count_, kind_count_;
    StepState& state_;
    const StepSystem& system_;
    const PairBuffers& pairs_;
    Programs programs_;
    gl::TexelTable<std::uint32_t> kinds_, node_face_starts_, node_faces_;
    gl::TexelTable<glm::vec2> touches_;  // of two kinds: friction, stiffness
    gl::TexelTable<glm::uvec2> across_, beside_edges_;
    gl::TexelTable<glm::vec4> rest_positions_, surface_velocities_;
    StepBuffer<PairWeight> pair_weights_;
    StepBuffer<SlotRows> slot_rows_;
    StepBuffer<RowPlace> row_places_;  // of bodies with planes, and of slots
    StepBuffer<BodyTouch> body_touches_;
    StepBuffer<BodyPlace> body_places_;
    StepBuffer<StartSums> body_starts_;
    StepBuffer<std::uint32_t> labels_;  // of each body the least one of its island
    StepBuffer<std::uint32_t> chunk_entries_;
    gl::Buffer<std::uint32_t> entry_counts_;  // of nodes; then where the next one goes
    gl::Buffer<RowMemory> row_notes_;
    StepBuffer<std::uint32_t> known_starts_, known_entries_;  // of the last part that was made
    StepBuffer<RowMemory> known_rows_;
};

}  // namespace gelatin::gpu
