#include "cpu/descent/shift_outside.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

constexpr double kStep = 1.0 / 60.0;  // [s]

// A block whose guess leads 5 cm into a floor and 3 cm into a wall. @return where it is put
std::vector<glm::dvec4> shifted(double youngs_modulus, std::vector<glm::dvec4>& guess, double depth = 1e-4) {
    std::vector<ColliderDescription> planes(2);
    planes[0].shape = PlaneCollider{{0, 1, 0}, 0.05};
    planes[1].shape = PlaneCollider{{1, 0, 0}, 0.03};
    const auto model = test::make_blocks({{.youngs_modulus = youngs_modulus}}, {}, planes);
    cpu::StepObjective<double> objective(model, model->node_count());
    guess.assign(model->positions.begin(), model->positions.end());
    glm::dvec3 least(1e9);
    for (const glm::dvec4& p : guess) least = glm::min(least, glm::dvec3(p));
    for (std::size_t n = 0; n < guess.size(); ++n) {
        guess[n] -= glm::dvec4(least, 0.0);  // the corner is at the origin
        objective.step.starts[n] = guess[n];
        objective.step.targets[n] =
            glm::dvec4(glm::dvec3(guess[n]), static_cast<double>(model->masses[n]) / (kStep * kStep));
    }
    objective.begin(kStep);
    std::vector<glm::dvec4> positions = guess;
    cpu::shift_outside<double>(*model, objective, depth, positions);
    return positions;
}

TEST(ShiftOutside, StiffBodiesAsAWhole) {
    std::vector<glm::dvec4> guess;
    const std::vector<glm::dvec4> positions = shifted(1e8, guess);
    for (std::size_t n = 0; n < guess.size(); ++n)
        EXPECT_LT(glm::distance(positions[n], guess[n] + glm::dvec4(0.03, 0.05, 0.0, 0.0)), 1e-6) << n;
}

// Their nodes are put outside one by one, later, as that takes less of their motion.
TEST(ShiftOutside, LeavesSoftBodies) {
    std::vector<glm::dvec4> guess;
    EXPECT_EQ(shifted(1e3, guess), guess);
}

TEST(ShiftOutside, LeavesWhatIsHardlyInside) {
    std::vector<glm::dvec4> guess;
    EXPECT_EQ(shifted(1e8, guess, 0.1), guess);
}

}  // namespace
}  // namespace gelatin
