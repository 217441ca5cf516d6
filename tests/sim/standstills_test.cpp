#include "sim/standstills.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using ::testing::IsEmpty;

ColliderDescription box(const char* name, const glm::dvec3& size, const glm::dvec3& position) {
    ColliderDescription description;
    description.name = name;
    description.shape = BoxShape{size};
    description.position = position;
    return description;
}

// A plate that comes down on a block on a table, and rises again.
struct Press {
    explicit Press(double depth) {
        ColliderDescription plate = box("press", {1, 0.1, 1}, {0.15, 0.4, 0.15});
        plate.keyframes = {{.time = 0.0}, {.time = 0.5, .move = {0, -depth, 0}}, {.time = 1.0}};
        model = test::make_blocks({{.place = {0, 0.02, 0}, .youngs_modulus = 1e6}}, {0, -9.81, 0},
                                  {box("table", {4, 1, 4}, {0, -0.5, 0}), plate});
    }

    std::vector<std::string> run(cpu::CpuSolver<float>& solver, Standstills& standstills) const {
        std::vector<std::string> lines;
        for (int frame = 0; frame < 75; ++frame) {
            test::advance(solver, *model, frame);
            for (std::string& line : standstills.look(*model, solver, (frame + 1) * test::kFrame))
                lines.push_back(std::move(line));
        }
        return lines;
    }

    std::shared_ptr<const Model> model;
};

TEST(Standstills, AreToldOnceWithWhatIsInTheWay) {
    const Press press(0.5);
    cpu::CpuSolver<float> solver = test::make_solver<float>(press.model);
    Standstills standstills;
    const std::vector<std::string> lines = press.run(solver, standstills);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0], ::testing::MatchesRegex("collider 'press' waits at 0\\.[0-9]+ s: '" +
                                                  press.model->objects[0].name +
                                                  "' leaves it no room to move as it should"));
    EXPECT_THAT(solver.held_up(), IsEmpty()) << "it has risen again";
    standstills.restart();
    solver.write_state({press.model->positions, press.model->velocities, {}});
    EXPECT_EQ(press.run(solver, standstills), lines);
}

TEST(Standstills, AreNoneWhereThereIsRoom) {
    const Press press(0.05);
    cpu::CpuSolver<float> solver = test::make_solver<float>(press.model);
    Standstills standstills;
    EXPECT_THAT(press.run(solver, standstills), IsEmpty());
}

}  // namespace
}  // namespace gelatin
