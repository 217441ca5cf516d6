#include "gpu/implicit/body_contacts.h"

#include <algorithm>
#include <vector>

#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

std::size_t plane_rows_of(const Model& model) {
    return model.colliders.size() * model.surface_parts.nodes.size();
}

// Each pair may have a row.
RowCapacity rows_of(const Model& model, const PairCapacity& pairs) {
    return {pairs.pairs + plane_rows_of(model), pairs.slots + model.body_count()};
}

}  // namespace

RowCapacity BodyContacts::capacity_of(const Model& model) {
    return rows_of(model, PairCapacity::of(model));
}

BodyContacts::BodyContacts(const Model& model, const ContactSurface& surface, StepState& state,
                           StepSystem& system, bool own)
    : pairs(model, PairCapacity::of(model)),
      finder(model, surface, state, pairs, own),
      rows(model, surface, state, system, pairs),
      state_(&state),
      system_(&system),
      plane_rows_(plane_rows_of(model)),
      guard_(model, state, pairs) {}

void BodyContacts::find(const ModelBuffers& model) const {
    finder.run(model);
    rows.find_guard_islands(guard_.islands.values);
}

void BodyContacts::guard(const ModelBuffers& model) const {
    for (std::uint32_t pass = 0; pass < contact_tuning::kGuardPasses; ++pass) {
        if (pass > 0) find(model);
        guard_.run(model);
        finder.find_lost(state_->to);
        guard_.decide();
    }
    guard_.close();
}

// Lists behind the one that was full are empty: that these have no place either a later try says.
void BodyContacts::grow() {
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<PairCounts> counts(1);
    pairs.counts.download(counts);
    PairCapacity more = pairs.capacity;
    const auto make_room = [](std::size_t& capacity, std::size_t count) {
        if (count > capacity) capacity = 2 * count;
    };
    make_room(more.slots, counts[0].slots);
    make_room(more.searches, counts[0].searches);
    make_room(more.leaf_pairs, counts[0].leaf_pairs);
    make_room(more.pairs, counts[0].pairs);
    const std::size_t bodies = system_->capacity().pairs - pairs.capacity.slots;
    pairs.grow(more);
    system_->grow({more.pairs + plane_rows_, more.slots + bodies});
    finder.grow();
    rows.grow();
    guard_.grow();
    std::vector<StepClock> clock(1);
    state_->clock.download(clock);
    clock[0].is_full = 0;
    state_->clock.upload(clock);
}

}  // namespace gelatin::gpu
