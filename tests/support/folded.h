#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cpu/nodes.h"
#include "model/model.h"
#include "support/step_on_gpu.h"

namespace gelatin::test {

/// How bodies are deformed after their rest shapes were taken.
enum class Deformation {
    rigid,    ///< turned and moved
    affine,   ///< stretched and sheared too
    rolled,   ///< rolled up until the ends go through one another
    crushed,  ///< to a tenth of their height, and shaken
    poked,    ///< not at all, but for three nodes pushed deep into the body
    tangled,  ///< every node moved at random by about two cells
    flat,     ///< into a plane
};
inline constexpr Deformation kDeformations[] = {
    Deformation::rigid, Deformation::affine,  Deformation::rolled, Deformation::crushed,
    Deformation::poked, Deformation::tangled, Deformation::flat};

const char* name_of(Deformation deformation);

/// Three bars of different sizes, the first of more than one chunk of nodes, each in motion, a few nodes of
/// the first pinned.
Model make_folded(Deformation deformation, unsigned seed = 1);

/// By face, how many faces of its own object each touches, those that share a corner left out.
using SelfContacts = std::vector<std::uint32_t>;

/// By testing all pairs in double precision.
SelfContacts find_self_contacts_by_brute_force(const Model& model);

/// What the CPU's stages find. @param restless if not null: how many faces were not calm
template <class Real>
SelfContacts find_self_contacts_on_cpu(const Model& model, std::size_t* restless = nullptr);

/// The same in the step after one that found the nodes where they are in `before`.
template <class Real>
SelfContacts find_self_contacts_on_cpu_after(const Model& before, const Model& model);

/// What the GPU's stages find, every buffer that they write poisoned first.
SelfContacts find_self_contacts_on_gpu(const Model& model, std::uint32_t* restless = nullptr);

/// The same in the step after some that found the nodes where they are in `before`.
/// @param fitted if not null: how many objects got a new affine map in this step
SelfContacts find_self_contacts_on_gpu_after(const Model& before, const Model& model,
                                             std::uint32_t* fitted = nullptr);

/// The model's start after the response to what collides with itself, in the precision of `Real`.
template <class Real>
cpu::Nodes<Real> respond_to_self_on_cpu(const Model& model, const CollisionSettings& settings, double step);

/// The same on the GPU, kGuard elements behind the nodes.
NodeArrays respond_to_self_on_gpu(const Model& model, const CollisionSettings& settings, double step);

/// The largest error of a response to self against the double reference, over its bound; infinite where
/// something is not finite. At most 1 is a pass. A node averages some ten answers, each from means over six
/// corners and a unit normal whose error grows with the thinness of the faces: 256 eps of the speeds below 5
/// m/s.
double worst_self_response_error(const Model& model, const CollisionSettings& settings, double step,
                                 const NodeArrays& actual);

}  // namespace gelatin::test
