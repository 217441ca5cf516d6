#include "sim/recording/recorded_frame.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/packed_arrays.h"
#include "gelatin/error.h"
#include "model/spring_packing.h"
#include "sim/recording/compression.h"
#include "sim/recording/residuals.h"

namespace gelatin {
namespace {

// Faster ones hardly compress better: what predictions leave is noise.
constexpr int kFrameLevel = 1;
constexpr std::size_t kColumns = 4;

using Values = std::vector<glm::vec4>;

// The arrays of a frame that have a value for each node, in the order in which they are predicted.
enum Array : std::size_t { positions, velocities, earlier_velocities, contact_forces, friction, holds };
constexpr std::size_t kArrays = holds + 1;

struct Arrays {
    std::array<Values, kArrays> of;
};

Values in_single(const std::vector<glm::dvec3>& values) {
    Values result;
    result.reserve(values.size());
    for (const glm::dvec3& value : values) result.emplace_back(glm::vec3(value), 0.0f);
    return result;
}
std::vector<glm::dvec3> in_double(const Values& values) {
    return {values.begin(), values.end()};
}

// Sums of forces are what users read: of these no bit may be lost.
Arrays arrays_of(const RecordedFrame& frame) {
    const State& state = frame.moment.state;
    std::vector<glm::dvec3> forces = frame.contacts.normal;
    for (std::size_t n = 0; n < forces.size(); ++n) forces[n] += frame.contacts.friction[n];
    return {{{state.positions, state.velocities, state.earlier_velocities, in_single(forces),
              in_single(frame.contacts.friction), in_single(frame.holds.nodes)}}};
}

/// Predicts the values of nodes: from the frame before, and from what nodes before them have done since.
class Prediction {
public:
    /// @param previous null: there is no frame before
    Prediction(const EarlierNeighbours& neighbours, const RecordedFrame* previous, double time)
        : neighbours_(neighbours),
          time_(previous != nullptr ? static_cast<float>(time - previous->moment.time) : 0.0f) {
        if (previous != nullptr) previous_ = arrays_of(*previous);
    }

    /// Begins with an array. @param arrays the ones before it are known
    void begin(std::size_t array, const Arrays& arrays, std::size_t count) {
        array_ = array;
        bases_ = previous_.of[array];
        // Where steps are frames, velocities are what nodes have come by, and the earlier ones those of the
        // frame before.
        if (array == velocities && time_ > 0.0f) {
            for (std::size_t n = 0; n < count; ++n)
                for (int k = 0; k < 3; ++k)
                    bases_[n][k] = (arrays.of[positions][n][k] - previous_.of[positions][n][k]) / time_;
        }
        if (array == earlier_velocities) bases_ = previous_.of[velocities];
        bases_.resize(count, glm::vec4(0.0f));
    }

