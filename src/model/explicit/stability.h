#pragma once

#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// The deformations for which a bound is valid: small motion about the rest shape, or any shape.
enum class Deformation { small, any };

/// An upper bound on the highest angular frequency [rad/s] of an object at rest. With springs:
///   omega^2 <= max over nodes i of eig_max( sum_j k_ij (1 + m_i / m_j) n n^T ) / m_i
/// (each spring's energy split between its ends by (a - b)^2 <= (1 + t) a^2 + (1 + 1/t) b^2, t = m_i / m_j).
/// In any shape, springs may all be aligned, and may also act across their direction: n n^T becomes the
/// identity. A neo-Hookean tet's energy is split between its corners in the same way, each with a share by
/// |g|^2 / m, g its shape gradient: V q (mu_L + (mu_L + lambda_L) n n^T), q = sum of |g|^2 / m over the
/// corners, n = g / |g|, stands for k (1 + m_i / m_j) n n^T / m_i. So is the volume term's of each node,
/// between all whose places its volume v depends on: kappa / V q n n^T, with s = dv/dx for g.
double frequency_bound(const Model& model, const ModelObject& object,
                       Deformation deformation = Deformation::small);

/// The largest step [s] with which `solver` is stable for all modes with frequencies up to `frequency`
/// [rad/s] and Kelvin-Voigt damping time `damping` [s]: no mode grows by more than 1% per second. (Explicit
/// Euler and the midpoint rule amplify undamped motion at any step; this says how small is small enough.)
double largest_stable_step(SolverKind solver, double frequency, double damping);

/// The smallest of the objects' largest stable steps [s]; infinite without springs.
double largest_stable_step(SolverKind solver, const Model& model,
                           Deformation deformation = Deformation::small);

/// Steps per frame: the scene's number, or the fewest whose size is at most 0.8 of the largest stable step
/// (the margin is for springs that stiffen as the body deforms).
/// @throws InvalidInput if the scene's own number makes steps larger than the largest stable one, naming it,
/// or if
///   more than 100,000 steps per frame were needed.
int choose_substeps(const Scene& scene, const Model& model);

}  // namespace gelatin
