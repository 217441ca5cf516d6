#include "model/scene/scene_file_fixture.h"
#include "support/source_path.h"

namespace gelatin::test {
namespace {

using testing::StartsWith;

TEST_F(SceneFile, ReadsEveryKey) {
    const Scene scene = load(R"(
[simulation]
solver = "rk4"
forces = "divide_and_merge"
frame_rate = 30
substeps = 7
gravity = [0, -1.62, 0]
frames = 12

[collision]
broad_phase = "boxes"
detection = "continuous"
response = "restore"
self_collision = true
proximity_radius = 0.005
friction = 0.1
restitution = 0.9

[camera]
eye = [1, 2, 3]
target = [0, 0, 0]
field_of_view = 50

[[material]]
name = "jelly"
youngs_modulus = 2e4
density = 900
poisson_ratio = 0.3
damping = 0.02
springs = ["shear", "flex"]

[[object]]
name = "ball"
shape = { sphere = 0.5, frequency = 20 }
mesher = { kind = "tetgen", quality = 1.5, max_volume = 1e-4, time_limit = 5 }
material = "jelly"
position = [0, 2, 0]
rotation = [90, 0, 0]
scale = 2
velocity = [1, 0, 0]
pins = [{ box = [[-1, -1, -1], [0, 1, 1]] }, { sphere = [1, 2, 3], radius = 0.1 }, { plane = [0, 2, 0], offset = 0.5 }]
color = [0.1, 0.2, 0.3]

[[collider]]
shape = { plane = [0, 3, 4], offset = -1 }
friction = 0.7

[[collider]]
shape = { capsule = 0.2, length = 3 }
position = [0, 1, 0]
rotation = [0, 0, 45]
restitution = 0
)");
    EXPECT_EQ(scene.simulation.solver, SolverKind::rk4);
    EXPECT_EQ(scene.simulation.forces, ForceMethod::divide_and_merge);
    EXPECT_EQ(scene.simulation.frame_rate, 30.0);
    EXPECT_EQ(scene.simulation.substeps, 7);
    EXPECT_EQ(scene.simulation.gravity, glm::dvec3(0.0, -1.62, 0.0));
    EXPECT_EQ(scene.simulation.frames, 12);
    EXPECT_EQ(scene.collision.broad_phase, BroadPhase::boxes);
    EXPECT_TRUE(scene.collision.self_collision);
    EXPECT_EQ(scene.collision.proximity_radius, 0.005);
    EXPECT_EQ(scene.collision.detection, CollisionDetection::continuous);
    EXPECT_EQ(scene.collision.response, CollisionResponse::restore);
    EXPECT_EQ(scene.collision.friction, 0.1);
    EXPECT_EQ(scene.collision.restitution, 0.9);
    ASSERT_TRUE(scene.camera);
    EXPECT_EQ(scene.camera->eye, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(scene.camera->target, glm::dvec3(0.0));
    EXPECT_EQ(scene.camera->field_of_view, 50.0);

    ASSERT_EQ(scene.materials.size(), 1u);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.name, "jelly");
    EXPECT_EQ(material.youngs_modulus, 2e4);
    EXPECT_EQ(material.density, 900.0);
    EXPECT_EQ(material.poisson_ratio, 0.3);
    EXPECT_EQ(material.damping, 0.02);
    ASSERT_TRUE(material.springs);
    EXPECT_FALSE(material.springs->structural);
    EXPECT_TRUE(material.springs->shear);
    EXPECT_TRUE(material.springs->flex);

    ASSERT_EQ(scene.objects.size(), 1u);
    const ObjectDescription& ball = scene.objects[0];
    EXPECT_EQ(ball.name, "ball");
    EXPECT_EQ(std::get<SphereShape>(ball.shape).radius, 0.5);
    EXPECT_EQ(std::get<SphereShape>(ball.shape).frequency, 20);
    EXPECT_EQ(ball.mesher.kind, MesherKind::tetgen);
    EXPECT_EQ(ball.mesher.quality, 1.5);
    EXPECT_EQ(ball.mesher.max_volume, 1e-4);
    EXPECT_EQ(ball.mesher.time_limit, 5.0);
    EXPECT_EQ(ball.material, "jelly");
    EXPECT_EQ(ball.position, glm::dvec3(0.0, 2.0, 0.0));
    EXPECT_EQ(ball.rotation, glm::dvec3(90.0, 0.0, 0.0));
    EXPECT_EQ(ball.scale, 2.0);
    EXPECT_EQ(ball.velocity, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(ball.color, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(ball.line, 32);
    EXPECT_EQ(ball.pins_line, 41);
    ASSERT_EQ(ball.pins.size(), 3u);
    EXPECT_EQ(std::get<BoxRegion>(ball.pins[0]).min, glm::dvec3(-1.0));
    EXPECT_EQ(std::get<BoxRegion>(ball.pins[0]).max, glm::dvec3(0.0, 1.0, 1.0));
    EXPECT_EQ(std::get<SphereRegion>(ball.pins[1]).center, glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(std::get<SphereRegion>(ball.pins[1]).radius, 0.1);
    EXPECT_EQ(std::get<HalfSpaceRegion>(ball.pins[2]).normal, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(std::get<HalfSpaceRegion>(ball.pins[2]).offset, 0.5);

    ASSERT_EQ(scene.colliders.size(), 2u);
    EXPECT_EQ(std::get<PlaneCollider>(scene.colliders[0].shape).normal, glm::dvec3(0.0, 0.6, 0.8));
    EXPECT_EQ(std::get<PlaneCollider>(scene.colliders[0].shape).offset, -1.0);
    EXPECT_EQ(scene.colliders[0].friction, 0.7);
    EXPECT_EQ(scene.colliders[0].restitution, 0.9);  // the scene's
    EXPECT_EQ(std::get<CapsuleShape>(std::get<Shape>(scene.colliders[1].shape)).radius, 0.2);
    EXPECT_EQ(std::get<CapsuleShape>(std::get<Shape>(scene.colliders[1].shape)).length, 3.0);
    EXPECT_EQ(scene.colliders[1].position, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(scene.colliders[1].rotation, glm::dvec3(0.0, 0.0, 45.0));
    EXPECT_EQ(scene.colliders[1].friction, 0.1);
    EXPECT_EQ(scene.colliders[1].restitution, 0.0);
}

TEST_F(SceneFile, KeepsTheDefaultsOfSceneHWhereItIsSilent) {
    const Scene scene = load(kBall);
    EXPECT_EQ(scene.simulation.solver, SimulationSettings{}.solver);
    EXPECT_EQ(scene.simulation.frames, SimulationSettings{}.frames);
    EXPECT_FALSE(scene.simulation.substeps);
    EXPECT_EQ(scene.materials.at(0).density, Material{}.density);
    EXPECT_FALSE(scene.materials.at(0).springs);
    EXPECT_EQ(scene.objects.at(0).material, "jelly");  // the only one
    EXPECT_EQ(scene.objects.at(0).scale, 1.0);
    EXPECT_FALSE(scene.objects.at(0).color);
    EXPECT_FALSE(scene.camera);
}

TEST_F(SceneFile, TakesAutomaticSubsteps) {
    EXPECT_FALSE(load(std::string(kBall) + "[simulation]\nsubsteps = 'auto'").simulation.substeps);
}

TEST_F(SceneFile, TakesTheShippedScenes) {
    for (const char* name : {"free_fall", "bounce", "hanging_beam", "twist", "cantilever", "play"}) {
        EXPECT_NO_THROW(load_scene(test::source_path() + "scenes/" + name + ".toml")) << name;
    }
}

TEST_F(SceneFile, TakesTheScenesOfTheDocumentation) {
    const std::string page = read_file(test::source_path() + "docs/scene-files.md");
    const std::string open = "```toml\n";
    int scenes = 0;
    for (auto at = page.find(open); at != page.npos; at = page.find(open, at + 1)) {
        const auto start = at + open.size();
        EXPECT_EQ(error(page.substr(start, page.find("```", start) - start)), "no error");
        ++scenes;
    }
    EXPECT_GT(scenes, 0);
}

// A cut-off file reads or is refused; nothing else comes out of it.
TEST_F(SceneFile, TakesOrRefusesEveryPrefixOfAFile) {
    const std::string whole = read_file(test::source_path() + "scenes/bounce.toml");
    std::size_t refused = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        if (error(whole.substr(0, length)) != "no error") ++refused;
    }
    EXPECT_GT(refused, whole.size() / 2);
}

// Files

TEST_F(SceneFile, RefusesAMissingFile) {
    try {
        load_scene("nowhere/scene.toml");
        FAIL();
    } catch (const InvalidInput& problem) {
        EXPECT_STREQ(problem.what(), "nowhere/scene.toml: no such file");
    }
}

TEST_F(SceneFile, RefusesAnEmptyFile) {
    EXPECT_EQ(error(""), "scene.toml: has no objects: add an [[object]] or a [[rigid]]");
}

TEST_F(SceneFile, RefusesASceneWithoutObjects) {
    EXPECT_EQ(error("[simulation]\nframes = 3\n"),
              "scene.toml: has no objects: add an [[object]] or a [[rigid]]");
}

TEST_F(SceneFile, RefusesWhatIsNotToml) {
    EXPECT_THAT(error("[simulation]\nframes = = 3\n"), StartsWith("scene.toml:2: is not TOML: "));
    EXPECT_EQ(error("[simulation]\nframe_rate = n\n").find('\n'), std::string::npos);  // the parser quotes it
    EXPECT_THAT(error("frames = 3\nframes = 4\n"), StartsWith("scene.toml:2: is not TOML: "));
    EXPECT_THAT(error(std::string("\x7f"
                                  "ELF\0\1\2",
                                  7)),
                StartsWith("scene.toml:1: is not TOML: "));
}

// Keys

TEST_F(SceneFile, RefusesAnUnknownKeyAndNamesTheNearest) {
    EXPECT_EQ(error(std::string(kBall) + "[simulation]\nframes = 3\nsolvr = 'rk4'"),
              "scene.toml:6: simulation.solvr = \"rk4\": unknown key (did you mean \"solver\"?)");
    EXPECT_EQ(error(std::string(kBall) + "[collision]\nwobbliness = 3"),
              "scene.toml:5: collision.wobbliness = 3: unknown key; known here are broad_phase, detection, "
              "response, self_collision, proximity_radius, friction, "
              "restitution and pair");
}

TEST_F(SceneFile, RefusesAnUnknownSection) {
    EXPECT_EQ(error("[[materail]]\nname = 'jelly'"),
              "scene.toml:1: materail = [{...}]: unknown key (did you mean \"material\"?)");
}

TEST_F(SceneFile, RefusesASectionOfTheWrongKind) {
    EXPECT_EQ(error("[material]\nname = 'jelly'"),
              "scene.toml:1: material: must be a list of tables: write [[material]]");
    EXPECT_EQ(object_error("shape = { sphere = 1 }\npins = { sphere = [0, 0, 0], radius = 1 }"),
              "scene.toml:5: object.ball.pins: must be a list of tables: write pins = [{...}]");
    EXPECT_EQ(object_error("shape = [{ sphere = 1 }]"),
              "scene.toml:4: object.ball.shape = [{...}]: must be one table: write shape = {...}");
    EXPECT_EQ(error("[[simulation]]\nframes = 1"),
              "scene.toml:1: simulation = [{...}]: must be one table: write [simulation]");
    EXPECT_EQ(error("simulation = 3"), "scene.toml:1: simulation = 3: must be a table, is a whole number");
    EXPECT_EQ(error("object = 3"), "scene.toml:1: object = 3: must be a list of tables, is a whole number");
    EXPECT_EQ(error("object = [{name='a'}, 3]"),
              "scene.toml:1: object[1] = 3: must be a table, is a whole number");
}

TEST_F(SceneFile, RefusesAMissingKey) {
    EXPECT_EQ(error("[[material]]\n[[object]]\n"), "scene.toml:1: material[0]: needs \"name\"");
    EXPECT_EQ(error("material = [{name = 'jelly'}]\n[[object]]\nname = 'ball'"),
              "scene.toml:2: object[0]: needs \"shape\"");
    EXPECT_EQ(error(std::string(kBall) + "[camera]\neye = [0, 0, 1]"),
              "scene.toml:4: camera: needs \"target\"");
}

TEST_F(SceneFile, TakesAMisspeltRequiredKeyForWhatItIs) {
    EXPECT_EQ(object_error("shap = {sphere = 1}"),
              "scene.toml:4: object[0].shap: unknown key (did you mean \"shape\"?)");
}

// Types and ranges

TEST_F(SceneFile, RefusesWrongTypes) {
    const auto simulation = [&](const std::string& line) {
        return error(std::string(kBall) + "[simulation]\n" + line);
    };
    EXPECT_EQ(simulation("frame_rate = 'fast'"),
              "scene.toml:5: simulation.frame_rate = \"fast\": must be a number, is a string");
    EXPECT_EQ(simulation("frames = 2.5"),
              "scene.toml:5: simulation.frames = 2.5: must be a whole number, is a fraction");
    EXPECT_EQ(simulation("solver = 4"),
              "scene.toml:5: simulation.solver = 4: must be a string, is a whole number");
    EXPECT_EQ(simulation("gravity = -9.81"),
              "scene.toml:5: simulation.gravity = -9.81: must be a list of 3 numbers, is a fraction");
    EXPECT_EQ(simulation("gravity = [0, 1]"),
              "scene.toml:5: simulation.gravity = [0, 1]: must be a list of 3 numbers, has 2");
    EXPECT_EQ(simulation("gravity = [0,\n true,\n 0]"),
              "scene.toml:6: simulation.gravity[1] = true: must be a number, is true or false");
}

TEST_F(SceneFile, RefusesNumbersThatAreNotFinite) {
    EXPECT_EQ(error(std::string(kBall) + "[simulation]\ngravity = [0, nan, 0]"),
              "scene.toml:5: simulation.gravity[1] = nan: must be finite");
    EXPECT_EQ(material_error("damping = inf"), "scene.toml:6: material.jelly.damping = inf: must be finite");
}

TEST_F(SceneFile, RefusesNumbersThatFloatsCannotSquare) {
    EXPECT_EQ(
        object_error("shape = {sphere = 1}\nposition = [1e30, 0, 0]"),
        "scene.toml:5: object.ball.position[0] = 1e+30: must be 0 or of a magnitude from 1e-15 to 1e15");
}

TEST_F(SceneFile, RefusesValuesOutOfRange) {
    const auto simulation = [&](const std::string& line) {
        return error(std::string(kBall) + "[simulation]\n" + line);
    };
    EXPECT_EQ(simulation("frame_rate = 0"),
              "scene.toml:5: simulation.frame_rate = 0: must be greater than 0");
    EXPECT_EQ(simulation("frames = -1"), "scene.toml:5: simulation.frames = -1: must be 0 or more");
    EXPECT_EQ(simulation("frames = 3000000000"),
              "scene.toml:5: simulation.frames = 3000000000: must be at most 2147483647");
    EXPECT_EQ(simulation("substeps = 0"),
              "scene.toml:5: simulation.substeps = 0: must be \"auto\" or from 1 to 1000000");
    EXPECT_EQ(simulation("substeps = 'some'"),
              "scene.toml:5: simulation.substeps = \"some\": must be \"auto\" or from 1 to 1000000");
    EXPECT_EQ(material_error("density = -3.0"),
              "scene.toml:6: material.jelly.density = -3: must be greater than 0");
    EXPECT_EQ(material_error("youngs_modulus = 0"),
              "scene.toml:6: material.jelly.youngs_modulus = 0: must be greater than 0");
    EXPECT_EQ(material_error("poisson_ratio = 0.5"),
              "scene.toml:6: material.jelly.poisson_ratio = 0.5: must be from 0 to 0.49");
    EXPECT_EQ(material_error("damping = -1"), "scene.toml:6: material.jelly.damping = -1: must be 0 or more");
    EXPECT_EQ(error(std::string(kBall) + "[collision]\nrestitution = 1.5"),
              "scene.toml:5: collision.restitution = 1.5: must be from 0 to 1");
    EXPECT_EQ(error(std::string(kBall) + "[collision]\nfriction = -0.5"),
              "scene.toml:5: collision.friction = -0.5: must be 0 or more");
    EXPECT_EQ(error(std::string(kBall) + "[collision]\nproximity_radius = 0"),
              "scene.toml:5: collision.proximity_radius = 0: must be greater than 0");
    EXPECT_EQ(error(std::string(kBall) + "[collision]\nproximity_radius = 'far'"),
              "scene.toml:5: collision.proximity_radius = \"far\": must be a number, is a string");
    EXPECT_EQ(
        error(std::string(kBall) + "[collision]\nproximity_radius = 0.1\nbroad_phase = 'depth'"),
        "scene.toml:5: collision.proximity_radius = 0.1: must not be given with broad_phase = \"depth\", "
        "which finds what touches, not what is near");
    EXPECT_EQ(object_error("shape = {sphere = 1}\nscale = 0"),
              "scene.toml:5: object.ball.scale = 0: must be greater than 0");
    EXPECT_EQ(object_error("shape = {sphere = 1}\ncolor = [0, 255, 0]"),
              "scene.toml:5: object.ball.color[1] = 255: must be from 0 to 1");
    EXPECT_EQ(object_error("shape = {sphere = 1}\nmesher = {quality = 1}"),
              "scene.toml:5: object.ball.mesher.quality = 1: must be greater than 1");
    EXPECT_EQ(object_error("shape = {sphere = 1}\nmesher = {max_volume = 0}"),
              "scene.toml:5: object.ball.mesher.max_volume = 0: must be greater than 0");
    EXPECT_EQ(object_error("shape = {sphere = 1}\nmesher = {time_limit = 0}"),
              "scene.toml:5: object.ball.mesher.time_limit = 0: must be greater than 0");
}

TEST_F(SceneFile, RefusesUnknownChoices) {
    EXPECT_EQ(
        error(std::string(kBall) + "[collision]\ndetection = 'continous'"),
        "scene.toml:5: collision.detection = \"continous\": must be discrete or continuous (did you mean "
        "\"continuous\"?)");
    EXPECT_EQ(error(std::string(kBall) + "[collision]\ndetection = true"),
              "scene.toml:5: collision.detection = true: must be a string, is true or false");
    EXPECT_EQ(error(std::string(kBall) + "[simulation]\nsolver = 'rk5'"),
              "scene.toml:5: simulation.solver = \"rk5\": must be explicit_euler, "
              "semi_implicit_euler, midpoint, "
              "rk4, implicit or vbd (did you mean \"rk4\"?)");
    EXPECT_EQ(error(std::string(kBall) + "[simulation]\nforces = 'quick'"),
              "scene.toml:5: simulation.forces = \"quick\": must be divide_and_merge or fused");
    EXPECT_EQ(
        object_error("shape = {sphere = 1}\nmesher = {kind = 'netgen'}"),
        "scene.toml:5: object.ball.mesher.kind = \"netgen\": must be auto, tetgen or lattice (did you mean "
        "\"tetgen\"?)");
}

TEST_F(SceneFile, RefusesSpringsThatAreNoListOfKinds) {
    EXPECT_EQ(material_error("springs = []"),
              "scene.toml:6: material.jelly.springs = []: must name at least one of "
              "structural, shear or flex");
    EXPECT_EQ(material_error("springs = 'shear'"),
              "scene.toml:6: material.jelly.springs = \"shear\": must be a list "
              "of names: structural, shear and flex");
    EXPECT_EQ(material_error("springs = ['sheer']"),
              "scene.toml:6: material.jelly.springs[0] = \"sheer\": must be structural, shear or "
              "flex (did you "
              "mean \"shear\"?)");
    EXPECT_EQ(material_error("springs = ['flex', 'flex']"),
              "scene.toml:6: material.jelly.springs[1] = \"flex\": is there twice");
}

TEST_F(SceneFile, TakesTheModelOfAMaterial) {
    EXPECT_EQ(load(kBall).materials[0].model, MaterialModel::mass_spring);
    const Scene scene = load(
        "material = [{name = 'flesh', model = 'neo_hookean', poisson_ratio = 0.45}]\n"
        "object = [{name = 'ball', shape = {sphere = 0.5}}]\n");
    EXPECT_EQ(scene.materials[0].model, MaterialModel::neo_hookean);
    EXPECT_EQ(scene.materials[0].poisson_ratio, 0.45);
}

TEST_F(SceneFile, RefusesWhatAModelDoesNotHave) {
    EXPECT_EQ(
        material_error("model = 'neo_hookaen'"),
        "scene.toml:6: material.jelly.model = \"neo_hookaen\": must be mass_spring or neo_hookean (did you "
        "mean \"neo_hookean\"?)");
    EXPECT_EQ(
        material_error("model = 'neo_hookean'\nsprings = ['shear']"),
        "scene.toml:7: material.jelly.springs = [\"shear\"]: must not be given with model = \"neo_hookean\", "
        "which has none");
    for (const char* value : {"-0.1", "0.5"}) {
        EXPECT_EQ(material_error(std::string("model = 'neo_hookean'\npoisson_ratio = ") + value),
                  std::string("scene.toml:7: material.jelly.poisson_ratio = ") + value +
                      ": must be 0 or more and less than 0.5 with model = \"neo_hookean\"");
    }
}

TEST_F(SceneFile, RefusesACameraInItsTarget) {
    EXPECT_EQ(error(std::string(kBall) + "[camera]\neye = [1, 1, 1]\ntarget = [1, 1, 1]"),
              "scene.toml:5: camera.eye = [1, 1, 1]: must not be the target");
    EXPECT_EQ(
        error(std::string(kBall) + "[camera]\neye = [1, 1, 1]\ntarget = [0, 0, 0]\nfield_of_view = 180"),
        "scene.toml:7: camera.field_of_view = 180: must be greater than 0 and less than 180");
}

TEST_F(SceneFile, GravityPointsDown) {
    EXPECT_EQ(load(kBall).gravity(), glm::dvec3(0.0, -9.81, 0.0));
    EXPECT_EQ(load("up = 'z'\n" + std::string(kBall)).gravity(), glm::dvec3(0.0, 0.0, -9.81));
    EXPECT_EQ(load(kBall, {"up=z"}).up, Axis::z);
    EXPECT_EQ(load("up = 'z'\n" + std::string(kBall), {"simulation.gravity=[1, 2, 3]"}).gravity(),
              glm::dvec3(1.0, 2.0, 3.0));
}

TEST_F(SceneFile, NamesTheAxesThatMayPointUp) {
    EXPECT_THAT(error("up = 'x'\n" + std::string(kBall)), StartsWith("scene.toml:1: up = \"x\": "));
    EXPECT_THAT(error("up = 1\n" + std::string(kBall)), StartsWith("scene.toml:1: up = 1: "));
    EXPECT_THAT(object_error("shape = {sphere = 1}\nup = 'w'"),
                StartsWith("scene.toml:5: object.ball.up = \"w\": "));
    EXPECT_EQ(load(kBall, {"object.ball.up=x"}).objects[0].up, Axis::x);
}

}  // namespace
}  // namespace gelatin::test
