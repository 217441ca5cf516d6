#include "gpu/implicit/part_end.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "core/stage.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

gl::Program energies_program(const Model& model, const gl::Defines& more) {
    gl::Defines defines = more;
    for (const auto& some : {NeoHookeanBuffers::defines(model), VolumeTermBuffers::defines(model)})
        defines.insert(defines.end(), some.begin(), some.end());
    return gl::Program::compute("sim/implicit/energies.comp", defines);
}

// As shaders have them.
std::vector<glm::uvec4> elements_of(const Model& model) {
    std::vector<glm::uvec4> elements;
    for (const ModelObject& o : model.objects)
        elements.emplace_back(o.springs.first, o.springs.count, o.tets.first, o.tets.count);
    return elements;
}

// Velocities of surfaces within themselves [m/s]; w: the object.
std::vector<glm::vec4> objects_by_node(const Model& model) {
    std::vector<glm::vec4> objects;
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const glm::vec3 velocity =
            o < model.body_count() ? glm::vec3(0.0f) : model.surfaces[o - model.body_count()].velocity;
        objects.resize(objects.size() + model.objects[o].nodes.count, {velocity, static_cast<float>(o)});
    }
    return objects;
}

// Each body goes on by itself.
std::vector<BodyEnergy> unknown_energies(std::uint32_t count) {
    std::vector<BodyEnergy> energies(count);
    for (std::uint32_t o = 0; o < count; ++o) energies[o].tied = energies[o].next_tied = o;
    return energies;
}

std::vector<float> restitutions_of(const ContactSurface* contacts) {
    if (contacts == nullptr) return {0.0f};
    std::vector<float> restitutions;
    for (const ContactSurface::Touch& touch : contacts->touches)
        restitutions.push_back(static_cast<float>(touch.restitution));
    return restitutions;
}

bool bounces(const ContactSurface* contacts) {
    const std::vector<float> all = restitutions_of(contacts);
    return std::any_of(all.begin(), all.end(), [](float restitution) { return restitution > 0.0f; });
}

gl::Defines defines_of_settle(const ContactSurface* contacts) {
    return bounces(contacts) ? gl::Defines{"PAIRS"} : gl::Defines{};
}

gl::Buffer<double> zeros(std::size_t count) {
    return gl::Buffer<double>(std::vector<double>(std::max<std::size_t>(count, 1)));
}

}  // namespace

PartEnd::Programs::Programs(const Model& model, const ContactSurface* contacts)
    : sum_motions(gl::Program::compute("sim/implicit/sum_motions.comp")),
      finish(gl::Program::compute("sim/implicit/finish.comp", SumLoads::defines(model))),
      keep(energies_program(model, {"KEEP"})),
      sum_velocities(gl::Program::compute("sim/implicit/sum_velocities.comp")),
      measure(gl::Program::compute("sim/implicit/measure_part.comp", SumLoads::defines(model))),
      sum_chunks(gl::Program::compute("sim/implicit/sum_chunks.comp")),
      judge(gl::Program::compute("sim/implicit/judge.comp")),
      guard(gl::Program::compute("sim/implicit/guard_planes.comp", ModelBuffers::collider_defines(model))),
      measure_guarded(energies_program(model, {"GUARDED"})),
      judge_guarded(gl::Program::compute("sim/implicit/judge.comp", {"GUARDED"})),
      stop(energies_program(model, {"STOP"})),
      settle(gl::Program::compute("sim/implicit/settle.comp", defines_of_settle(contacts))),
      commit(gl::Program::compute("sim/implicit/commit.comp")),
      find_energies(energies_program(model, {})),
      begin_energies(gl::Program::compute("sim/implicit/begin_energies.comp")),
      has_contacts(contacts != nullptr),
      has_restitution(bounces(contacts)) {
    if (!has_contacts) return;
    tie_bodies = gl::Program::compute("sim/implicit/tie_bodies.comp");
    sum_guarded = gl::Program::compute("sim/implicit/sum_guarded.comp");
    if (!has_restitution) return;
    press_pairs = gl::Program::compute("sim/implicit/press_pairs.comp");
    meet_pairs = gl::Program::compute("sim/implicit/meet_pairs.comp");
}

std::vector<const gl::Program*> PartEnd::Programs::all() const {
    std::vector<const gl::Program*> all = {&sum_motions, &finish, &keep,   &sum_velocities,  &measure,
                                           &sum_chunks,  &judge,  &guard,  &measure_guarded, &judge_guarded,
                                           &stop,        &settle, &commit, &find_energies,   &begin_energies};
    if (has_contacts) all.insert(all.end(), {&tie_bodies, &sum_guarded});
    if (has_restitution) all.insert(all.end(), {&press_pairs, &meet_pairs});
    return all;
}

