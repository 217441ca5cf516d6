#include "cpu/descent/coarse_correction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cpu/descent/rigid_motion.h"
#include "support/coarse_motions.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 1.0 / 60.0;  // [s]

Model held_bar() {
    Body body = test::make_body(test::make_block({16, 3, 3}, {1.6, 0.3, 0.3}, 0.2));
    body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.05}};
    return test::make_model(body);
}

// What the implicit step's inertia and springs would need to go `displacements` from rest [N].
std::vector<glm::dvec3> forces_for(const Model& model, const std::vector<glm::dvec3>& displacements) {
    std::vector<glm::dvec3> forces(model.node_count(), glm::dvec3(0.0));
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        forces[n] = static_cast<double>(model.masses[n]) / (kStep * kStep) * displacements[n];
    for (const Spring& s : model.springs) {
        const glm::dvec3 n =
            glm::normalize(glm::dvec3(model.positions[s.j]) - glm::dvec3(model.positions[s.i]));
        const glm::dvec3 force =
            static_cast<double>(s.stiffness) * glm::dot(n, displacements[s.j] - displacements[s.i]) * n;
        forces[s.i] -= force;
        forces[s.j] += force;
    }
    return forces;
}

// Newton's step within the motions of clusters is exact where the objective is the one at rest: what it takes
// to go along them, clusters answer by going there. So they do when the whole body is rotated.
TEST(CoarseCorrection, IsNewtonsStepAlongItsMotions) {
    const Model model = held_bar();
    const CoarseBasis basis = make_coarse_basis(model);
    const std::vector<glm::dvec3> expected = test::coarse_displacements(
        model, basis, basis.objects[0], test::random_motions(basis.objects[0], 0.01, 5));
    const std::vector<glm::dvec3> forces = forces_for(model, expected);
    cpu::CoarseCorrection<double> correction(std::make_shared<const Model>(model));
    for (const glm::dvec3& rotated : {glm::dvec3(0.0), glm::dvec3(0.4, -1.0, 2.0)}) {
        const glm::dmat3 orientation = cpu::cayley_rotation(rotated);
        std::vector<glm::dvec4> positions;
        std::vector<glm::dvec3> rotated_forces, displacements(model.node_count());
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            positions.emplace_back(orientation * glm::dvec3(model.positions[n]), model.positions[n].w);
            rotated_forces.push_back(orientation * forces[n]);
        }
        correction.begin(kStep, positions);
        correction.find_displacements(positions, rotated_forces, displacements);
        double worst = 0.0, longest = 0.0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            worst = std::max(worst, glm::distance(displacements[n], orientation * expected[n]));
            longest = std::max(longest, glm::length(expected[n]));
        }
        EXPECT_LT(worst, 1e-4 * longest);
    }
}

// A body whose parts are rotated unlike each other still has forces pull nodes their way.
TEST(CoarseCorrection, GoesDownhillWhateverTheShape) {
    const Model model = held_bar();
    cpu::CoarseCorrection<float> correction(std::make_shared<const Model>(model));
    for (const double bend : {0.0, 1.0, 4.0}) {
        std::vector<glm::vec4> positions;
        std::vector<glm::vec3> forces, displacements(model.node_count());
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            const glm::vec4& p = model.positions[n];
            const auto angle = static_cast<float>(bend) * p.x;
            positions.emplace_back(p.x * 0.8f, p.y * std::cos(angle) - p.z * std::sin(angle),
                                   p.y * std::sin(angle) + p.z * std::cos(angle), p.w);
            forces.push_back(p.w > 0.0f ? glm::vec3(std::sin(9.0f * p.x), std::cos(4.0f * p.y), p.z)
                                        : glm::vec3(0.0f));
        }
        correction.begin(static_cast<float>(kStep), positions);
        correction.find_displacements(positions, forces, displacements);
        double work = 0.0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            work += static_cast<double>(glm::dot(forces[n], displacements[n]));
            if (model.positions[n].w == 0.0f) {
                EXPECT_EQ(displacements[n], glm::vec3(0.0f));
            }
        }
        EXPECT_GT(work, 0.0);
    }
}

}  // namespace
}  // namespace gelatin
