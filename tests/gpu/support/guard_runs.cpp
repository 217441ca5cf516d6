#include "gpu/support/guard_runs.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/disjoint_sets.h"
#include "cpu/collision/time_of_impact.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/find_pairs.h"
#include "cpu/implicit/guard.h"
#include "gpu/implicit/pair_guard.h"
#include "model/contact/contact_surface.h"
#include "model/corners.h"
#include "support/converted.h"

namespace gelatin::test {
namespace {

namespace tuning = cpu::tuning;

// What both sides begin with.
template <class Real>
struct GuardedWays {
    std::vector<cpu::Vec4<Real>> from, to;
    std::vector<Real> compliances;

    explicit GuardedWays(const Wishes& wishes, const ContactSurface& surface)
        : from(converted<Real>(wishes.model->positions)),
          to(converted<Real>(wishes.expected.empty() ? wishes.ends : wishes.expected)),
          compliances(wishes.compliances.begin(), wishes.compliances.end()) {
        for (std::size_t n = compliances.size(); n < from.size(); ++n) {
            const double w = static_cast<double>(from[n].w),
                         h = static_cast<double>(surface.stiffness[n]) / 3.0;
            compliances.push_back(
                w > 0.0 ? static_cast<Real>(1.0 / (1.0 / (w * tuning::kFrame * tuning::kFrame) + h))
                        : Real(0));
        }
    }
    cpu::Paths<Real> paths() const { return {from, to}; }
};

template <class T>
std::vector<T> downloaded(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(values);
    return values;
}

NearPair packed(const cpu::NearPair<float>& near) {
    const cpu::ContactPair& pair = near.pair;
    NearPair result{};
    result.node_0 = pair.nodes[0];
    result.node_1 = pair.nodes[1];
    result.node_2 = pair.nodes[2];
    result.node_3 = pair.nodes[3];
    result.weights = near.weights;
    result.normal = glm::vec4(near.normal, near.gap);
    result.first = pair.first;
    result.second = pair.second;
    result.is_edges = pair.is_edges() ? 1 : 0;
    result.object = pair.object;
    result.other = pair.other;
    result.reach = pair.reach;
    result.rounding = near.rounding;
    return result;
}

class GuardOnGpu {
public:
    explicit GuardOnGpu(const Wishes& wishes)
        : wishes_(wishes),
          model_(*wishes.model),
          surface_(std::make_shared<ContactSurface>(make_contact_surface(model_, {}))),
          ways_(wishes, *surface_),
          finder_(wishes.model, surface_, wishes.own),
          buffers_(model_),
          state_(model_, *surface_),
          pairs_(model_, capacity()),
          guard_(model_, state_, pairs_) {
        std::vector<glm::vec4> predicted;
        for (const float compliance : ways_.compliances) predicted.emplace_back(0, 0, 0, compliance);
        state_.predicted.values.upload(predicted);
        state_.to.positions.upload(wishes.ends);
        pairs_.path_ends.values.upload(ways_.to);
        finder_.begin(ways_.paths());
        finder_.run(ways_.paths());
        if (!wishes.capacity) {
            pairs_ = gpu::PairBuffers(model_, {1, 1, 1, 8 * finder_.pairs().size() + 64});
            pairs_.path_ends.values.upload(ways_.to);
            guard_.grow();
        }
    }

    Guarded run() {
        Guarded result;
        StepClock clock{};
        clock.size = clock.step = 1.0f / 240.0f;
        if (!wishes_.is_long) clock.step /= static_cast<float>(contact_tuning::kMostParts);
        do {
            upload_pairs();
            clock.goes_on = 1;
            state_.tries.set_clock(clock);
            guard_.run(buffers_);
            if (++result.runs == 1) result.clipped = downloaded(guard_.found())[0].clipped;
            const bool has_lost = finder_.find_lost(downloaded(state_.to.positions)) || wishes_.loses_always;
            upload_counts(has_lost);
            guard_.decide(tuning::kMostRounds);
            clock = state_.tries.clock();
            follow_paths();
        } while (clock.guards != 0 && result.runs <= tuning::kMostRounds);
        result.clock = clock;
        const GuardState found = downloaded(guard_.found())[0];
        result.is_changed = found.is_changed != 0;
        result.is_given_up = found.is_given_up != 0;
        result.ends = doubles(downloaded(state_.to.positions));
        result.path_ends = doubles(ways_.to);
        return result;
    }

private:
    gpu::PairCapacity capacity() const { return {1, 1, 1, wishes_.capacity.value_or(1)}; }

    static std::vector<glm::dvec4> doubles(const std::vector<glm::vec4>& values) {
        return {values.begin(), values.end()};
    }