PartEnd::PartEnd(const Model& model, StepState& state, StepSystem& system, const ContactSurface* contacts)
    : state_(&state),
      system_(&system),
      chunk_count_(system.buffers().chunk_count),
      object_count_(system.buffers().object_count),
      collider_count_(static_cast<std::uint32_t>(model.colliders.size())),
      body_node_count_(model.body_node_count()),
      gravity_(model.gravity),
      has_colliders_(!model.colliders.empty()),
      masses_(model.masses),
      programs_(model, contacts),
      springs_(model.springs, gl::TexelFormat::rgba32ui),
      elements_(elements_of(model), gl::TexelFormat::rgba32ui),
      node_objects_(objects_by_node(model), gl::TexelFormat::rgba32f),
      kinds_(contacts != nullptr ? contacts->kinds : std::vector<std::uint32_t>(1), gl::TexelFormat::r32ui),
      restitutions_(restitutions_of(contacts), gl::TexelFormat::r32f),
      kind_count_(contacts != nullptr ? contacts->kind_count : 1),
      rigid_velocities_(object_count_, gl::TexelFormat::rgba32f),
      finish_sums_(zeros(end_sums::kFinishSums * chunk_count_)),
      energy_sums_(zeros(end_sums::kEnergySums * chunk_count_)),
      part_sums_(zeros(end_sums::kPartSums * chunk_count_)),
      guard_sums_(zeros(end_sums::kGuardSums * chunk_count_)),
      pressed_sums_(zeros(end_sums::kPressedSums * chunk_count_ * model.colliders.size())),
      meetings_(zeros(end_sums::kMeeting * object_count_ * model.colliders.size())),
      object_sums_(zeros(end_sums::kObjectSums * object_count_)),
      island_sums_(zeros(end_sums::kIslandSums * object_count_)),
      energies_(unknown_energies(object_count_)),
      changes_(std::vector<BodyChange>(object_count_)) {
    for (const ModelObject& object : model.objects) nodes_.push_back(object.nodes);
    make_room();
    bind_buffers();
    bind_nodes();
}

// For what pairs of objects have in common.
void PartEnd::make_room() {
    if (programs_.has_restitution) meeting_capacity_ = static_cast<std::uint32_t>(system_->capacity().pairs);
    presses_ = zeros(end_sums::kPairSums * meeting_capacity_);
    pair_meetings_ = zeros(1 + 2 * end_sums::kPairMeeting * meeting_capacity_);
}

void PartEnd::grow() {
    const std::vector<double> meetings = read_pair_meetings();
    make_room();
    pair_meetings_.upload(meetings);
    bind_buffers();
}

// Of all that there are, with their number.
std::vector<double> PartEnd::read_pair_meetings() const {
    std::vector<double> meetings = read(pair_meetings_);
    meetings.resize(1 + static_cast<std::size_t>(meetings[0]) * end_sums::kPairMeeting);
    return meetings;
}

// What does not change from step to step.
void PartEnd::bind_buffers() const {
    const auto gravity = static_cast<double>(glm::length(gravity_));
    const double slow = static_cast<double>(contact_tuning::kFrame) * gravity;
    for (const gl::Program* program : programs_.all()) {
        state_->bind(*program);
        system_->buffers().bind(*program);
        program->bind_declared("FinishSums", finish_sums_);
        program->bind_declared("EnergySums", energy_sums_);
        program->bind_declared("PartSums", part_sums_);
        program->bind_declared("GuardSums", guard_sums_);
        program->bind_declared("PressedSums", pressed_sums_);
        program->bind_declared("Meetings", meetings_);
        program->bind_declared("ObjectSums", object_sums_);
        program->bind_declared("IslandSums", island_sums_);
        rigid_velocities_.bind(*program, "RigidVelocities", "rigid_velocities");
        program->bind_declared("node_objects", node_objects_);
        bind_contacts(*program);
        program->bind_declared("BodyEnergies", energies_);
        program->bind_declared("BodyChanges", changes_);
        program->bind_declared("springs", springs_);
        program->bind_declared("elements", elements_);
        program->set("gravity", gravity_);
        program->set("slow", static_cast<float>(slow));
        program->set("resting_speed", static_cast<float>(2.0 * slow));
        program->set("collider_count", collider_count_);
        program->set("body_node_count", body_node_count_);
    }
    const Programs& p = programs_;
    for (const gl::Program* program : {&p.keep, &p.measure_guarded, &p.stop, &p.find_energies})
        system_->elastic.bind_tets(*program);
    p.measure.bind("ElasticForces", system_->elastic.forces());
    system_->elastic.bind_product(p.measure, system_->buffers().displacements.texels);
}

