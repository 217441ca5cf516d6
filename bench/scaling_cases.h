#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/scaling.h"
#include "bench/stages.h"
#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// The four tables of `gelatin bench scaling`.
enum class ScalingPart { two_bodies, faces, objects, self_collision };
const char* name_of(ScalingPart part);

/// A model, and the methods by which its collisions are found.
struct ScalingCase {
    ScalingPart part;
    std::string scene;  ///< "touching", "1000 apart"
    std::function<std::shared_ptr<const Model>()> make_model;
    std::vector<CollisionSettings> methods;
    std::vector<BenchStage> stages;
};

/// In the order of the report. Builds no model yet.
std::vector<ScalingCase> scaling_cases(const ScalingBenchOptions& options);

/// "two bodies, touching, hierarchy, CPU, 1 thread": the text that `--only` searches.
std::string scaling_label(const ScalingCase& scaling_case, const CollisionSettings& method,
                          const StageSystem& system);

}  // namespace gelatin
