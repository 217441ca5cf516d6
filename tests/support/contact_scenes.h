#pragma once

#include <memory>
#include <vector>

#include "cpu/cpu_solver.h"
#include "gelatin/scene.h"
#include "model/model.h"

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
};

/// @param colliders planes are solid, others surfaces
std::shared_ptr<const Model> make_blocks(const std::vector<Block>& blocks,
                                         const glm::dvec3& gravity = {0, 0, 0},
                                         const std::vector<ColliderDescription>& colliders = {});

/// With contact between bodies, and of bodies with themselves.
template <class Real>
cpu::CpuSolver<Real> make_solver(const std::shared_ptr<const Model>& model, double friction = 0.4,
                                 int iterations = 10, bool divides_steps = false) {
    return {model, SolverKind::vbd, ForceMethod::fused,
            CollisionSettings{
                .response = CollisionResponse::contact, .self_collision = true, .friction = friction},
            DescentSettings{.iterations = iterations, .divides_steps = divides_steps}};
}

}  // namespace gelatin::test