    /// @param values those of nodes before `node` are known
    glm::vec4 of(std::size_t node, const Values& values) const {
        const glm::vec4 base = bases_[node];
        if (array_ > velocities) return base;
        glm::vec4 changes(0.0f);
        float count = 0.0f;
        for (const std::uint32_t other : neighbours_[node]) {
            if (other == kNoNode) continue;
            changes += values[other] - bases_[other];
            count += 1.0f;
        }
        if (count == 0.0f) return base;
        changes /= count;
        changes.w = 0.0f;
        return base + changes;
    }

private:
    const EarlierNeighbours& neighbours_;
    float time_;  // since the frame before [s]
    Arrays previous_;
    std::size_t array_ = 0;
    Values bases_;
};

// Values of nodes by column.
void append_array(const Values& values, const Prediction& prediction, std::string& bytes) {
    const std::size_t count = values.size();
    std::vector<std::uint32_t> residuals(kColumns * count);
    for (std::size_t n = 0; n < count; ++n) {
        const glm::vec4 predicted = prediction.of(n, values);
        for (std::size_t c = 0; c < kColumns; ++c) {
            const auto k = static_cast<int>(c);
            residuals[c * count + n] = residual(values[n][k], predicted[k]);
        }
    }
    for (std::size_t c = 0; c < kColumns; ++c)
        append_planes(std::span(residuals).subspan(c * count, count), bytes);
}

bool read_array(std::string_view& bytes, const Prediction& prediction, Values& values) {
    const std::size_t count = values.size();
    std::vector<std::uint32_t> residuals(kColumns * count);
    for (std::size_t c = 0; c < kColumns; ++c)
        if (!read_planes(bytes, std::span(residuals).subspan(c * count, count))) return false;
    for (std::size_t n = 0; n < count; ++n) {
        const glm::vec4 predicted = prediction.of(n, values);
        for (std::size_t c = 0; c < kColumns; ++c) {
            const auto k = static_cast<int>(c);
            values[n][k] = with_residual(predicted[k], residuals[c * count + n]);
        }
    }
    return true;
}

[[noreturn]] void refuse() {
    throw InvalidInput({{}, 0, {}, {}, "is damaged"});
}

// Those of the frame before cost nothing. Others would take a third of the bytes, for the first guess of a
// run that continues there: these are in frames that are not predicted.
bool keeps_earlier_velocities(const RecordedFrame& frame, const RecordedFrame* previous) {
    return previous == nullptr || frame.moment.state.earlier_velocities == previous->moment.state.velocities;
}

struct Fixed {  // of a frame, before its arrays
    std::int32_t frame;
    std::int32_t is_as_before;  // 1: what programs want of handles is as in the frame before, and left out
    double time;
    std::uint64_t counts[kArrays];
};

}  // namespace

std::string encoded_frame(const RecordedFrame& frame, const EarlierNeighbours& neighbours,
                          const RecordedFrame* previous) {
    const Checkpoint& moment = frame.moment;
    Arrays arrays = arrays_of(frame);
    if (!keeps_earlier_velocities(frame, previous)) arrays.of[earlier_velocities].clear();
    const bool is_as_before = previous != nullptr && moment.programmed == previous->moment.programmed;
    Fixed fixed{moment.frame, is_as_before ? 1 : 0, moment.time, {}};
    for (std::size_t a = 0; a < kArrays; ++a) fixed.counts[a] = arrays.of[a].size();
    ArrayWriter small;
    small.add(std::vector<Fixed>{fixed});
    small.add(moment.drags);
    small.add(moment.drag_targets);
    small.add(moment.delays);
    small.add(is_as_before ? std::vector<char>()
                           : std::vector<char>(moment.programmed.begin(), moment.programmed.end()));
    small.add(frame.contacts.between);
    small.add(frame.holds.by_handle);
    small.add(frame.holds.torques);
    ArrayWriter all;
    all.add(std::vector<char>(small.bytes().begin(), small.bytes().end()));
    std::string bytes = all.bytes();
    Prediction prediction(neighbours, previous, moment.time);
    for (std::size_t a = 0; a < kArrays; ++a) {
        prediction.begin(a, arrays, arrays.of[a].size());
        append_array(arrays.of[a], prediction, bytes);
    }
    return compressed(bytes, kFrameLevel);
}

RecordedFrame decoded_frame(std::string_view bytes, const Model& model, const EarlierNeighbours& neighbours,
                            const RecordedFrame* previous) {
    const std::size_t nodes = model.node_count(), handles = model.handles.size(),
                      objects = model.objects.size();
    constexpr std::size_t kMostProgrammed = std::size_t(1) << 30;  // of what programs have made and set
    const std::size_t most = 4096 + kMostProgrammed + kArrays * nodes * sizeof(glm::vec4) +
                             handles * (2 * sizeof(Drag) + 7 * sizeof(double)) +
                             handles * 5 * sizeof(double) +
                             model.handle_nodes.size() * 2 * sizeof(glm::dvec3) +
                             objects * (objects + model.colliders.size()) * sizeof(ContactForces::Between);
    const std::string content = decompressed(bytes, most);
    std::vector<char> head;
    ArrayReader all(content);
    if (!all.take(head)) refuse();
    const std::string small(head.begin(), head.end());
    ArrayReader reader(small);
    RecordedFrame frame;
    Checkpoint& moment = frame.moment;
    std::vector<Fixed> fixed;
    std::vector<char> programmed;
    const bool is_whole = reader.take(fixed) && reader.take(moment.drags) &&
                          reader.take(moment.drag_targets) && reader.take(moment.delays) &&
                          reader.take(programmed) && reader.take(frame.contacts.between) &&
                          reader.take(frame.holds.by_handle) && reader.take(frame.holds.torques) &&
                          reader.at_end() && fixed.size() == 1;
    if (!is_whole || moment.drags.size() != handles || moment.drag_targets.size() != handles ||
        moment.delays.size() != handles || (fixed[0].is_as_before != 0 && previous == nullptr))
        refuse();
    moment.frame = fixed[0].frame;
    moment.programmed = fixed[0].is_as_before != 0 ? previous->moment.programmed
                                                   : std::string(programmed.begin(), programmed.end());
    moment.time = fixed[0].time;

    std::string_view left = std::string_view(content).substr(sizeof(std::uint64_t) + small.size());
    Arrays arrays;
    Prediction prediction(neighbours, previous, moment.time);
    for (std::size_t a = 0; a < kArrays; ++a) {
        const std::uint64_t count = fixed[0].counts[a];
        if (count != nodes && (count != 0 || a == positions || a == velocities)) refuse();
        prediction.begin(a, arrays, count);
        arrays.of[a].resize(count);
        if (!read_array(left, prediction, arrays.of[a])) refuse();
    }
    if (!left.empty()) refuse();
    moment.state = {arrays.of[positions], arrays.of[velocities], arrays.of[earlier_velocities]};
    frame.contacts.normal = in_double(arrays.of[contact_forces]);
    frame.contacts.friction = in_double(arrays.of[friction]);
    if (frame.contacts.normal.size() != frame.contacts.friction.size()) refuse();
    for (std::size_t n = 0; n < nodes && !frame.contacts.normal.empty(); ++n)
        frame.contacts.normal[n] -= frame.contacts.friction[n];
    frame.holds.nodes = in_double(arrays.of[holds]);
    return frame;
}

}  // namespace gelatin
