#include "gpu/block_descent.h"

#include <algorithm>
#include <numeric>

#include "gpu/chunks.h"
#include "model/node_colors.h"
#include "model/node_tets.h"
#include "model/spring_packing.h"

namespace gelatin::gpu {
namespace {

constexpr int kSweepsAMotion = 2;

gl::Defines sweep_defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (model.has_damping()) defines.emplace_back("DAMPED");
    if (!model.neo_hookean_tets.empty()) defines.emplace_back("NEO_HOOKEAN");
    return defines;
}

// No buffer is empty.
template <class T>
gl::Buffer<T> make_buffer(std::vector<T> values, const T& padding) {
    if (values.empty()) values.push_back(padding);
    return gl::Buffer<T>(std::span<const T>(values));
}

std::vector<glm::vec2> rests_of(const Model& model) {
    std::vector<glm::vec2> rests;
    for (const TetRest& rest : model.tet_rests) rests.emplace_back(rest.volume, rest.modulus);
    return rests;
}

std::vector<std::uint32_t> find_pinned_objects(const Model& model) {
    std::vector<std::uint32_t> pinned;
    for (const ModelObject& object : model.objects) {
        const auto first = model.positions.begin() + object.nodes.first;
        pinned.push_back(
            std::any_of(first, first + object.nodes.count, [](const glm::vec4& p) { return p.w == 0.0f; }));
    }
    return pinned;
}

std::vector<glm::uvec2> with_objects(const Model& model, const std::vector<std::uint32_t>& rows) {
    std::vector<std::uint32_t> objects(model.node_count(), 0);
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const Range& nodes = model.objects[o].nodes;
        std::fill_n(objects.begin() + nodes.first, nodes.count, o);
    }
    std::vector<glm::uvec2> result;
    for (const std::uint32_t n : rows) result.emplace_back(n, n == kNoNode ? 0 : objects[n]);
    return result;
}

}  // namespace

BlockDescent::BlockDescent(const Model& model, int iterations)
    : start_program_(gl::Program::compute("sim/start_descent.comp")),
      mark_program_(gl::Program::compute("sim/mark_flat_tets.comp")),
      sweep_program_(gl::Program::compute("sim/descend.comp", sweep_defines(model))),
      sum_program_(gl::Program::compute("sim/sum_rigid_motions.comp")),
      motion_program_(gl::Program::compute("sim/sum_rigid_motions.comp", {"OBJECTS"})),
      move_program_(gl::Program::compute("sim/move_bodies.comp")),
      last_move_program_(gl::Program::compute("sim/move_bodies.comp", {"LAST"})),
      iterations_(iterations),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      near_flat_(model.positions.size()),
      object_touches_(model.objects.size()),
      motions_(model.objects.size()) {
    std::vector<std::uint32_t> rows;
    const NodeColors colors = color_nodes(model);
    for (std::uint32_t c = 0; c < colors.count(); ++c) {
        const auto first = static_cast<std::uint32_t>(rows.size());
        rows.insert(rows.end(), colors.of(c).begin(), colors.of(c).end());
        while (rows.size() % HalfSprings::kSlice != 0) rows.push_back(kNoNode);
        colors_.push_back({first, static_cast<std::uint32_t>(rows.size()) - first});
    }
    neo_hookean_corners_ = NeoHookeanBuffers::Corners(model, rows);
    const HalfSprings springs = pack_half_springs(rows, model.springs);
    const TetCorners corners =
        pack_tet_corners(rows, make_node_tets(model.node_count(), model.tets), model.tets);
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    std::vector<std::uint32_t> chunk_starts(model.objects.size() + 1, 0);
    for (const Chunk& chunk : chunks) ++chunk_starts[chunk.object + 1];
    std::partial_sum(chunk_starts.begin(), chunk_starts.end(), chunk_starts.begin());

    rows_ = make_buffer(with_objects(model, rows), glm::uvec2(kNoNode, 0));
    half_springs_ = make_buffer(springs.pairs, HalfSpringPair{});
    stiffnesses_ = make_buffer(springs.stiffness, glm::vec2(0.0f));
    spring_starts_ = make_buffer(springs.slice_starts, 0u);
    tet_corners_ = make_buffer(corners.corners, TetCorner{});
    corner_starts_ = make_buffer(corners.slice_starts, 0u);
    tets_ = make_buffer(model.tets, glm::uvec4(0));
    tet_rests_ = make_buffer(rests_of(model), glm::vec2(1.0f));
    chunks_ = make_buffer(chunks, Chunk{});
    chunk_starts_ = make_buffer(chunk_starts, 0u);
    is_pinned_ = make_buffer(find_pinned_objects(model), 0u);
    rigid_sums_ = gl::Buffer<RigidSums>(chunks.size());

    row_texels_ = {rows_, gl::TexelFormat::rg32ui};
    half_spring_texels_ = {half_springs_, gl::TexelFormat::rgba32ui};
    stiffness_texels_ = {stiffnesses_, gl::TexelFormat::rg32f};
    spring_start_texels_ = {spring_starts_, gl::TexelFormat::r32ui};
    tet_corner_texels_ = {tet_corners_, gl::TexelFormat::rgba32ui};
    corner_start_texels_ = {corner_starts_, gl::TexelFormat::r32ui};
    tet_texels_ = {tets_, gl::TexelFormat::rgba32ui};
    tet_rest_texels_ = {tet_rests_, gl::TexelFormat::rg32f};
    chunk_start_texels_ = {chunk_starts_, gl::TexelFormat::r32ui};
    is_pinned_texels_ = {is_pinned_, gl::TexelFormat::r32ui};
}

