#include "gpu/descent/block_descent.h"

namespace gelatin::gpu {
namespace {

gl::Defines start_defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (!model.loads.empty()) defines.emplace_back("LOADED");
    return defines;
}

}  // namespace

BlockDescent::BlockDescent(const Model& model, const DescentSettings& settings)
    : settings_(settings),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      start_program_(gl::Program::compute("sim/descent/start_descent.comp", start_defines(model))),
      find_tangled_program_(gl::Program::compute("sim/descent/take_back_tangled.comp", {"TETS"})),
      take_back_program_(gl::Program::compute("sim/descent/take_back_tangled.comp")),
      node_objects_(objects_of_nodes(model), gl::TexelFormat::r32ui),
      is_tangled_(model.objects.size()),
      moves_(model, settings.coarse_level) {
    bind_buffers();
}

// What never changes.
void BlockDescent::bind_buffers() const {
    start_program_.bind("NearFlat", moves_.objective.near_flat);
    start_program_.bind("Tangled", is_tangled_);
    start_program_.bind("Starts", moves_.objective.starts);
    start_program_.bind("Targets", moves_.objective.targets);
    moves_.contacts.bind(start_program_);
    find_tangled_program_.bind("tets", moves_.objective.tets);
    find_tangled_program_.bind("tet_rests", moves_.objective.tet_rests);
    take_back_program_.bind("start_positions", moves_.objective.start_texels);
    for (const gl::Program* program : {&find_tangled_program_, &take_back_program_}) {
        program->bind("node_objects", node_objects_);
        program->bind("Tangled", is_tangled_);
    }
}

void BlockDescent::run(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
                       const NodeBuffers& current, double step, bool has_earlier, StageTimer* timer) {
    {
        const TimedStage part(timer, "advance_nodes.start");
        start(model, loads, previous, current, step, has_earlier);
        moves_.objective.begin(previous, current, step);
        take_back_tangled(current);
        moves_.begin(model, previous, current, step);
    }
    moves_.run(settings_.iterations, current, timer);
}

void BlockDescent::start(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
                         const NodeBuffers& current, double step, bool has_earlier) const {
    start_program_.bind("start_positions", previous.position_texels);
    start_program_.bind("start_velocities", previous.velocity_texels);
    start_program_.bind("Positions", current.positions);
    start_program_.bind("EarlierVelocities", current.velocities);
    model.bind_colliders(start_program_);
    model.pulls.bind(start_program_);
    if (loads != nullptr) loads->bind(start_program_);
    start_program_.set("time_step", static_cast<float>(step));
    start_program_.set("gravity", model.gravity);
    start_program_.set("node_count", node_count_);
    start_program_.set("object_count", object_count_);
    start_program_.set("has_earlier", has_earlier ? 1u : 0u);
    start_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

void BlockDescent::take_back_tangled(const NodeBuffers& current) const {
    find_tangled_program_.bind("positions", current.position_texels);
    find_tangled_program_.set("element_count", tet_count_);
    find_tangled_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage);

    take_back_program_.bind("Positions", current.positions);
    take_back_program_.set("element_count", node_count_);
    take_back_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
