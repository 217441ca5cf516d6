#include "gpu/implicit/pair_guard.h"

#include <algorithm>

#include "gpu/chunks.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

using contact_tuning::kGuardRounds;

// As shaders have them.
constexpr std::size_t kFrameSums = 10;

gl::Program guard_program(const std::string& name, const gl::Defines& defines = {}) {
    return gl::Program::compute("sim/implicit/guard_" + name + ".comp", defines);
}

// Twice the object, and 1 more on its surface.
std::vector<std::uint32_t> places_of_nodes(const Model& model) {
    std::vector<std::uint32_t> places = model.node_objects;
    for (std::uint32_t& place : places) place *= 2;
    for (const std::uint32_t n : model.surface_parts.nodes) places[n] |= 1;
    return places;
}

}  // namespace

PairGuard::Programs::Programs(const Model& model)
    : begin(guard_program("begin")),
      frames(guard_program("frames", ModelBuffers::collider_defines(model))),
      nodes(guard_program("nodes", ModelBuffers::collider_defines(model))),
      pairs(guard_program("pairs")),
      end(guard_program("end")),
      decide(guard_program("decide")),
      stay(guard_program("stay")) {}

std::vector<const gl::Program*> PairGuard::Programs::all() const {
    return {&begin, &frames, &nodes, &pairs, &end, &decide, &stay};
}

PairGuard::PairGuard(const Model& model, StepState& state, PairBuffers& pairs)
    : islands(model.objects.size(), gl::TexelFormat::r32ui),
      state_(&state),
      pairs_(&pairs),
      node_count_(model.node_count()),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      has_colliders_(!model.colliders.empty()),
      programs_(model),
      node_objects_(places_of_nodes(model), gl::TexelFormat::r32ui),
      found_(std::vector<GuardState>(1)),
      node_clips_(std::vector<NodeClips>(node_count_)),
      marks_(std::vector<std::uint32_t>(object_count_)),
      wanted_(node_count_, gl::TexelFormat::rgba32f),
      frames_(object_count_, gl::TexelFormat::rgba32f) {
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    chunk_count_ = static_cast<std::uint32_t>(chunks.size());
    chunks_ = {chunks, gl::TexelFormat::rgba32ui};
    frame_sums_ = gl::Buffer<double>(std::vector<double>(kFrameSums * chunks.size()));
    grow();
}

void PairGuard::grow() {
    const std::size_t pairs = std::max<std::size_t>(pairs_->capacity.pairs, 1);
    half_spaces_ = gl::Buffer<glm::vec4>(std::vector<glm::vec4>(4 * pairs));
    clip_links_ = gl::Buffer<std::uint32_t>(std::vector<std::uint32_t>(4 * pairs));
    for (const gl::Program* program : programs_.all()) {
        state_->bind(*program);
        pairs_->bind(*program);
        program->bind_declared("Guard", found_);
        program->bind_declared("Clips", node_clips_);
        program->bind_declared("HalfSpaces", half_spaces_);
        program->bind_declared("ClipLinks", clip_links_);
        program->bind_declared("FrameSums", frame_sums_);
        program->bind_declared("Marks", marks_);
        wanted_.bind(*program, "Wanted", "wanted");
        frames_.bind(*program, "Frames", "frames");
        program->bind_declared("guard_islands", islands.texels);
        program->bind_declared("chunks", chunks_);
        program->bind_declared("node_objects", node_objects_);
        program->set("node_count", node_count_);
        program->set("chunk_count", chunk_count_);
        program->bind_declared("positions", state_->from.position_texels);
        program->bind_declared("EndPositions", state_->to.positions);
    }
    programs_.pairs.bind("ends", state_->to.position_texels);
}

void PairGuard::run(const gl::Program& program, std::size_t groups) const {
    state_->tries.run(Tries::Where::goes_on, program, groups);
}

// Where the round before has left work. The nodes of a round come before its pairs.
void PairGuard::run_round(const gl::Program& program, std::uint32_t round) const {
    program.set("round_", round);
    const std::uint32_t pairs = try_dispatches::kGuardRound + 2 * round;
    state_->tries.run_counted(program, &program == &programs_.nodes ? pairs - 1 : pairs);
}

void PairGuard::run(const ModelBuffers& model) const {
    const Programs& p = programs_;
    for (const gl::Program* program : {&p.frames, &p.nodes}) model.bind_colliders(*program);
    run(p.begin, chunk_count_);
    run(p.frames, object_count_);
    if (has_colliders_) {
        p.nodes.set("round_", 0u);
        run(p.nodes, (node_count_ + 63) / 64);
    }
    run_round(p.pairs, 0);
    for (std::uint32_t round = 1; round <= kGuardRounds; ++round) {
        run_round(p.nodes, round);
        run_round(p.pairs, round);
    }
    run(p.end, (node_count_ + 63) / 64);
}

void PairGuard::decide(std::uint32_t most) const {
    programs_.decide.set("most_guards", most);
    run(programs_.decide, 1);
    state_->tries.run_counted(programs_.stay, try_dispatches::kGuardStays);
}

}  // namespace gelatin::gpu