    void upload_pairs() {
        std::vector<NearPair> packed_pairs;
        DisjointSets sets(model_.objects.size());
        for (const cpu::NearPair<float>& near : finder_.pairs()) {
            packed_pairs.push_back(packed(near));
            sets.unite(near.pair.object, near.pair.other);
        }
        if (packed_pairs.size() > pairs_.capacity.pairs) packed_pairs.resize(pairs_.capacity.pairs);
        pairs_.pairs.values.upload(packed_pairs);
        std::vector<std::uint32_t> islands;
        for (std::uint32_t o = 0; o < model_.objects.size(); ++o) islands.push_back(sets.least(o));
        guard_.islands.values.upload(islands);
        upload_counts(false);
    }
    void upload_counts(bool has_lost) {
        PairCounts counts{};
        counts.pairs = static_cast<std::uint32_t>(finder_.pairs().size());
        counts.has_lost = has_lost ? 1 : 0;
        counts.is_full = wishes_.is_full ? 1 : 0;
        pairs_.counts.upload(std::vector{counts});
    }
    void follow_paths() {
        const std::vector<glm::vec4> path_ends = downloaded(pairs_.path_ends.values);
        std::vector<std::uint32_t> strays;
        for (std::uint32_t n = 0; n < path_ends.size(); ++n)
            if (path_ends[n] != ways_.to[n]) strays.push_back(n);
        ways_.to = path_ends;
        finder_.update(ways_.paths(), strays);
    }

    const Wishes& wishes_;
    const Model& model_;
    std::shared_ptr<const ContactSurface> surface_;
    GuardedWays<float> ways_;
    cpu::FindPairs<float> finder_;
    gpu::ModelBuffers buffers_;
    gpu::StepState state_;
    gpu::PairBuffers pairs_;
    gpu::PairGuard guard_;
};

struct Sweep {
    glm::dvec3 low{1e30}, high{-1e30};
    cpu::Moving<double, 3> face;
};

// Straight ways stay straight in pieces. The predicate is sure that two keep apart, not that they do not.
bool may_touch(const cpu::Moving<double, 3>& a, const cpu::Moving<double, 3>& b, int halvings) {
    if (!cpu::time_of_impact(a, b)) return false;
    if (halvings == 0) return true;
    return may_touch({a.start, a.at(0.5)}, {b.start, b.at(0.5)}, halvings - 1) ||
           may_touch({a.at(0.5), a.end}, {b.at(0.5), b.end}, halvings - 1);
}

}  // namespace

template <class Real>
Guarded guard_on_cpu(const Wishes& wishes) {
    const Model& model = *wishes.model;
    const auto surface = std::make_shared<const ContactSurface>(make_contact_surface(model, {}));
    GuardedWays<Real> ways(wishes, *surface);
    cpu::FindPairs<Real> finder(wishes.model, surface, wishes.own);
    cpu::Guard<Real> guard(wishes.model, surface);
    Guarded result;
    std::vector<cpu::Vec4<Real>> ends = converted<Real>(wishes.ends);
    finder.begin(ways.paths());
    finder.run(ways.paths());
    while (result.runs < tuning::kMostRounds) {
        std::vector<std::uint8_t> is_blocked;
        const std::vector<std::uint32_t> strays =
            guard.run(ways.paths(), finder.pairs(), ways.compliances, ends, is_blocked);
        if (++result.runs == 1) result.clipped = guard.clipped_pairs();
        const bool has_lost = finder.find_lost(ends) || wishes.loses_always;
        result.is_changed = result.is_changed || guard.has_changed();
        for (const std::uint32_t n : strays) ways.to[n] = ends[n];
        result.path_ends = {ways.to.begin(), ways.to.end()};
        result.ends = {ends.begin(), ends.end()};
        if (strays.empty() && !has_lost) return result;
        finder.update(ways.paths(), strays);
    }
    result.is_changed = result.is_given_up = true;
    result.ends = {ways.from.begin(), ways.from.end()};
    return result;
}

template Guarded guard_on_cpu<float>(const Wishes& wishes);
template Guarded guard_on_cpu<double>(const Wishes& wishes);

Guarded guard_on_gpu(const Wishes& wishes) {
    return GuardOnGpu(wishes).run();
}

bool touch_on_the_way(const Wishes& wishes, const std::vector<glm::dvec4>& ends) {
    const Model& model = *wishes.model;
    std::vector<Sweep> sweeps;
    for (const Face& face : model.faces) {
        Sweep& sweep = sweeps.emplace_back();
        std::size_t k = 0;
        for (const std::uint32_t n : corners_of(face)) {
            sweep.face.start[k] = glm::dvec3(model.positions[n]);
            sweep.face.end[k] = glm::dvec3(ends[n]);
            for (const glm::dvec3& x : {sweep.face.start[k], sweep.face.end[k]}) {
                sweep.low = glm::min(sweep.low, x);
                sweep.high = glm::max(sweep.high, x);
            }
            ++k;
        }
    }
    for (std::size_t a = 0; a < sweeps.size(); ++a) {
        for (std::size_t b = a + 1; b < sweeps.size(); ++b) {
            const Face &face = model.faces[a], &other = model.faces[b];
            const auto &corners = corners_of(face), &others = corners_of(other);
            const bool is_own = face.object == other.object;
            if (is_own && (!wishes.own || std::any_of(corners.begin(), corners.end(), [&](std::uint32_t n) {
                    return std::find(others.begin(), others.end(), n) != others.end();
                })))
                continue;
            if (!model.is_body(face.object) && !model.is_body(other.object)) continue;
            if (glm::any(glm::greaterThan(sweeps[a].low, sweeps[b].high)) ||
                glm::any(glm::greaterThan(sweeps[b].low, sweeps[a].high)))
                continue;
            if (may_touch(sweeps[a].face, sweeps[b].face, 7)) return true;
        }
    }
    return false;
}

}  // namespace gelatin::test
