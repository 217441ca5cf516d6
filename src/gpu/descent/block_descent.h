#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/stage_timer.h"
#include "gl/program.h"
#include "gpu/descent/coarse_correction.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/descent/descent_rows.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Vertex block descent: shaders/sim/descent/start_descent.comp, take_back_tangled.comp,
/// damp_springs.comp, mark_flat_tets.comp,
/// find_pressures.comp, descend.comp, sum_rigid_motions.comp, move_bodies.comp. CPU twin: cpu::BlockDescent.
class BlockDescent {
public:
    BlockDescent(const Model& model, const DescentSettings& settings);

    /// A step of `step` seconds from `previous`; writes `current`. Ends with the barrier that whoever gathers
    /// the nodes as textures or storage needs.
    /// @param loads of this step; null in models without
    /// @param current's velocities are those one step before `previous` if `has_earlier`, else not looked at
    /// @param timer of the parts of the step, with the names that cpu::BlockDescent has; null: none
    void run(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
             const NodeBuffers& current, double step, bool has_earlier, StageTimer* timer = nullptr);

private:
    // What the volume term needs, in models that have one.
    struct Pressures {
        Pressures(const Model& model, std::span<const std::uint32_t> rows);

        gl::Program node_program, tet_program;
        gl::TexelTable<glm::vec2> node_volumes;  // [m^3], [Pa]
        gl::TexelTable<std::uint32_t> node_tet_starts, node_tets;
        gl::TexelTable<VolumeStep> strips;
        gl::TexelTable<std::uint32_t> strip_starts;
        gl::Buffer<float> ratios, node_pressures, offsets;
        gl::BufferTexture offset_texels;
    };

    // Springs with their dampers in them, anew in each step.
    struct DampedSprings {
        explicit DampedSprings(std::size_t pairs);

        gl::Program program;
        gl::Buffer<glm::vec4> springs;
        gl::BufferTexture texels;
    };

    void make_coarse_level(const Model& model);
    std::vector<const gl::Program*> sweep_programs() const;
    void bind_buffers() const;
    void bind_springs(const gl::Program& program) const;
    void bind_pressures(const Pressures& pressures) const;
    void bind_nodes(const NodeBuffers& previous, const NodeBuffers& current) const;
    void damp_springs(double step) const;
    void take_back_tangled() const;
    void mark_flat_tets(std::uint32_t mark) const;
    void sweep() const;
    void descend(const gl::Program& program, std::span<const Range> rows) const;
    void correct(const NodeBuffers& current, double step);
    void move_bodies(bool is_last) const;

    gl::Program start_program_, find_tangled_program_, take_back_program_, mark_program_, sweep_program_,
        sum_program_, motion_program_, move_program_, last_move_program_;
    DescentSettings settings_;
    std::uint32_t node_count_, tet_count_, object_count_, row_count_;
    std::optional<Pressures> pressures_;
    std::optional<DampedSprings> damped_springs_;  // where the model has dampers
    std::vector<Range> colors_;                    // rows
    gl::TexelTable<DescentRow> rows_;
    NeoHookeanBuffers neo_hookean_;
    gl::TexelTable<glm::uvec2> spring_ends_;  // of pairs of half springs
    gl::TexelTable<glm::vec4> springs_;       // of each its rest length [m], stiffness [N/m]
    gl::TexelTable<std::uint32_t> spring_starts_;
    gl::TexelTable<TetCorner> tet_corners_;
    gl::TexelTable<std::uint32_t> corner_starts_;
    gl::TexelTable<glm::uvec4> tets_;
    gl::TexelTable<glm::vec4> tet_rests_;  // volume [m^3], modulus [Pa], stiffness of the volume term [Pa]
    gl::Buffer<Chunk> chunks_;
    gl::TexelTable<std::uint32_t> chunk_starts_, node_objects_;  // by object; by node
    gl::Buffer<glm::vec4> starts_;   // xyz, outside colliders [m], damping time [s]
    gl::Buffer<glm::vec4> targets_;  // y [m], m / h^2 [N/m]
    gl::Buffer<std::uint32_t> near_flat_, object_contacts_, is_tangled_;
    gl::BufferTexture start_texels_, target_texels_, near_flat_texels_;
    gl::Buffer<ColliderContact> contacts_;  // of nodes in the last sweep; empty without colliders
    gl::Buffer<glm::dvec4> rigid_sums_;
    gl::Buffer<RigidMotion> motions_;
    std::optional<CoarseCorrection> coarse_;  // where there are clusters
    gl::Program force_program_;               // with it
};

}  // namespace gelatin::gpu