void BlockDescent::run(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
                       double step) const {
    for (const gl::Program* program :
         {&start_program_, &sweep_program_, &sum_program_, &move_program_, &last_move_program_}) {
        program->set("time_step", static_cast<float>(step));
        program->set("gravity", model.gravity);
    }
    previous.position_texels.bind(1);
    previous.velocity_texels.bind(2);
    current.positions.bind_storage(0);
    near_flat_.bind_storage(1);
    object_touches_.bind_storage(2);
    start_program_.set("node_count", model.node_count);
    start_program_.set("object_count", object_count_);
    start_program_.dispatch(model.node_count);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);

    current.position_texels.bind(0);
    for (int i = 0; i < iterations_; ++i) {
        if (i % kSweepsAMotion == 0) mark_flat_tets();
        sweep_program_.set("clear_marks", i % kSweepsAMotion + 1 == kSweepsAMotion ? 1u : 0u);
        sweep(model);
        const bool is_last = i + 1 == iterations_;
        if (is_last || (i + 1) % kSweepsAMotion == 0) move_bodies(current, is_last);
    }
}

void BlockDescent::mark_flat_tets() const {
    tet_texels_.bind(9);
    tet_rest_texels_.bind(10);
    near_flat_.bind_storage(1);
    mark_program_.set("tet_count", tet_count_);
    mark_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage);
}

void BlockDescent::sweep(const ModelBuffers& model) const {
    row_texels_.bind(3);
    half_spring_texels_.bind(4);
    stiffness_texels_.bind(5);
    spring_start_texels_.bind(6);
    model.bind_colliders(sweep_program_);
    tet_corner_texels_.bind(8);
    corner_start_texels_.bind(9);
    tet_rest_texels_.bind(10);
    model.neo_hookean.bind_tets();
    neo_hookean_corners_.bind();
    for (const Color& color : colors_) {
        sweep_program_.set("first_row", color.first_row);
        sweep_program_.set("row_count", color.row_count);
        sweep_program_.dispatch(color.row_count);
        gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
    }
}

void BlockDescent::move_bodies(const NodeBuffers& current, bool is_last) const {
    chunk_start_texels_.bind(3);
    is_pinned_texels_.bind(4);
    chunks_.bind_storage(3);
    rigid_sums_.bind_storage(4);
    motions_.bind_storage(5);
    const auto chunks = static_cast<std::uint32_t>(chunks_.size());
    sum_program_.set("element_count", chunks);
    sum_program_.dispatch(64 * chunks_.size());
    gl::barrier(gl::Barrier::storage);

    motion_program_.set("element_count", object_count_);
    motion_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    const gl::Program& move = is_last ? last_move_program_ : move_program_;
    if (is_last) current.velocities.bind_storage(1);
    move.set("element_count", chunks);
    move.dispatch(64 * chunks_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
