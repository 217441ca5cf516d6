#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/find_pairs.h"
#include "gelatin/pull.h"
#include "model/model.h"

namespace gelatin::test {

/// How a step begins, and of which state.
struct StartCase {
    std::shared_ptr<const Model> model = nullptr;
    float size = 1.0f / 240.0f;  ///< of the step [s]
    float left = 0.0f;           ///< of it, of which a part may be as long as 0.6; 0: no part is made yet [s]
    bool divides = false;
    float last_step = 0.0f;                  ///< [s]
    bool has_memory = false, damps = false;  ///< contacts of the part before
    std::vector<std::uint8_t> paces{0, 0}, struck{0, 0};
    bool has_pulls = false;
    std::size_t capacity = 10000;  ///< of rows
    bool has_pairs = false;        ///< bodies touch each other, and themselves
};

/// What is near each other in a try, by objects, with numbers that float has, too.
struct NearPairs {
    std::vector<cpu::NearPair<double>> pairs;
    float fastest = 0.0f;  ///< as in PairCounts
};

/// The last try of its first part, and what is solved then.
struct StartResult {
    StepClock clock{};
    std::vector<BodyPace> paces;
    std::vector<cpu::ContactRow<double>> rows;
    std::vector<glm::dvec3> velocities, predicted, loads, guesses, solved;  ///< of nodes
    std::vector<double> compliances, inertia, enough;
    std::vector<NearPairs> near;         ///< of each try
    std::vector<std::uint32_t> islands;  ///< of each body the least one
};

/// What a state has besides, made at random.
struct StartInputs {
    std::vector<glm::vec4> earlier_velocities;
    std::vector<PlaneMemory> memories;           ///< by collider and node
    std::vector<cpu::ContactRow<double>> known;  ///< rows of pairs of the part before, as they were noted
    std::vector<Pull> pulls;
};

constexpr int kStartIterations = 10;  ///< of the solve

/// cpu::ImplicitStep<double>::run up to where a part is solved, tries that are given up among it.
std::pair<StartInputs, StartResult> part_start_reference(const StartCase& at);

/// Of a contact of a node with a collider.
inline std::uint64_t key_of_contact(std::uint64_t collider, std::uint32_t node) {
    return std::uint64_t(1) << 62 | collider << 31 | node;
}

}  // namespace gelatin::test
