#include "model/scene/scene_file_fixture.h"

namespace gelatin::test {
namespace {

using testing::HasSubstr;

class SceneFileOverride : public SceneFile {};

TEST_F(SceneFileOverride, OverridesSetValuesByNameAndIndex) {
    const Scene scene =
        load(std::string(kBall) + "collider = [{shape = {sphere = 1}}]\n",
             {"simulation.solver=rk4", "simulation.frames = 3", "object.ball.velocity=[0, 1, 0]",
              "material.jelly.youngs_modulus=1e5", "collider.0.friction=0.25",
              "object.0.shape={box = [1, 2, 3]}", "object.ball.name=crate"});
    EXPECT_EQ(scene.simulation.solver, SolverKind::rk4);
    EXPECT_EQ(scene.simulation.frames, 3);
    EXPECT_EQ(scene.objects.at(0).velocity, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(scene.materials.at(0).youngs_modulus, 1e5);
    EXPECT_EQ(scene.colliders.at(0).friction, 0.25);
    EXPECT_EQ(std::get<BoxShape>(scene.objects.at(0).shape).size, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(scene.objects.at(0).name, "crate");
}

TEST_F(SceneFileOverride, ALaterOverrideWins) {
    EXPECT_EQ(load(kBall, {"simulation.frames=3", "simulation.frames=4"}).simulation.frames, 4);
}

TEST_F(SceneFileOverride, ErrorsInOverridesNameThem) {
    EXPECT_EQ(error(kBall, {"simulation.solver=rk5"}),
              "--set simulation.solver=rk5: simulation.solver = \"rk5\": must be explicit_euler, "
              "semi_implicit_euler, midpoint, rk4, implicit or vbd (did you mean \"rk4\"?)");
    EXPECT_EQ(error(kBall, {"material.jelly.density=-1"}),
              "--set material.jelly.density=-1: material.jelly.density = -1: must be greater than 0");
    EXPECT_EQ(
        error(kBall, {"simulation.fps=3"}),
        "--set simulation.fps=3: simulation.fps = 3: unknown key; known here are solver, forces, frame_rate, "
        "substeps, iterations, gravity, frames and sleep");
}

TEST_F(SceneFileOverride, RefusesOverridesThatLeadNowhere) {
    EXPECT_EQ(error(kBall, {"object.bal.scale=2"}),
              "--set object.bal.scale=2: no object is called \"bal\" (did you mean \"ball\"?); there are 1, "
              "numbered "
              "from 0");
    EXPECT_EQ(error(kBall, {"object.1.scale=2"}),
              "--set object.1.scale=2: no object is called \"1\"; there are 1, numbered from 0");
    EXPECT_EQ(error(kBall, {"object.ball=2"}), "--set object.ball=2: must name a key of object.ball");
    EXPECT_EQ(error(kBall, {"object.ball.name.first=2"}),
              "--set object.ball.name.first=2: object.ball.name is a value, not a table");
}

TEST_F(SceneFileOverride, RefusesOverridesThatAreNotTables) {
    EXPECT_EQ(error(kBall, {"frames"}), "--set frames: must be key=value, as in simulation.frames=100");
    EXPECT_THAT(error(kBall, {"simulation.gravity=[0, 1"}),
                HasSubstr("--set simulation.gravity=[0, 1: is not TOML: "));
    EXPECT_THAT(error(kBall, {"=3"}), HasSubstr("must be key=value"));
    EXPECT_EQ(error(kBall, {"simulation.frames=3\nx=4"}), "--set simulation.frames=3: must be one line");
}

}  // namespace
}  // namespace gelatin::test
