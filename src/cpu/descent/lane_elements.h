#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/descend_groups.h"
#include "cpu/descent/spring_blocks.h"
#include "cpu/descent/step_state.h"
#include "cpu/descent/volume_bounds.h"
#include "cpu/elasticity/tet_blocks.h"
#include "model/descent/descent_rows.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// The elements of a step of vertex block descent eight nodes at a time, in float with SIMD. Reference:
/// PlainElements, which documents the same functions.
class LaneElements {
public:
    using Terms = TermColumns;

    /// @param rows whose springs it takes
    LaneElements(std::shared_ptr<const Model> model, DescentRows& rows, const NodeTets& node_tets);

    void begin(const DescentRows& rows, const StepState<float>& step);
    void update(const DescentRows& rows, const DescentBatch& batch, std::span<const float> ratios);
    void add_forces(const DescentRows& rows, const StepState<float>& step, std::size_t group,
                    std::span<const glm::vec4> positions, TermColumns& terms) const {
        gather_group_forces(groups(rows, step), group, positions, terms);
    }
    std::uint32_t descend(const DescentRows& rows, const StepState<float>& step, std::size_t group,
                          std::span<glm::vec4> positions, TermColumns& terms) const {
        return descend_group(groups(rows, step), group, terms, positions);
    }

private:
    DescentGroups groups(const DescentRows& rows, const StepState<float>& step) const {
        return {has_damping_ ? damped_springs_ : springs_,
                {tets_, bounds_.offsets(), step.starts, step.inverse_step},
                rows.nodes,
                step.targets,
                colliders_};
    }

    std::shared_ptr<const Model> model_;
    bool has_damping_;
    SpringBlocks springs_, damped_springs_;  // damped ones where the model has dampers
    TetBlocks tets_;
    VolumeBounds bounds_;  // empty without a volume term
    std::vector<ColliderBound> colliders_;
};

}  // namespace gelatin::cpu
