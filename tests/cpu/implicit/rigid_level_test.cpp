#include "cpu/implicit/rigid_level.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "support/contact_scenes.h"
#include "support/converted.h"

namespace gelatin {
namespace {

// What the end of a part makes of linear rotations is what ties have.
TEST(RigidLevel, TiesKnowWhatRotationsWillAdd) {
    const auto model = test::make_blocks({test::Block{}, test::Block{.place = {0.5, 0, 0}}});
    const std::vector<glm::dvec4> positions = test::converted<double>(model->positions);
    const std::vector<double> inertia(positions.size(), 2.0);
    cpu::RigidLevel<double> level(model);
    level.begin(positions, inertia);
    const glm::dvec3 w[] = {{0.002, -0.004, 0.001}, {-0.003, 0.0, 0.004}};
    std::vector<glm::dvec3> displacements, forces(positions.size(), glm::dvec3(0.0));
    for (std::uint32_t n = 0; n < positions.size(); ++n) {
        const std::size_t body = n < model->objects[0].nodes.end() ? 0 : 1;
        displacements.push_back(glm::dvec3(1e-3, 0.0, 0.0) + glm::cross(w[body], level.arm(n)));
    }
    level.follow_rotation(positions, inertia, displacements, forces);
    cpu::ContactRow<double> row;
    row.nodes = {model->objects[1].nodes.first, model->objects[0].nodes.first + 5,
                 model->objects[0].nodes.first + 9};
    row.weights = {1.0, -0.25, -0.75};
    row.count = 3;
    const glm::dvec3 added = level.added_by_rotation(row), before = relative<double>(row, displacements);
    level.rotate(positions, inertia, displacements);
    EXPECT_GT(glm::length(added), 1e-6);
    EXPECT_LT(glm::distance(relative<double>(row, displacements) - before, added), 0.02 * glm::length(added));
}

}  // namespace
}  // namespace gelatin
