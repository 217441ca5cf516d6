#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gl/program.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/descent/descent_rows.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The sum of elements that a step of block descent minimises, as tables that descend.comp gathers from:
/// inertia, springs and tets; and their parts that change within a step, by damp_springs.comp,
/// mark_flat_tets.comp and find_pressures.comp. CPU twin: cpu::StepObjective.
class StepObjective {
public:
    explicit StepObjective(const Model& model);

    gl::Buffer<glm::vec4> starts;   ///< xyz, outside colliders, when the step began [m], damping time [s]
    gl::Buffer<glm::vec4> targets;  ///< y [m], m / h^2 [N/m], 0 where a node is held
    gl::BufferTexture start_texels, target_texels;
    gl::Buffer<std::uint32_t>
        near_flat;  ///< of nodes, the number of the update that found a flat tet; 0 at the start
    gl::TexelTable<glm::uvec4> tets;
    gl::TexelTable<glm::vec4> tet_rests;  ///< volume [m^3], modulus [Pa], stiffness of the volume term [Pa]

    /// What a program of descend.comp is compiled with, for the elements that a model has.
    static gl::Defines defines(const Model& model);
    /// Binds such a program to all that does not change.
    void bind(const gl::Program& program) const;

    const std::vector<Range>& colors() const { return colors_; }  ///< rows
    std::uint32_t row_count() const { return row_count_; }

    /// To be called when starts and targets are those of a step of `step` seconds.
    void begin(const NodeBuffers& previous, const NodeBuffers& current, double step);

    /// Finds which tets are flat, for the programs that gather them.
    void update(TetUpdate update, std::span<const gl::Program* const> programs);

private:
    // What the volume term needs, in models that have one.
    struct Pressures {
        Pressures(const Model& model, std::span<const std::uint32_t> rows);

        gl::Program node_program, tet_program;
        gl::TexelTable<glm::vec2> node_volumes;  // [m^3], [Pa]
        gl::TexelTable<std::uint32_t> share_starts;
        gl::TexelTable<glm::uvec4> volume_shares;
        gl::TexelTable<VolumeStep> strips;
        gl::TexelTable<std::uint32_t> strip_starts;
        gl::Buffer<float> ratios, node_pressures, offsets;
        gl::BufferTexture ratio_texels, node_pressure_texels, offset_texels;
    };

    // Springs with their dampers in them, anew in each step.
    struct DampedSprings {
        explicit DampedSprings(std::size_t pairs);

        gl::Program program;
        gl::Buffer<glm::vec4> springs;
        gl::BufferTexture texels;
    };

    void bind_springs(const gl::Program& program) const;
    void bind_pressures() const;

    gl::Program mark_program_;
    std::uint32_t node_count_, tet_count_, row_count_;
    std::uint32_t mark_ = 0;  // number of the last update in this step
    std::optional<Pressures> pressures_;
    std::optional<DampedSprings> damped_springs_;  // where the model has dampers
    std::vector<Range> colors_;
    gl::TexelTable<DescentRow> rows_;
    NeoHookeanBuffers neo_hookean_;
    gl::TexelTable<glm::uvec2> spring_ends_;  // of pairs of half springs
    gl::TexelTable<glm::vec4> springs_;       // of each its rest length [m], stiffness [N/m]
    gl::TexelTable<std::uint32_t> spring_starts_;
    gl::TexelTable<TetCorner> tet_corners_;
    gl::TexelTable<std::uint32_t> corner_starts_;
    gl::BufferTexture near_flat_texels_;
};

}  // namespace gelatin::gpu