void PartEnd::bind_contacts(const gl::Program& program) const {
    program.bind_declared("kinds", kinds_);
    program.bind_declared("restitutions", restitutions_);
    program.bind_declared("PairPresses", presses_);
    program.bind_declared("PairMeetings", pair_meetings_);
    program.set("kind_count", kind_count_);
    program.set("meeting_capacity", meeting_capacity_);
}

void PartEnd::bind_nodes() const {
    const NodeBuffers &from = state_->from, &to = state_->to;
    const Programs& p = programs_;
    for (const gl::Program* program : {&p.sum_motions, &p.finish, &p.measure, &p.guard})
        program->bind("positions", from.position_texels);
    p.finish.bind("velocities", from.velocity_texels);
    p.measure.bind("velocities", to.velocity_texels);
    for (const gl::Program* program : {&p.keep, &p.measure_guarded, &p.stop, &p.find_energies}) {
        const NodeBuffers& at = program == &p.find_energies ? from : to;
        program->bind("positions", at.position_texels);
        program->bind("velocities", at.velocity_texels);
        program->bind("start_positions", from.position_texels);
    }
    for (const gl::Program* program : {&p.keep, &p.stop, &p.finish})
        program->bind("EndVelocities", to.velocities);
    for (const gl::Program* program : {&p.finish, &p.guard}) program->bind("EndPositions", to.positions);
    if (p.has_contacts) {
        p.sum_guarded.bind("positions", from.position_texels);
        p.sum_guarded.bind("end_positions", to.position_texels);
    }
    if (p.has_restitution) {
        p.press_pairs.bind("positions", from.position_texels);
        p.press_pairs.bind("velocities", to.velocity_texels);
    }
    p.commit.bind("Positions", from.positions);
    p.commit.bind("Velocities", from.velocities);
    p.commit.bind("end_positions", to.position_texels);
    p.commit.bind("end_velocities", to.velocity_texels);
}

void PartEnd::run(const gl::Program& program, std::uint32_t groups) const {
    state_->tries.run(Tries::Where::goes_on, program, groups);
}

void PartEnd::begin_step(const ModelBuffers& model) const {
    model.volume_term.bind(programs_.find_energies);
    programs_.find_energies.dispatch_groups(chunk_count_);
    gl::barrier(gl::Barrier::storage);
    programs_.begin_energies.dispatch(object_count_);
}

void PartEnd::finish(const ModelBuffers& model, const SumLoads* loads) const {
    const Programs& p = programs_;
    for (const gl::Program* program : {&p.finish, &p.measure}) {
        if (loads != nullptr) loads->bind(*program);
        model.pulls.bind(*program);
    }
    model.volume_term.bind(p.keep);
    p.measure.bind("colliders", model.colliders);
    const auto run_in_part = [&](const gl::Program& program, std::uint32_t groups) {
        state_->tries.run(Tries::Where::makes_part, program, groups);
    };
    if (p.has_contacts) run_in_part(p.tie_bodies, 1);
    for (const gl::Program* program : {&p.sum_motions, &p.finish, &p.keep})
        run_in_part(*program, chunk_count_);
    run_in_part(p.sum_velocities, object_count_);
    run_in_part(p.measure, chunk_count_);
    run_in_part(p.sum_chunks, object_count_);
    run_in_part(p.judge, 1);
}

void PartEnd::run(const ModelBuffers& model, const SumLoads* loads, StageTimer* timer) const {
    {
        const Stage part(timer, "advance_nodes.finish");
        finish(model, loads);
    }
    const Stage part(timer, "advance_nodes.guard");
    if (has_colliders_) {
        model.bind_colliders(programs_.guard);
        run(programs_.guard, chunk_count_);
        end_guarded(model);
    }
    end_part(model);
}

void PartEnd::settle(const ModelBuffers& model) const {
    run(programs_.sum_guarded, chunk_count_);
    end_guarded(model);
    end_part(model);
}

