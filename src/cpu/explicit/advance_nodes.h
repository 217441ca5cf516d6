#pragma once

#include <span>

#include "cpu/elasticity/tet_blocks.h"
#include "cpu/nodes.h"
#include "model/explicit/explicit_scheme.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Input and output of one pass of an explicit scheme (model/explicit/explicit_scheme.h); arrays of shape
/// [nodes].
template <class Real>
struct Pass {
    const Model& model;
    Vec3<Real> gravity;  ///< [m/s^2]
    Real resting_speed;  ///< below which nodes do not bounce off colliders [m/s]
    Real step;           ///< h [s]
    Real weight;         ///< of this pass in the sum
    Real next_step;      ///< offset of the next pass: h next [s]
    bool first;          ///< the first pass: it initialises the sums
    bool last;           ///< the last pass: it writes the step's result
    bool semi_implicit;

    const Vec4<Real>* load_forces;                      ///< of loads [N]; null without loads
    const Real* volume_stresses;                        ///< of the volume term [Pa]; null without it
    const Vec4<Real>*base_positions, *base_velocities;  ///< at the step's start
    const Vec4<Real>*positions, *velocities;            ///< where forces are evaluated
    Vec4<Real>*sum_positions, *sum_velocities;          ///< null for schemes of one pass
    Vec4<Real>*out_positions, *out_velocities;
};

/// Pass `index` of a step of `step` seconds from `base`, with forces at `at`; `sums` may be empty for schemes
/// of one pass. Without loads and volume term; the arrays must outlive the pass.
template <class Real>
Pass<Real> make_pass(const Model& model, const ExplicitScheme& scheme, int index, double step,
                     const Nodes<Real>& base, const Nodes<Real>& at, Nodes<Real>& out, Nodes<Real>& sums);

/// Runs before the pass, if the model has a volume term: its stress around each node of `slices` [Pa].
template <class Real>
void find_volume_stresses(const Model& model, const Nodes<Real>& at, std::span<Real> stresses, Range slices);

/// The same in float with SIMD. @param tets make_pass_tets of the model
void find_volume_stresses_simd(const Model& model, const TetBlocks& tets, const Nodes<float>& at,
                               std::span<float> stresses, Range slices);

/// Forces and integration fused: each node gathers the forces of its springs and tets and moves. Writes the
/// nodes of `slices` only.
template <class Real>
void advance_nodes(const Pass<Real>& pass, Range slices);

/// The tets of the nodes in their order, for SIMD; empty if springs are all.
TetBlocks make_pass_tets(const Model& model);

/// The same in float with SIMD, for the present processor; differs from the plain one by rounding only.
/// @param tets make_pass_tets of the model
void advance_nodes_simd(const Pass<float>& pass, const TetBlocks& tets, Range slices);

/// The instruction set that advance_nodes_simd uses here: "AVX3_ZEN4".
const char* simd_target();

/// The paper's method, first loop: each spring writes the force on its first endpoint [N].
template <class Real>
void write_spring_forces(const Pass<Real>& pass, std::span<Vec4<Real>> spring_forces, Range springs);

/// Second loop: each node adds up its springs' forces [N].
template <class Real>
void merge_spring_forces(const Model& model, std::span<const Vec4<Real>> spring_forces,
                         std::span<Vec4<Real>> node_forces, Range nodes);

/// Third loop: each node moves, by these forces and those of its tets.
template <class Real>
void integrate_nodes(const Pass<Real>& pass, std::span<const Vec4<Real>> node_forces, Range nodes);

}  // namespace gelatin::cpu
