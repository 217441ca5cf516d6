#include "gpu/support/part_start_on_gpu.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "gpu/support/start_errors.h"

namespace gelatin::test {
namespace {

using cpu::ContactRow;

std::vector<glm::dvec3> vectors_of(const gl::Buffer<glm::vec4>& buffer) {
    std::vector<glm::dvec3> result;
    for (const glm::vec4& value : downloaded(buffer)) result.emplace_back(value);
    return result;
}

std::vector<double> last_values_of(const gl::Buffer<glm::vec4>& buffer) {
    std::vector<double> result;
    for (const glm::vec4& value : downloaded(buffer)) result.push_back(static_cast<double>(value.w));
    return result;
}

ContactRow<double> contact_of(const StepRow& row, const std::vector<std::uint32_t>& object_of) {
    ContactRow<double> result;
    result.object = kNoNode;
    const std::array<std::uint32_t, 4> nodes{row.node_0, row.node_1, row.node_2, row.node_3};
    for (std::size_t k = 0; k < 4; ++k) {
        const double weight = static_cast<double>(row.weights[static_cast<int>(k)]);
        if (weight == 0.0) continue;
        result.nodes[result.count] = nodes[k];
        result.weights[result.count++] = weight;
        (weight < 0.0 ? result.object : result.other) = object_of[nodes[k]];
    }
    result.normal = glm::dvec3(row.normal);
    result.gap = static_cast<double>(row.normal.w);
    result.ease = static_cast<double>(row.ease);
    result.reach = static_cast<double>(row.reach);
    result.stiffness = static_cast<double>(row.stiffness);
    result.damping = static_cast<double>(row.damping);
    result.friction = static_cast<double>(row.friction);
    result.hold = glm::dvec3(row.hold);
    result.limit = static_cast<double>(row.hold.w);
    if (row.plane != packing::kNone) result.key = key_of_contact(row.plane, row.node_0);
    return result;
}

std::vector<PairSlot> slots_of(const std::vector<cpu::NearPair<double>>& near) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (const auto& [pair, normal, weights, gap, rounding] : near) {
        sides.emplace(pair.object, pair.other);
        sides.emplace(pair.other, pair.object);
    }
    std::vector<PairSlot> slots;
    std::uint32_t next = 0;
    for (const auto& [object, other] : sides) {
        PairSlot& slot = slots.emplace_back(PairSlot{object, other, next, next});
        while (next < near.size() && near[next].pair.object == object && near[next].pair.other == other)
            slot.pair_end = ++next;
    }
    return slots;
}

NearPair near_pair_of(const cpu::NearPair<double>& near, std::uint32_t slot) {
    const auto& [a, b, c, d] = near.pair.nodes;
    return {a,
            b,
            c,
            d,
            glm::vec4(near.weights),
            glm::vec4(near.normal, near.gap),
            near.pair.first,
            near.pair.second,
            near.pair.is_edges() ? 1u : 0u,
            slot,
            near.pair.object,
            near.pair.other,
            near.pair.reach,
            static_cast<float>(near.rounding)};
}

gpu::PairRows::Memory memory_of(const std::vector<ContactRow<double>>& rows, std::uint32_t node_count) {
    gpu::PairRows::Memory memory;
    std::vector<std::vector<std::uint32_t>> entries(node_count);
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const ContactRow<double>& row = rows[r];
        for (std::uint32_t k = 0; k < row.count; ++k) entries[row.nodes[k]].push_back(4 * r + k);
        const auto low = static_cast<std::uint32_t>(row.key & 0x7FFFFFFFu);
        memory.rows.push_back({glm::vec4(row.hold, row.limit), static_cast<float>(row.reach),
                               static_cast<std::uint32_t>(row.key >> 31 & 0x7FFFFFFFu), low,
                               static_cast<std::uint32_t>(row.key >> 63)});
    }
    for (const std::vector<std::uint32_t>& list : entries) {
        memory.starts.push_back(static_cast<std::uint32_t>(memory.entries.size()));
        memory.entries.insert(memory.entries.end(), list.begin(), list.end());
    }
    memory.starts.push_back(static_cast<std::uint32_t>(memory.entries.size()));
    return memory;
}

constexpr std::size_t kMostPairs = 20000;

gpu::PairCapacity pair_capacity(const Model& model) {
    return {model.objects.size() * model.objects.size(), 1, 1, kMostPairs};
}

}  // namespace

