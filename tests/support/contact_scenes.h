#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "cpu/implicit/system_solver.h"
#include "gelatin/scene.h"
#include "model/model.h"
#include "support/random_maker.h"

namespace gelatin::test {

constexpr double kFrame = 1.0 / 60.0;  // [s]

/// A block of random tets, with the corner of the lowest coordinates at `place`.
struct Block {
    glm::dvec3 place{0.0}, velocity{0.0};
    glm::ivec3 cells{3, 3, 3};
    glm::dvec3 size{0.3};
    double youngs_modulus = 1e5;
    std::vector<Region> pins{};
    double poisson_ratio = 0.25;
    MaterialModel model = MaterialModel::mass_spring;
    std::optional<double> friction = {};  // of its material
    std::vector<HandleDescription> handles{};
};

/// Blocks and thin plates above each other, that fly in all directions, soft and hard.
/// @param most_bodies at least 2
std::vector<Block> violent_blocks(RandomMaker& random, int most_bodies);

/// Such bodies of all materials above a plane or a box, and how their steps are made.
struct ViolentScene {
    std::shared_ptr<const Model> model;
    double step;  ///< [s]
    int iterations;
    bool divides_steps;
};
ViolentScene violent_scene(unsigned seed);

/// @param colliders planes are solid, others surfaces
std::shared_ptr<const Model> make_blocks(const std::vector<Block>& blocks,
                                         const glm::dvec3& gravity = {0, 0, 0},
                                         const std::vector<ColliderDescription>& colliders = {});

/// With contact between bodies, and of bodies with themselves, without restitution.
template <class Real>
cpu::SystemSolver<Real> make_solver(const std::shared_ptr<const Model>& model, double friction = 0.4,
                                    int iterations = 10, bool divides_steps = true) {
    return cpu::SystemSolver<Real>(
        model,
        CollisionSettings{.response = CollisionResponse::contact,
                          .self_collision = true,
                          .friction = friction,
                          .restitution = 0.0},
        ImplicitSettings{.iterations = iterations, .divides_steps = divides_steps});
}

/// Makes a step of `step` [s], with what handles and colliders do then. @param number of the step, from 0
void advance(Solver& solver, const Model& model, int number, double step = kFrame);

/// Of all bodies.
struct BodySums {
    glm::dvec3 momentum{0.0};                              ///< [kg m/s]
    double kinetic = 0.0, potential = 0.0, elastic = 0.0;  ///< [J]
    double sum() const { return kinetic + potential; }
};
template <class Real>
BodySums sum_bodies(const Model& model, const cpu::Nodes<Real>& nodes);

/// Makes steps from the start, until faces overlap after one, or bodies have more kinetic and potential
/// energy than `most_energy` [J]. @return whether they never do
template <class Real>
testing::AssertionResult stays_apart(cpu::CpuSolver<Real>& solver, const Model& model, int steps,
                                     double step = kFrame,
                                     double most_energy = std::numeric_limits<double>::infinity());

}  // namespace gelatin::test
