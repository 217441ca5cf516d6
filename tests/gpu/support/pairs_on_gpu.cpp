#include "gpu/support/pairs_on_gpu.h"

#include <algorithm>
#include <cstring>

#include "support/crowd.h"

namespace gelatin::test {
namespace {

template <class T>
std::vector<T> all_of(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(values);
    return values;
}

template <class T>
bool is_poisoned(const std::vector<T>& values, std::size_t first) {
    std::vector<std::uint32_t> words((values.size() - first) * sizeof(T) / 4);
    std::memcpy(words.data(), values.data() + first, words.size() * 4);
    return std::all_of(words.begin(), words.end(), [](std::uint32_t word) { return word == 0xDEADBEEFu; });
}

}  // namespace

std::vector<glm::vec4> begins_of(const PairCase& at) {
    std::vector<glm::vec4> positions = at.model->positions;
    for (std::size_t n = 0; n < at.moved.size(); ++n) positions[n] += glm::vec4(at.moved[n], 0.0f);
    return positions;
}

PairsOnGpu::PairsOnGpu(const PairCase& at)
    : case_(at),
      model_(*at.model),
      buffers_(model_),
      surface_(make_contact_surface(model_, {})),
      state_(model_, surface_),
      pairs_(model_, gpu::PairCapacity::of(model_)),
      find_(model_, surface_, state_, pairs_, at.own) {
    state_.from.positions.upload(begins_of(at));
    std::vector<glm::vec4> predicted;
    for (const glm::vec3& d : at.predicted) predicted.emplace_back(d, 1.0f);
    state_.predicted.values.upload(predicted);
    std::vector<BodyPace> paces(model_.body_count());
    for (BodyPace& pace : paces) pace.pace = at.is_calm ? 1 : 0;
    state_.paces.values.upload(paces);
    poison(pairs_.counts);
    poison(pairs_.slot_starts.values);
    poison(pairs_.slots.values);
    poison(pairs_.pairs.values);
    poison(pairs_.path_ends.values);
    poison(pairs_.motions.values);
}

void PairsOnGpu::set_clock(std::uint32_t guards, bool goes_on) {
    StepClock clock{};
    clock.size = static_cast<float>(kPairStep);
    clock.step = case_.is_shortest ? clock.size / 256.0f : clock.size;
    clock.guards = guards;
    clock.goes_on = goes_on ? 1 : 0;
    state_.tries.set_clock(clock);
}

FoundPairs PairsOnGpu::run_once(std::uint32_t guards) {
    set_clock(guards, true);
    find_.run(buffers_);
    return read();
}

FoundPairs PairsOnGpu::run(std::uint32_t guards) {
    FoundPairs found = run_once(guards);
    while (found.counts.is_full != 0) {
        pairs_.grow({std::max<std::size_t>(pairs_.capacity.slots, found.counts.slots),
                     std::max<std::size_t>(pairs_.capacity.searches, found.counts.searches),
                     std::max<std::size_t>(pairs_.capacity.leaf_pairs, found.counts.leaf_pairs),
                     std::max<std::size_t>(pairs_.capacity.pairs, found.counts.pairs)});
        find_.grow();
        found = run_once(guards);
    }
    return found;
}

FoundPairs PairsOnGpu::give_up() {
    set_clock(0, false);
    find_.run(buffers_);
    return read();
}

FoundPairs PairsOnGpu::read() const {
    return {all_of(pairs_.counts)[0],    all_of(pairs_.slots.values),     all_of(pairs_.slot_starts.values),
            all_of(pairs_.pairs.values), all_of(pairs_.path_ends.values), all_of(pairs_.motions.values)};
}

void PairsOnGpu::limit(const gpu::PairCapacity& capacity) {
    pairs_.capacity = capacity;
    find_.grow();
}

bool PairsOnGpu::find_lost(const std::vector<glm::vec4>& ends) {
    find_.find_lost(gpu::NodeBuffers(ends, model_.velocities));
    return all_of(pairs_.counts)[0].has_lost != 0;
}

bool PairsOnGpu::is_untouched_behind_the_end() {
    return is_poisoned(all_of(pairs_.slots.values), pairs_.capacity.slots) &&
           is_poisoned(all_of(pairs_.pairs.values), pairs_.capacity.pairs);
}

}  // namespace gelatin::test