StartOnGpu::StartOnGpu(const StartCase& at, const StartInputs& inputs, std::vector<NearPairs> near)
    : buffers(*at.model),
      surface(make_contact_surface(*at.model, {})),
      state(*at.model, surface),
      system(*at.model, state.tries,
             at.has_pairs
                 ? gpu::RowCapacity{at.capacity, at.model->body_count() + pair_capacity(*at.model).slots}
             : at.model->colliders.empty() ? gpu::RowCapacity{}
                                           : gpu::RowCapacity{at.capacity, at.model->body_count()},
             0),  // a software driver ends long loops early (docs/gpu-status.md)
      pairs(at.has_pairs ? std::optional<gpu::PairBuffers>(std::in_place, *at.model, pair_capacity(*at.model))
                         : std::nullopt),
      pair_rows(at.has_pairs
                    ? std::optional<gpu::PairRows>(std::in_place, *at.model, surface, state, system, *pairs)
                    : std::nullopt),
      start(*at.model, state, system, pair_rows ? &*pair_rows : nullptr),
      case_(at),
      model_(*at.model),
      near_(std::move(near)) {
    if (!model_.loads.empty()) loads_.emplace(model_).run(state.from);
    buffers.pulls.set_pulls(inputs.pulls);
    system.set_iterations(kStartIterations);
    std::vector<glm::vec4> accelerations;
    for (std::uint32_t n = 0; n < model_.node_count() && at.last_step > 0.0f; ++n)
        accelerations.push_back((model_.velocities[n] - inputs.earlier_velocities[n]) / at.last_step);
    state.accelerations.values.upload(accelerations);
    if (!inputs.memories.empty()) state.plane_memories.upload(inputs.memories);
    if (!inputs.known.empty()) pair_rows->set_memory(memory_of(inputs.known, model_.node_count()));
    std::vector<BodyPace> paces(model_.objects.size());
    for (std::size_t o = 0; o < model_.body_count(); ++o) {
        paces[o].pace = at.paces[o];
        paces[o].is_struck = at.struck[o];
    }
    state.paces.values.upload(paces);
    StepClock clock{};
    clock.last_step = at.last_step;
    clock.parts = 1;
    state.tries.set_clock(clock);
    // What is left of a solve before.
    system.loads().upload(std::vector<glm::vec4>(model_.node_count(), glm::vec4(1.0f, 2.0f, 3.0f, 1e3f)));
    start.begin_step(state.from, {static_cast<double>(at.size), at.divides});
    clock = read_clock();
    clock.damps = at.damps ? 1 : 0;
    if (at.left > 0.0f) {
        clock.left = at.left;
        clock.longest = 0.6f * at.left;
        clock.made = clock.begun = 1;
    }
    state.tries.set_clock(clock);
}

void StartOnGpu::upload(const NearPairs& near) {
    const std::vector<PairSlot> slots = slots_of(near.pairs);
    std::vector<std::uint32_t> starts;
    for (std::uint32_t o = 0; o <= model_.objects.size(); ++o)
        starts.push_back(
            static_cast<std::uint32_t>(std::lower_bound(slots.begin(), slots.end(), o,
                                                        [](const PairSlot& slot, std::uint32_t object) {
                                                            return slot.object < object;
                                                        }) -
                                       slots.begin()));
    std::vector<NearPair> all;
    for (std::uint32_t s = 0; s < slots.size(); ++s)
        for (std::uint32_t p = slots[s].first_pair; p < slots[s].pair_end; ++p)
            all.push_back(near_pair_of(near.pairs[p], s));
    PairCounts counts{};
    counts.slots = static_cast<std::uint32_t>(slots.size());
    counts.pairs = static_cast<std::uint32_t>(all.size());
    counts.fastest = near.fastest;
    pairs->counts.upload(std::vector{counts});
    if (read_clock().goes_on == 0) return;  // nor would the device
    state.tries.set_count(pair_stages::kNearPairs, counts.pairs);
    state.tries.set_count(pair_stages::kSlotGroups, counts.slots, 1);
    pairs->slot_starts.values.upload(starts);
    pairs->slots.values.upload(slots);
    pairs->pairs.values.upload(all);
}

bool StartOnGpu::run() {
    bool is_untouched = true;
    const gpu::SumLoads* loads = loads_ ? &*loads_ : nullptr;
    for (std::size_t k = 0; k < 12; ++k) {
        if (pairs) {
            start.predict(buffers, loads);
            upload(near_[std::min(k, near_.size() - 1)]);
            start.find_rows(buffers, loads);
            start.linearise(buffers, loads);
        } else {
            start.run(buffers, loads);
        }
        if (read_clock().goes_on != 0) return is_untouched;
        const std::vector<glm::dvec3> before = vectors_of(system.displacements());
        system.solve(state.from);
        is_untouched = is_untouched && vectors_of(system.displacements()) == before;
    }
    return false;
}

std::vector<ContactRow<double>> StartOnGpu::rows() const {
    const std::vector<std::uint32_t> object_of = model_.node_objects;
    std::vector<StepRow> all = downloaded(system.buffers().rows.values);
    all.resize(read_clock().row_count);
    std::vector<ContactRow<double>> rows;
    for (const StepRow& row : all) rows.push_back(contact_of(row, object_of));
    return rows;
}

