#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cpu/proximity/proximity.h"
#include "gelatin/scene.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::test {

/// What a backend has found in a model's start, laid out as by cpu::FindProximities; converted exactly.
struct FoundProximities {
    std::vector<cpu::Proximity<double>> proximities;
    std::vector<std::uint32_t> starts;

    bool operator==(const FoundProximities&) const = default;
};

/// @param settings radius, self_collision and broad_phase count
template <class Real>
FoundProximities find_proximities_on_cpu(const Model& model, const CollisionSettings& settings);

/// Every buffer that is written poisoned first, the stage run twice. Empty if anything behind a buffer's end
/// was written.
/// @param capacity of what is written; the rest is lost
struct FoundOnGpu : FoundProximities {
    ProximityMeasure measure;
    std::uint32_t lost_pairs = 0;
    bool is_guarded = false;  ///< nothing was written behind what was found
};
/// Every buffer that is written poisoned first, the stage run twice.
/// @param capacity of what is written; the rest is lost
FoundOnGpu find_proximities_on_gpu(const Model& model, const CollisionSettings& settings,
                                   std::optional<std::size_t> capacity = {});

/// Held against all nodes with all faces and all edges with all edges, one by one, in extended precision.
struct ProximityErrors {
    std::size_t compared = 0;  ///< pairs
    std::size_t expected = 0;  ///< pairs nearer than the radius by more than their bound
    std::size_t missing = 0;   ///< of these
    std::size_t wrong = 0;     ///< found, but farther than the radius by more than their bound, or not a pair
    std::size_t disordered = 0;    ///< neighbours in the result that are not in ascending order
    std::size_t not_mirrored = 0;  ///< pairs of edges that the other edge does not see with the same bits
    double distance = 0.0;         ///< largest error of a distance over its bound
    double points = 0.0;           ///< largest error of `apart`, over its bound
    double weights = 0.0;          ///< largest distance of a weight from [0, 1], and of their sums from 1

    bool are_none() const {
        return missing + wrong + disordered + not_mirrored == 0 && distance <= 1.0 && points <= 1.0 &&
               weights <= 1e-6;
    }
};

/// Distances may be off by 4 eps times the extent of the pair over the sine that its normal is made of, at
/// least that of kParallel; the vector between the points by 32 times that (docs/collision.md).
template <class Real>
ProximityErrors check_proximities(const Model& model, const CollisionSettings& settings,
                                  const FoundProximities& found);

/// A test failure that lists all of them, if there are any.
void expect_none(const ProximityErrors& errors);

/// Shapes that rounding and counting have trouble with, each with a radius at which much is near.
struct ProximityScene {
    const char* name;
    Model (*make)();
    double radius;  ///< [m]
};
extern const std::vector<ProximityScene> kProximityScenes;

}  // namespace gelatin::test
