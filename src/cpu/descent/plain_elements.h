#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/step_state.h"
#include "cpu/elasticity/elements.h"
#include "cpu/groups.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// NodeTerms of a group of rows, in double.
struct PlainTerms {
    std::array<NodeTerms<double>, kGroup> rows;

    const NodeTerms<double>& row(std::size_t r) const { return rows[r]; }
    void add(std::size_t r, const NodeTerms<double>& terms);
};

/// The elements of a step of vertex block descent node by node, in double and without SIMD: tests hold
/// LaneElements and the GPU against it.
class PlainElements {
public:
    using Terms = PlainTerms;

    /// @param node_tets of all tets of the model
    PlainElements(std::shared_ptr<const Model> model, DescentRows& rows, const NodeTets& node_tets);

    /// To be called when a step begins.
    void begin(const DescentRows&, const StepState<double>&) {}

    /// Finds VolumeBound of a batch's tets. @param ratios J of each tet, shape [tets]
    void update(const DescentRows& rows, const DescentBatch& batch, std::span<const double> ratios);

    /// Adds what inertia and all elements but flat tets contribute to the force on each node of a group. Here
    /// with Hessians.
    void add_forces(const DescentRows& rows, const StepState<double>& step, std::size_t group,
                    std::span<const glm::dvec4> positions, PlainTerms& terms) const {
        gather(rows, step, group, positions, terms);
    }

    /// Newton's step of each node of a group that is not held.
    /// @param terms what flat tets add; those of all other elements are added to it
    /// @return a bit for each row: whether its node may have come into a collider
    std::uint32_t descend(const DescentRows& rows, const StepState<double>& step, std::size_t group,
                          std::span<glm::dvec4> positions, PlainTerms& terms) const;

private:
    void gather(const DescentRows& rows, const StepState<double>& step, std::size_t group,
                std::span<const glm::dvec4> positions, PlainTerms& terms) const;
    void add_springs(const DescentRows& rows, const StepState<double>& step, std::uint32_t row,
                     std::span<const glm::dvec4> positions, NodeTerms<double>& terms) const;
    void add_neo_hookean_tets(const StepState<double>& step, std::uint32_t node,
                              std::span<const glm::dvec4> positions, NodeTerms<double>& terms) const;
    void add_volumes(std::uint32_t node, std::span<const glm::dvec4> positions,
                     NodeTerms<double>& terms) const;

    std::shared_ptr<const Model> model_;
    NodeTets node_tets_;
    std::vector<std::uint32_t> object_of_;  // by node
    // Empty without a volume term:
    std::vector<double> node_pressures_;       // [Pa]
    std::vector<VolumeBound<double>> bounds_;  // by tet
};

}  // namespace gelatin::cpu
