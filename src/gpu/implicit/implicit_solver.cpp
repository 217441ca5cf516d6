#include "gpu/implicit/implicit_solver.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/archive.h"
#include "core/log.h"
#include "core/stage.h"
#include "gl/context.h"
#include "model/contact/contact_force_sums.h"
#include "model/drive/held_up.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

PairCapacity room_of(const Model& model, const std::optional<PairCapacity>& wanted) {
    return wanted ? *wanted : PairCapacity::of(model);
}

// Contacts with colliders, of nodes on surfaces; those within a body come near one only where it is crushed.
RowCapacity capacity_of(const Model& model, const CollisionSettings& collision,
                        const std::optional<PairCapacity>& room) {
    if (has_contacts(model, collision)) return BodyContacts::capacity_of(model, room_of(model, room));
    if (model.colliders.empty()) return {};
    return {model.colliders.size() * model.surface_parts.nodes.size(), model.body_count()};
}

// In software, barriers within work groups cost more than dispatches, and the program takes 9 s to compile
// (docs/decisions/0074-small-islands-in-one-dispatch.md).
std::uint32_t most_small_chunks() {
    return gl::Context::current().device().is_software ? 0 : packing::kChunksOfSmallIsland;
}

// What passes from step to step, beside nodes. Sizes say for which model it is: the same solver's on another
// device has them, too.
struct Memory {
    PartEnd::Memory end;
    std::vector<float> lost_for;      // as ShapeMatcher has it
    PairRows::Memory contacts;        // between bodies, if there may be any
    std::vector<glm::vec4> ended_at;  // nodes, where blocked ones are not where they are held
    std::vector<RestState> rest = std::vector<RestState>(1);
    std::vector<glm::vec4> places = {};  // as StepState has them
    std::vector<float> load_factors = {};

    void pass(Archive& archive) {
        constexpr std::size_t kDevice = 0xDE71CE;  // no size of a scalar, with which the host's begins
        const std::array<std::size_t, 5> kind{kDevice, end.accelerations.size(), end.paces.size(),
                                              end.planes.size(), ended_at.size()};
        std::array<std::size_t, 5> written = kind;
        archive.value(written);
        if (written != kind) return archive.fail();
        archive.array(end.clock);
        archive.array(end.paces);
        archive.array(end.accelerations);
        archive.array(end.planes);
        archive.array(end.energies);
        archive.array(end.meetings);
        archive.list(end.pair_meetings);
        archive.array(lost_for);
        archive.array(ended_at);
        archive.array(rest);
        archive.array(places);
        archive.list(load_factors);
        archive.array(contacts.starts);
        archive.list(contacts.entries);
        archive.list(contacts.rows);
    }
};

bool are_lost(std::span<const float> times) {
    return std::any_of(times.begin(), times.end(), [](float time) { return time > thresholds::kPatience; });
}

void copy_nodes(const NodeBuffers& from, NodeBuffers& to) {
    gl::barrier(gl::Barrier::buffer_update);
    to.positions.copy_from(from.positions);
    to.velocities.copy_from(from.velocities);
}

}  // namespace

ImplicitSolver::ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision,
                               const ImplicitSettings& settings, const std::optional<PairCapacity>& room)
    : GpuSolver(std::move(model), collision),
      divides_steps_(settings.divides_steps),
      sleeps_(settings.sleeps && has_contacts(*model_, collision)),
      surface_(make_contact_surface(*model_, collision)),
      state_(*model_, surface_),
      system_(*model_, state_.tries, capacity_of(*model_, collision, room), most_small_chunks()),
      contacts_(has_contacts(*model_, collision)
                    ? std::optional<BodyContacts>(std::in_place, *model_, surface_, state_, system_,
                                                  collision.self_collision.value_or(true),
                                                  room_of(*model_, room))
                    : std::nullopt),
      start_(*model_, state_, system_, contacts_ ? &contacts_->rows : nullptr),
      end_(*model_, state_, system_, contacts_ ? &surface_ : nullptr),
      shape_matcher_(*model_) {
    if (!model_->handles.empty() && model_->is_body(model_->handles[0].object))
        held_forces_.emplace(*model_, state_, system_);
    system_.set_iterations(settings.iterations);
    set_contact_distances({surface_.thicknesses.begin(), surface_.thicknesses.end()});
}

void ImplicitSolver::write_state(const State& state) {
    GpuSolver::write_state(state);
    copy_nodes(current_, state_.from);  // whose velocities are before handles change them
    goes_on_ = is_next_ = false;
    may_be_lost_ = true;
    size_ = 0.0;
    state_.wake();
    if (restore(state.memory)) return;
    end_.forget();
    if (contacts_) contacts_->rows.forget();
    shape_matcher_.forget();
    goes_on_ = has_earlier_;
}

ContactForces ImplicitSolver::contact_forces() {
    if (!contacts_) return {};
    complete();
    return size_ > 0.0 ? contacts_->forces() : ContactForceSums(*model_).take();
}

std::vector<std::uint32_t> ImplicitSolver::held_up(std::span<const glm::dvec3> places) {
    if (!contacts_) return {};
    complete();
    const std::vector<glm::vec4> positions = read(current_.positions);
    return find_held_up<glm::vec4>(*model_, surface_.thicknesses, positions, places);
}

HoldingForces ImplicitSolver::holding_forces() {
    if (!held_forces_) return {};
    complete();
    return held_forces_->read(buffers_, loads_, size_);
}

