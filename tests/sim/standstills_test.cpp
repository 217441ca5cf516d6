#include "sim/standstills.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/drive/handle_arms.h"
#include "model/drive/handles.h"
#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using ::testing::ElementsAre, ::testing::IsEmpty, ::testing::StartsWith;

ColliderDescription box(const char* name, const glm::dvec3& size, const glm::dvec3& position) {
    ColliderDescription description;
    description.name = name;
    description.shape = BoxShape{size};
    description.position = position;
    return description;
}

// A plate that comes down on a block on a table, and rises again.
struct Press {
    explicit Press(double depth, WhenBlocked when_blocked = WhenBlocked::goes_on) {
        ColliderDescription plate = box("press", {1, 0.1, 1}, {0.15, 0.4, 0.15});
        plate.keyframes = {{.time = 0.0}, {.time = 0.5, .move = {0, -depth, 0}}, {.time = 1.0}};
        plate.when_blocked = when_blocked;
        model = test::make_blocks({{.place = {0, 0.02, 0}, .youngs_modulus = 1e6}}, {0, -9.81, 0},
                                  {box("table", {4, 1, 4}, {0, -0.5, 0}), plate});
    }

    std::vector<std::string> run(cpu::CpuSolver<float>& solver, Standstills& standstills) {
        std::vector<std::string> lines;
        for (int frame = 0; frame < 75; ++frame) {
            test::advance(solver, *model, frame);
            const double time = (frame + 1) * test::kFrame;
            const HandlePose pose = pose_at(model->handles[0], time);
            held_up = solver.held_up(HandleArms(model).places({&pose, 1}, {&time, 1}));
            for (std::string& line :
                 standstills.look(*model, solver, held_up, std::vector<double>{0.0}, time))
                lines.push_back(std::move(line));
        }
        return lines;
    }

    std::shared_ptr<const Model> model;
    std::vector<std::uint32_t> held_up;  // at last
};

TEST(Standstills, AreToldOnceWithWhatIsInTheWay) {
    Press press(0.5);
    cpu::SystemSolver<float> solver = test::make_solver<float>(press.model);
    Standstills standstills;
    const std::vector<std::string> lines = press.run(solver, standstills);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0], ::testing::MatchesRegex("collider 'press' waits at 0\\.[0-9]+ s: '" +
                                                  press.model->objects[0].name +
                                                  "' leaves it no room to move as it should"));
    EXPECT_THAT(press.held_up, IsEmpty()) << "it has risen again";
    standstills.restart();
    solver.write_state({press.model->positions, press.model->velocities, {}});
    EXPECT_EQ(press.run(solver, standstills), lines);
}

TEST(Standstills, AreNoneWhereThereIsRoom) {
    Press press(0.05);
    cpu::SystemSolver<float> solver = test::make_solver<float>(press.model);
    Standstills standstills;
    EXPECT_THAT(press.run(solver, standstills), IsEmpty());
}

// That it stops is reported when it does, that it has moved on when nothing has blocked it for a while.
TEST(Standstills, OfWhatStopsAreToldWithTheirEnds) {
    const Press press(0.5, WhenBlocked::stops);
    cpu::SystemSolver<float> solver = test::make_solver<float>(press.model);
    test::advance(solver, *press.model, 0);
    Standstills standstills;
    const auto look = [&](bool is_held_up, double time) {
        const std::vector<std::uint32_t> held_up(is_held_up ? 1 : 0);
        return standstills.look(*press.model, solver, held_up, std::vector<double>{0.4}, time);
    };
    const std::string no_room = ": what it meets leaves it no room to move as it should";
    EXPECT_THAT(look(false, 0.9), IsEmpty());
    EXPECT_THAT(look(true, 1.0), ElementsAre("collider 'press' stops at 1 s" + no_room));
    EXPECT_THAT(look(true, 1.1), IsEmpty());
    EXPECT_THAT(look(false, 1.2), IsEmpty()) << "perhaps for a moment";
    EXPECT_THAT(look(true, 1.3), IsEmpty());
    EXPECT_THAT(look(false, 1.5), IsEmpty());
    EXPECT_THAT(look(false, 1.6), ElementsAre("collider 'press' has moved on since 1.3 s, 0.4 s later than "
                                              "its keyframes"));
    EXPECT_THAT(look(false, 1.7), IsEmpty());
    EXPECT_THAT(look(true, 1.8), ElementsAre("collider 'press' stops at 1.8 s" + no_room));
    standstills.restart();
    EXPECT_THAT(look(false, 2.5), IsEmpty());
}

// Handles of one object by their places in the scene.
TEST(Standstills, NameHandles) {
    Model model;
    model.objects.resize(1);
    model.objects[0].name = "bar";
    model.handles.resize(2);
    for (Handle& handle : model.handles) handle.stops = true;
    model.handles[1].index = 1;
    cpu::SystemSolver<float> solver = test::make_solver<float>(Press(0.5).model);
    const std::vector<std::uint32_t> second{1};
    Standstills standstills;
    EXPECT_THAT(standstills.look(model, solver, second, std::vector<double>{0.0, 0.0}, 1.0),
                ElementsAre(StartsWith("handle[1] of object 'bar' stops at 1 s")));
    model.handles[0].is_pin = true;
    standstills.restart();
    EXPECT_THAT(standstills.look(model, solver, second, std::vector<double>{0.0, 0.0}, 1.0),
                ElementsAre(StartsWith("object 'bar' stops at 1 s")));
}

}  // namespace
}  // namespace gelatin
