#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "gpu/implicit/find_pairs.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::test {

/// The length of a step [s].
constexpr double kPairStep = 1.0 / 60.0;

/// Where a part of a step begins, and where nodes would go in it.
struct PairCase {
    std::shared_ptr<const Model> model;  ///< at the start
    std::vector<glm::vec3> predicted;    ///< displacements of nodes [m]
    bool own = true;                     ///< whether bodies meet themselves
    std::vector<glm::vec3> moved = {};   ///< nodes from the start, where the part begins; none: not at all
    bool is_shortest = false;            ///< of all parts
    bool is_calm = false;                ///< all bodies
};

/// What is found on the device.
struct FoundPairs {
    PairCounts counts{};
    std::vector<PairSlot> slots;
    std::vector<std::uint32_t> slot_starts;
    std::vector<NearPair> pairs;
    std::vector<glm::vec4> path_ends, motions;

    std::vector<NearPair> listed() const { return {pairs.begin(), pairs.begin() + counts.pairs}; }
};

/// gpu::FindPairs, with all that it needs. Buffers are poisoned at first.
class PairsOnGpu {
public:
    explicit PairsOnGpu(const PairCase& at);

    /// With more room where there is too little. @param guards how often the guard has run in the part
    FoundPairs run(std::uint32_t guards = 0);
    /// With the room that there is.
    FoundPairs run_once(std::uint32_t guards = 0);
    /// Gives less than the buffers have.
    void limit(const gpu::PairCapacity& capacity);
    gpu::PairCapacity capacity() const { return pairs_.capacity; }
    /// Where the guard lets nodes go. @return PairCounts::has_lost
    bool find_lost(const std::vector<glm::vec4>& ends);
    void set_path_ends(const std::vector<glm::vec4>& ends) { pairs_.path_ends.values.upload(ends); }
    /// Whether the last slots and pairs, for which no place was given, are as they were at first.
    bool is_untouched_behind_the_end();
    /// After a try that does not go on. @return what is left
    FoundPairs give_up();

private:
    FoundPairs read() const;
    void set_clock(std::uint32_t guards, bool goes_on);

    const PairCase& case_;
    const Model& model_;
    gpu::ModelBuffers buffers_;
    ContactSurface surface_;
    gpu::StepState state_;
    gpu::PairBuffers pairs_;
    gpu::FindPairs find_;
};

/// The positions where the part begins.
std::vector<glm::vec4> begins_of(const PairCase& at);

}  // namespace gelatin::test