// Where it has moved nodes, energies are found anew.
void PartEnd::end_guarded(const ModelBuffers& model) const {
    const Programs& p = programs_;
    for (const gl::Program* program : {&p.measure_guarded, &p.stop}) model.volume_term.bind(*program);
    run(p.measure_guarded, chunk_count_);
    run(p.sum_chunks, object_count_);
    run(p.judge_guarded, 1);
    run(p.stop, chunk_count_);
    run(p.sum_chunks, object_count_);
}

void PartEnd::end_part(const ModelBuffers& model) const {
    programs_.settle.bind("colliders", model.colliders);
    if (programs_.has_restitution) {
        state_->tries.run_counted(programs_.press_pairs, try_dispatches::kPressedPairs);
        run(programs_.meet_pairs, 1);
    }
    run(programs_.settle, 1);
    run(programs_.commit, chunk_count_);
}

void PartEnd::forget() {
    gl::barrier(gl::Barrier::buffer_update);
    const std::size_t planes = state_->plane_memories.size();
    state_->plane_memories.upload(std::vector<PlaneMemory>(planes));
    state_->tries.set_clock({});
    state_->paces.values.upload(std::vector<BodyPace>(object_count_));
    energies_.upload(unknown_energies(object_count_));
    meetings_.upload(std::vector<double>(meetings_.size()));
    pair_meetings_.upload(std::vector<double>(pair_meetings_.size()));
}

PartEnd::Memory PartEnd::empty_memory() const {
    return {std::vector<StepClock>(1),
            std::vector<BodyPace>(state_->paces.values.size()),
            std::vector<glm::vec4>(state_->accelerations.values.size()),
            std::vector<PlaneMemory>(state_->plane_memories.size()),
            std::vector<BodyEnergy>(energies_.size()),
            std::vector<double>(meetings_.size()),
            {0.0}};
}

PartEnd::Memory PartEnd::memory() const {
    Memory memory = empty_memory();
    memory.clock = {state_->tries.clock()};
    state_->paces.values.download(memory.paces);
    state_->accelerations.values.download(memory.accelerations);
    state_->plane_memories.download(memory.planes);
    energies_.download(memory.energies);
    meetings_.download(memory.meetings);
    memory.pair_meetings = read_pair_meetings();
    return memory;
}

void PartEnd::set_memory(const Memory& memory) {
    state_->tries.set_clock(memory.clock[0]);
    state_->paces.values.upload(memory.paces);
    state_->accelerations.values.upload(memory.accelerations);
    state_->plane_memories.upload(memory.planes);
    energies_.upload(memory.energies);
    meetings_.upload(memory.meetings);
    std::vector<double> pair_meetings = memory.pair_meetings;
    if (pair_meetings.size() > pair_meetings_.size()) pair_meetings = {0.0};
    pair_meetings_.upload(pair_meetings);
}

// Accelerations are Euler's.
void PartEnd::go_on(std::span<const glm::vec4> positions, std::span<const glm::vec4> velocities,
                    std::span<const glm::vec4> earlier_velocities, double step) {
    std::vector<glm::vec4> accelerations;
    for (std::size_t n = 0; n < velocities.size(); ++n)
        accelerations.emplace_back((glm::dvec3(velocities[n]) - glm::dvec3(earlier_velocities[n])) / step,
                                   0.0);
    std::vector<BodyPace> paces(object_count_);
    for (std::size_t o = 0; o < paces.size(); ++o) {
        glm::dvec3 middle(0.0), momentum(0.0), angular(0.0);
        double mass = 0.0;
        for (std::uint32_t n = nodes_[o].first; n < nodes_[o].end(); ++n) {
            const bool is_held = positions[n].w == 0.0f;
            paces[o].held_count += is_held ? 1 : 0;
            const double m =
                is_held ? static_cast<double>(masses_[n]) : 1.0 / static_cast<double>(positions[n].w);
            const glm::dvec3 r(positions[n]);
            const glm::dvec3 change = (glm::dvec3(velocities[n]) - glm::dvec3(earlier_velocities[n])) / step;
            mass += m;
            middle += m * r;
            momentum += m * change;
            angular += m * glm::cross(r, change);
        }
        paces[o].force = glm::vec4(momentum, 0.0);
        if (mass > 0.0) paces[o].moment = glm::vec4(angular - glm::cross(middle, momentum) / mass, 0.0);
    }
    forget();
    state_->accelerations.values.upload(accelerations);
    state_->paces.values.upload(paces);
    StepClock clock{};
    clock.last_step = static_cast<float>(step);
    state_->tries.set_clock(clock);
}

}  // namespace gelatin::gpu