StartResult StartOnGpu::result() {
    StartResult result;
    result.clock = read_clock();
    result.paces = downloaded(state.paces.values);
    result.paces.resize(model_.body_count());
    result.rows = rows();
    result.velocities = vectors_of(state.from.velocities);
    result.predicted = vectors_of(state.predicted.values);
    result.compliances = last_values_of(state.predicted.values);
    result.loads = vectors_of(system.loads());
    result.inertia = last_values_of(system.loads());
    result.guesses = vectors_of(system.displacements());
    for (const float enough : downloaded(system.enough()))
        result.enough.push_back(static_cast<double>(enough));
    result.enough.resize(model_.body_count());
    // With as many iterations as the reference, whatever rounding is.
    std::vector<float> less(result.enough.begin(), result.enough.end());
    for (float& enough : less) enough *= 1e-3f;
    system.enough().upload(less);
    system.begin_bodies(state.from);
    system.solve(state.from);
    result.solved = vectors_of(system.displacements());
    return result;
}

std::vector<std::uint32_t> key_of(const ContactRow<double>& row) {
    std::vector<std::uint32_t> key{row.object, row.other, row.object == kNoNode ? row.plane() : 0};
    for (std::uint32_t k = 0; k < row.count; ++k) {
        key.push_back(row.nodes[k]);
        key.push_back(row.weights[k] < 0.0 ? 0 : 1);
    }
    return key;
}

namespace {

using Rows = std::vector<ContactRow<double>>;

// Without those that hardly press: whether there are any is up to rounding.
void sort_by_key(Rows& rows, double stiffest) {
    std::erase_if(rows, [&](const auto& row) { return row.stiffness < 1e-3 * stiffest; });
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return key_of(a) < key_of(b); });
}

// Forces by what a contact exerts over a length that counts.
void compare_rows(Rows actual, Rows expected, StartErrors& errors) {
    double stiffest = 0.0;
    for (const ContactRow<double>& row : expected) stiffest = std::max(stiffest, row.stiffness);
    sort_by_key(actual, stiffest);
    sort_by_key(expected, stiffest);
    errors.require(actual.size() == expected.size());
    if (actual.size() != expected.size()) return;
    for (std::size_t r = 0; r < expected.size(); ++r) {
        const ContactRow<double>&a = actual[r], &e = expected[r];
        errors.require(key_of(a) == key_of(e));
        const double length = 1e-6, force = e.stiffness * length;
        for (std::uint32_t k = 0; k < e.count; ++k) errors.add(a.weights[k], e.weights[k], 1e-6);
        errors.add(a.normal, e.normal, 1e-5);
        errors.add(a.gap, e.gap, length);
        errors.add(a.ease, e.ease, length);
        errors.add(a.reach, e.reach, length);
        const bool is_plane = e.object == kNoNode;  // others have a weight
        errors.add(a.stiffness, e.stiffness, is_plane ? 1e-5 * e.stiffness : 1e-4 * stiffest);
        errors.add(a.damping, e.damping, 1e-3 * e.damping + 1e-30);
        errors.add(a.friction, e.friction, 1e-6);
        errors.add(a.hold, e.hold, force);
        errors.add(a.limit, e.limit, force + 1e-3 * e.limit);
    }
}

void compare_bodies(const std::vector<BodyPace>& actual, const std::vector<BodyPace>& expected,
                    StartErrors& errors) {
    for (std::size_t o = 0; o < expected.size(); ++o) {
        const BodyPace &a = actual[o], &e = expected[o];
        errors.require(a.pace == e.pace && a.is_struck == e.is_struck && a.is_held == e.is_held &&
                       a.held_count == e.held_count);
        errors.require(a.past == e.past && a.damping == e.damping);
        const double mass = static_cast<double>(e.velocity.w);
        errors.add(a.velocity.w, e.velocity.w, 1e-5 * mass);
        errors.add(glm::dvec3(a.velocity), glm::dvec3(e.velocity), 1e-5);
    }
}

}  // namespace

double start_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    StartOnGpu gpu(at, inputs, expected.near);
    const bool is_untouched = gpu.run();
    const StartResult actual = gpu.result();
    StartErrors errors;
    errors.require(is_untouched && actual.clock.tries == expected.clock.tries);
    errors.require(actual.clock.parts == expected.clock.parts);
    errors.require(actual.clock.has_past == expected.clock.has_past);
    errors.add(actual.clock.step, expected.clock.step, 1e-6 * expected.clock.step);
    errors.add(actual.velocities, expected.velocities, 1e-5);
    errors.add(actual.predicted, expected.predicted, 1e-5);
    errors.add(actual.compliances, expected.compliances, 1e-5);
    compare_bodies(actual.paces, expected.paces, errors);
    compare_rows(actual.rows, expected.rows, errors);
    errors.add(actual.inertia, expected.inertia, 1e-5);
    errors.add(actual.guesses, expected.guesses, 1e-4);
    // Elements of still bodies are damped: of rigid velocities that leaves rounding.
    const bool has_still = std::count(at.paces.begin(), at.paces.end(), 2) > 0;
    errors.add(actual.loads, expected.loads, has_still ? 5e-4 : 1e-4);
    errors.add(actual.enough, expected.enough, 1e-4);
    // Of contacts with a reach of a thousandth gaps are near rounding; of wrong tables nothing is right.
    errors.add(actual.solved, expected.solved, 4e-2);
    return errors.worst();
}

}  // namespace gelatin::test