std::string ImplicitSolver::memory() {
    complete();
    std::string bytes;
    Archive archive = Archive::that_writes(bytes);
    Memory memory{end_.memory(), shape_matcher_.lost_for(), {}, {}};
    if (contacts_) {
        memory.contacts = contacts_->rows.memory();
        memory.ended_at.resize(model_->node_count());
        state_.from.positions.download(memory.ended_at);
        state_.rest.download(memory.rest);
        memory.places = read(state_.places);
        memory.load_factors = load_factors_;
    }
    memory.pass(archive);
    return bytes;
}

// @return whether it was that of such a solver
bool ImplicitSolver::restore(std::string_view bytes) {
    Archive archive = Archive::that_reads(bytes);
    Memory memory{end_.empty_memory(), std::vector<float>(model_->objects.size()), {}, {}};
    if (contacts_) {
        memory.ended_at.resize(model_->node_count());
        memory.places.resize(model_->node_count());
        memory.contacts.starts.resize(model_->node_count() + 1);
    }
    memory.pass(archive);
    if (!archive.is_complete()) return false;
    end_.set_memory(memory.end);
    shape_matcher_.set_lost_for(memory.lost_for);
    may_be_lost_ = are_lost(memory.lost_for);
    if (!contacts_) return true;
    PairCapacity capacity = contacts_->pairs.capacity;
    if (memory.contacts.rows.size() > capacity.pairs) {
        capacity.pairs = memory.contacts.rows.size();
        grow(capacity);
    }
    contacts_->rows.set_memory(memory.contacts);
    state_.from.positions.upload(memory.ended_at);
    state_.rest.upload(memory.rest);
    state_.places.upload(memory.places);
    load_factors_ = memory.load_factors;
    return is_next_ = true;
}

// By loads that change, or by hands.
bool ImplicitSolver::is_driven(const Step& step) {
    const std::vector<float> before =
        std::exchange(load_factors_, {step.load_factors.begin(), step.load_factors.end()});
    return buffers_.pulls.is_acting() || (is_next_ && before != load_factors_);
}

void ImplicitSolver::advance_nodes(const Step& step) {
    if (std::exchange(goes_on_, false)) {
        const State state = read_state();
        end_.go_on(state.positions, state.velocities, state.earlier_velocities, step.size);
    }
    loads_ = loads_of(step);
    std::swap(current_, previous_);
    gl::barrier(gl::Barrier::storage);  // copies have to have read what this writes
    start_.begin_step(previous_, {step.size, divides_steps_, is_next_, sleeps_, is_driven(step)});
    is_next_ = true;
    size_ = step.size;
    match_shapes(step.size);
    end_.begin_step(buffers_);
    has_earlier_ = true;
    make_tries();
}

// With contacts shapes are put back only if nothing is in the way, which is asked a step after a body seems
// to be lost: hardly any ever is.
void ImplicitSolver::match_shapes(double elapsed) {
    if (!contacts_) return shape_matcher_.run(state_.from, elapsed);
    copy_nodes(state_.from, state_.to);
    shape_matcher_.run(state_.to, elapsed);
    if (may_be_lost_) contacts_->follow(buffers_);
    lost_for_.begin(shape_matcher_.lost_for_buffer().id(), model_->objects.size() * sizeof(float));
}

// And begins to ask whether they were enough.
void ImplicitSolver::make_tries() {
    for (std::uint32_t k = 0; k < tries_; ++k) make_try();
    if (contacts_ || !model_->handle_nodes.empty()) start_.end_step(previous_);
    copy_nodes(state_.from, current_);
    clocks_.begin(state_.tries.clock_buffer().id(), sizeof(StepClock));
}

void ImplicitSolver::make_try() {
    StageTimer* const timer = timer_.for_parts();
    if (loads_ != nullptr) loads_->run(state_.from);
    const auto solve = [&] {
        const Stage part(timer, "advance_nodes.solve");
        system_.solve(state_.from);
    };
    if (!contacts_) {
        start_.run(buffers_, loads_, timer);
        solve();
        return end_.run(buffers_, loads_, timer);
    }
    {
        const Stage part(timer, "advance_nodes.detect");
        start_.predict(buffers_, loads_);
        contacts_->find(buffers_);
        start_.find_rows(buffers_, loads_);
    }
    {
        const Stage part(timer, "advance_nodes.linearise");
        start_.linearise(buffers_, loads_);
    }
    solve();
    {
        const Stage part(timer, "advance_nodes.finish");
        contacts_->note();
        end_.finish(buffers_, loads_);
    }
    const Stage part(timer, "advance_nodes.guard");
    contacts_->guard(buffers_);
    end_.settle(buffers_);
    contacts_->remember(end_.changes());
}

void ImplicitSolver::grow(const PairCapacity& capacity) {
    contacts_->grow(capacity);
    start_.bind_buffers();
    end_.grow();
    if (held_forces_) held_forces_->bind_buffers();
}

void ImplicitSolver::complete() {
    while (lost_for_.pending() > 0) {
        std::vector<float> times(model_->objects.size());
        std::memcpy(times.data(), lost_for_.take().data(), times.size() * sizeof(float));
        may_be_lost_ = are_lost(times);
    }
    while (clocks_.pending() > 0) {
        StepClock clock;
        std::memcpy(&clock, clocks_.take().data(), sizeof(clock));
        tries_ = std::clamp(clock.tries, 1u, 8u);
        if (clock.is_full != 0) grow(contacts_->needed());
        if (clock.is_over == 0) {
            gl::barrier(gl::Barrier::storage);  // the copy has to have read the clock
            make_tries();
        }
        if (!contacts_ && clock.dropped_rows > 0 && !std::exchange(has_warned_, true))
            log_warning(fmt::format(
                "{} contacts with colliders had no place on the device; there nodes are only kept outside",
                clock.dropped_rows));
    }
}

}  // namespace gelatin::gpu
