#include "gpu/implicit/body_contacts.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "model/contact/contact_force_sums.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

// @param normal, friction on the second side [N]
void add_row(const StepRow& row, std::span<const std::uint32_t> object_of, const glm::dvec3& normal,
             const glm::dvec3& friction, ContactForceSums& sums) {
    const std::array<std::uint32_t, 4> nodes{row.node_0, row.node_1, row.node_2, row.node_3};
    std::optional<std::uint32_t> first;  // none: a plane
    std::uint32_t second = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const auto weight = static_cast<double>(row.weights[static_cast<int>(k)]);
        if (weight == 0.0) continue;
        sums.add_to_node(nodes[k], weight * normal, weight * friction);
        if (weight < 0.0) first = object_of[nodes[k]];
        if (weight > 0.0) second = object_of[nodes[k]];
    }
    if (first != second) sums.add(second, first.value_or(row.plane), !first, normal, friction);
}

}  // namespace

// Each pair may have a row, as may each surface node with each plane.
RowCapacity BodyContacts::capacity_of(const Model& model, const PairCapacity& room) {
    return {room.pairs + model.colliders.size() * model.surface_parts.nodes.size(),
            room.slots + model.body_count()};
}

BodyContacts::BodyContacts(const Model& model, const ContactSurface& surface, StepState& state,
                           StepSystem& system, bool own, const PairCapacity& room)
    : pairs(model, room),
      finder(model, surface, state, pairs, own),
      rows(model, surface, state, system, pairs),
      model_(&model),
      state_(&state),
      system_(&system),
      guard_(model, state, pairs),
      row_forces_(gl::Program::compute("sim/implicit/row_forces.comp")),
      begin_follow_(gl::Program::compute("sim/implicit/follow_shapes.comp")),
      end_follow_(gl::Program::compute("sim/implicit/follow_shapes.comp", {"END"})) {
    for (const gl::Program* program : {&begin_follow_, &end_follow_}) {
        state.bind(*program);
        program->bind_declared("positions", state.from.position_texels);
        program->bind_declared("Positions", state.from.positions);
        program->bind_declared("Velocities", state.from.velocities);
        program->bind_declared("end_positions", state.to.position_texels);
        program->bind_declared("end_velocities", state.to.velocity_texels);
        program->bind_declared("Guard", guard_.found());
        program->set("node_count", model.node_count());
    }
}

void BodyContacts::find(const ModelBuffers& model, bool follows) const {
    finder.run(model, follows);
    rows.find_guard_islands(guard_.islands.values);
}

void BodyContacts::guard(const ModelBuffers& model) const {
    guard_.run(model);
    finder.find_lost(state_->to);
    guard_.decide();
}

void BodyContacts::follow(const ModelBuffers& model) const {
    begin_follow_.dispatch(model_->node_count());
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    state_->tries.follow_clock();
    find(model, true);
    guard_.run(model);
    guard_.decide(1);
    end_follow_.dispatch(model_->node_count());
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

// Lists behind the one that was full are empty: that these have no place either a later try says.
PairCapacity BodyContacts::needed() const {
    const PairCounts counts = read(pairs.counts)[0];
    PairCapacity more = pairs.capacity;
    const auto make_room = [](std::size_t& capacity, std::size_t count) {
        if (count > capacity) capacity = 2 * count;
    };
    make_room(more.slots, counts.slots);
    make_room(more.searches, counts.searches);
    make_room(more.leaf_pairs, counts.leaf_pairs);
    make_room(more.pairs, counts.pairs);
    return more;
}

void BodyContacts::grow(const PairCapacity& capacity) {
    pairs.grow(capacity);
    system_->grow(capacity_of(*model_, capacity));
    finder.grow();
    rows.grow();
    guard_.grow();
    StepClock clock = state_->tries.clock();
    clock.is_full = 0;
    state_->tries.set_clock(clock);
}

ContactForces BodyContacts::forces() const {
    ContactForceSums sums(*model_);
    const std::size_t count = state_->tries.clock().row_count;
    if (count == 0) return sums.take();
    gl::Buffer<glm::vec4> forces(2 * count);
    system_->buffers().bind(row_forces_);
    state_->bind(row_forces_);
    row_forces_.bind("RowForces", forces);
    row_forces_.dispatch(count);
    const std::vector<StepRow> rows_made = read(system_->buffers().rows.values);
    const std::vector<glm::vec4> of_rows = read(forces);
    for (std::size_t r = 0; r < count; ++r) {
        const glm::dvec3 normal(of_rows[2 * r]), friction(of_rows[2 * r + 1]);
        const glm::dvec3 none(0.0);
        if (normal != none || friction != none)
            add_row(rows_made[r], model_->node_objects, normal, friction, sums);
    }
    return sums.take();
}

}  // namespace gelatin::gpu
