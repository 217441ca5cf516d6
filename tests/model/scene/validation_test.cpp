#include "model/scene/rule_test.h"

namespace gelatin::test {
namespace {

void restore(Scene& scene) {
    scene.collision.response = CollisionResponse::restore;
}

class SettingRule : public RuleTest {};

TEST_P(SettingRule, HoldsInFilesAndInCode) {
    EXPECT_EQ(code_error(GetParam()), GetParam().problem);
    EXPECT_EQ(file_error(std::string(kMaterials) + kObject + GetParam().lines), GetParam().problem);
}

// Of the material's own table, whose lines follow its name.
class MaterialRule : public RuleTest {};

TEST_P(MaterialRule, HoldsInFilesAndInCode) {
    EXPECT_EQ(code_error(GetParam()), GetParam().problem);
    EXPECT_EQ(file_error(std::string(kObject) + "[[material]]\n" + GetParam().lines), GetParam().problem);
}

const Rule kSettingRules[] = {
    {"frame_rate", "[simulation]\nframe_rate = 0", BREAKS(s.simulation.frame_rate = 0),
     "simulation.frame_rate = 0: must be greater than 0"},
    {"frame_rate_tiny", "[simulation]\nframe_rate = 1e-20", BREAKS(s.simulation.frame_rate = 1e-20),
     "simulation.frame_rate = 1e-20: must be 0 or of a magnitude from 1e-15 to 1e15"},
    {"substeps", "[simulation]\nsubsteps = 0", BREAKS(s.simulation.substeps = 0),
     "simulation.substeps = 0: must be \"auto\" or from 1 to 1000000"},
    {"substeps_negative", "[simulation]\nsubsteps = -3", BREAKS(s.simulation.substeps = -3),
     "simulation.substeps = -3: must be \"auto\" or from 1 to 1000000"},
    {"iterations", "[simulation]\niterations = 0", BREAKS(s.simulation.iterations = 0),
     "simulation.iterations = 0: must be from 1 to 1000"},
    {"gravity", "[simulation]\ngravity = [0, nan, 0]", BREAKS(s.simulation.gravity = glm::dvec3(0, kNan, 0)),
     "simulation.gravity[1] = nan: must be finite"},
    {"frames", "[simulation]\nframes = -1", BREAKS(s.simulation.frames = -1),
     "simulation.frames = -1: must be 0 or more"},
    {"detection", "[collision]\nbroad_phase = 'depth'\ndetection = 'continuous'",
     BREAKS(s.collision.broad_phase = BroadPhase::depth;
            s.collision.detection = CollisionDetection::continuous),
     "collision.detection = \"continuous\": must be \"discrete\" with broad_phase = \"depth\", which sees "
     "one "
     "moment"},
    {"proximity_radius", "[collision]\nproximity_radius = -1", BREAKS(s.collision.proximity_radius = -1),
     "collision.proximity_radius = -1: must be greater than 0"},
    {"proximity_depth", "[collision]\nbroad_phase = 'depth'\nproximity_radius = 0.1",
     BREAKS(s.collision.broad_phase = BroadPhase::depth; s.collision.proximity_radius = 0.1),
     "collision.proximity_radius = 0.1: must not be given with broad_phase = \"depth\", which finds what "
     "touches, "
     "not what is near"},
    {"response", "[collision]\nresponse = 'contact'\n[simulation]\nsolver = 'rk4'",
     BREAKS(s.collision.response = CollisionResponse::contact; s.simulation.solver = SolverKind::rk4),
     "collision.response = \"contact\": needs solver = \"implicit\"; with other solvers it must be "
     "\"restore\""},
    {"response_depth", "[collision]\nresponse = 'contact'\nbroad_phase = 'depth'",
     BREAKS(s.collision.response = CollisionResponse::contact; s.collision.broad_phase = BroadPhase::depth),
     "collision.broad_phase = \"depth\": must be none, boxes or hierarchy with response = \"contact\", which "
     "is "
     "what implicit solvers have unless response = \"restore\" is given"},
    {"response_depth_by_default", "[collision]\nbroad_phase = 'depth'",
     BREAKS(s.collision.broad_phase = BroadPhase::depth),
     "collision.broad_phase = \"depth\": must be none, boxes or hierarchy with response = \"contact\", which "
     "is "
     "what implicit solvers have unless response = \"restore\" is given"},
    {"friction", "[collision]\nfriction = -1", BREAKS(s.collision.friction = -1),
     "collision.friction = -1: must be 0 or more"},
    {"restitution", "[collision]\nrestitution = 2", BREAKS(s.collision.restitution = 2),
     "collision.restitution = 2: must be from 0 to 1"},
    {"camera_eye", "[camera]\neye = [inf, 0, 0]\ntarget = [0, 0, 0]",
     BREAKS(s.camera = CameraDescription{glm::dvec3(kInfinite, 0, 0), {}}),
     "camera.eye[0] = inf: must be finite"},
    {"camera_target", "[camera]\neye = [1, 0, 0]\ntarget = [0, 0, -1e16]",
     BREAKS(s.camera = CameraDescription{glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1e16)}),
     "camera.target[2] = -1e+16: must be 0 or of a magnitude from 1e-15 to 1e15"},
    {"camera_angle", "[camera]\neye = [1, 0, 0]\ntarget = [0, 0, 0]\nfield_of_view = 180",
     BREAKS(s.camera = CameraDescription{glm::dvec3(1, 0, 0), glm::dvec3(0), 180.0}),
     "camera.field_of_view = 180: must be greater than 0 and less than 180"},
    {"camera_in_target", "[camera]\neye = [1, 0, 0]\ntarget = [1, 0, 0]",
     BREAKS(s.camera = CameraDescription{glm::dvec3(1, 0, 0), glm::dvec3(1, 0, 0)}),
     "camera.eye = [1, 0, 0]: must not be the target"},
    {"plane_zero", "[[collider]]\nshape = {plane = [0, 0, 0]}",
     BREAKS(add_collider(s).shape = PlaneCollider{glm::dvec3(0), 0}),
     "collider[0].shape.plane = [0, 0, 0]: must not be zero: a direction"},
    {"plane_nan", "[[collider]]\nshape = {plane = [0, nan, 0]}",
     BREAKS(add_collider(s).shape = PlaneCollider{glm::dvec3(0, kNan, 0), 0}),
     "collider[0].shape.plane[1] = nan: must be finite"},
    {"plane_offset", "[[collider]]\nshape = {plane = [0, 1, 0], offset = inf}",
     BREAKS(add_collider(s).shape = PlaneCollider{glm::dvec3(0, 1, 0), kInfinite}),
     "collider[0].shape.offset = inf: must be finite"},
    {"plane_position", "[[collider]]\nshape = {plane = [0, 1, 0]}\nposition = [0, 2, 0]",
     BREAKS(add_collider(s).position.y = 2),
     "collider[0].position = [0, 2, 0]: a plane has none: its shape's normal and offset place it"},
    {"plane_rotation", "[[collider]]\nshape = {plane = [0, 1, 0]}\nrotation = [9, 0, 0]",
     BREAKS(add_collider(s).rotation.x = 9),
     "collider[0].rotation = [9, 0, 0]: a plane has none: its shape's normal and offset place it"},
    {"box_collider", "[[collider]]\nshape = {box = [1, -1, 1]}",
     BREAKS(add_collider(s).shape = BoxShape{glm::dvec3(1, -1, 1)}),
     "collider[0].shape.box[1] = -1: must be greater than 0"},
    {"sphere_collider", "[[collider]]\nshape = {sphere = 0}", BREAKS(add_collider(s).shape = SphereShape{0}),
     "collider[0].shape.sphere = 0: must be greater than 0"},
    {"capsule_collider", "[[collider]]\nshape = {capsule = nan}",
     BREAKS(add_collider(s).shape = CapsuleShape{kNan}), "collider[0].shape.capsule = nan: must be finite"},
    {"capsule_length", "[[collider]]\nshape = {capsule = 1, length = 0}",
     BREAKS(add_collider(s).shape = (CapsuleShape{1, 0})),
     "collider[0].shape.length = 0: must be greater than 0"},
    {"collider_position", "[[collider]]\nshape = {sphere = 1}\nposition = [0, 0, inf]",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].position.z = kInfinite),
     "collider[0].position[2] = inf: must be finite"},
    {"collider_rotation", "[[collider]]\nshape = {sphere = 1}\nrotation = [0, 0, inf]",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].rotation.z = kInfinite),
     "collider[0].rotation[2] = inf: must be finite"},
    {"collider_friction", "[[collider]]\nshape = {sphere = 1}\nfriction = -1",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].friction = -1),
     "collider[0].friction = -1: must be 0 or more"},
    {"collider_restitution", "[[collider]]\nshape = {sphere = 1}\nrestitution = -1",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].restitution = -1),
     "collider[0].restitution = -1: must be from 0 to 1"},
    {"collider_text", "[[collider]]\nshape = {text = 'A'}\n[collision]\nresponse = 'restore'",
     BREAKS(restore(s); add_collider(s).shape = TextShape{"A"}),
     "collider[0].shape.text = \"A\": needs collision.response = \"contact\""},
    {"collider_keyframes",
     "[[collider]]\nshape = {sphere = 1}\nkeyframes = [{time = 0}]\n[collision]\nresponse = \'restore\'",
     BREAKS(restore(s); add_collider(s).shape = SphereShape{1}; s.colliders[0].keyframes = {{}}),
     "collider[0].keyframes = [{...}]: needs collision.response = \"contact\""},
    {"collider_belt",
     "[[collider]]\nshape = {sphere = 1}\nsurface_velocity = [1, 0, 0]\n[collision]\nresponse = \'restore\'",
     BREAKS(restore(s); add_collider(s).shape = SphereShape{1}; s.colliders[0].surface_velocity.x = 1),
     "collider[0].surface_velocity = [1, 0, 0]: needs collision.response = \"contact\""},
    {"collider_scale", "[[collider]]\nshape = {sphere = 1}\nscale = 2\n[collision]\nresponse = \'restore\'",
     BREAKS(restore(s); add_collider(s).shape = SphereShape{1}; s.colliders[0].scale = 2),
     "collider[0].scale = 2: needs collision.response = \"contact\""},
    {"collider_no_scale", "[[collider]]\nshape = {sphere = 1}\nscale = 0",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].scale = 0),
     "collider[0].scale = 0: must be greater than 0"},
    {"plane_up", "[[collider]]\nshape = {plane = [0, 1, 0]}\nup = 'z'", BREAKS(add_collider(s).up = Axis::z),
     "collider[0].up = \"z\": a plane has none: its shape's normal and offset place it"},
    {"plane_scale", "[[collider]]\nshape = {plane = [0, 1, 0]}\nscale = 2", BREAKS(add_collider(s).scale = 2),
     "collider[0].scale = 2: a plane has none: its shape's normal and offset place it"},
    {"plane_keyframes", "[[collider]]\nshape = {plane = [0, 1, 0]}\nkeyframes = [{time = 0}]",
     BREAKS(add_collider(s).keyframes = {{}}),
     "collider[0].keyframes = [{...}]: a plane does not move: a box can"},
    {"collider_stops", "[[collider]]\nshape = {sphere = 1}\nwhen_blocked = 'stops'",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].when_blocked = WhenBlocked::stops),
     "collider[0].when_blocked = \"stops\": needs keyframes or an animation"},
    {"clip_of_a_box", "[[collider]]\nshape = {box = [1, 1, 1]}\nanimation = {clip = 'a'}",
     BREAKS(add_collider(s).shape = BoxShape{{1, 1, 1}};
            s.colliders[0].animation = AnimationDescription{AnimationClip{"a"}}),
     "collider[0].animation.clip = \"a\": needs a shape from a .gltf or .glb file"},
    {"files_of_a_box", "[[collider]]\nshape = {box = [1, 1, 1]}\nanimation = {files = 'a*.obj'}",
     BREAKS(add_collider(s).shape = BoxShape{{1, 1, 1}};
            s.colliders[0].animation = AnimationDescription{AnimationFiles{"a*.obj"}}),
     "collider[0].animation.files = \"a*.obj\": needs a shape from a file with the same vertices"},
    {"file_rate", "[[collider]]\nshape = {file = 'a.obj'}\nanimation = {files = 'a*.obj', rate = 0}",
     BREAKS(add_collider(s).shape = FileShape{"a.obj"};
            s.colliders[0].animation = AnimationDescription{AnimationFiles{"a*.obj", 0.0}}),
     "collider[0].animation.rate = 0: must be greater than 0"},
    {"animation_start", "[[collider]]\nshape = {file = 'a.glb'}\nanimation = {start = -1}",
     BREAKS(add_collider(s).shape = FileShape{"a.glb"};
            s.colliders[0].animation = AnimationDescription{AnimationClip{}, -1.0}),
     "collider[0].animation.start = -1: must be 0 or more"},
    {"animation_speed", "[[collider]]\nshape = {file = 'a.glb'}\nanimation = {speed = 0}",
     BREAKS(add_collider(s).shape = FileShape{"a.glb"};
            s.colliders[0].animation = AnimationDescription{AnimationClip{}, 0.0, 0.0}),
     "collider[0].animation.speed = 0: must be greater than 0"},
    {"animated_plane", "[[collider]]\nshape = {plane = [0, 1, 0]}\nanimation = {by_program = true}",
     BREAKS(add_collider(s).animation = AnimationDescription{AnimationByProgram{}}),
     "collider[0].animation: a plane does not move: a box can"},
    {"animated_solid",
     "[[collider]]\nshape = {sphere = 1}\nanimation = {by_program = true}\n[collision]\nresponse = 'restore'",
     BREAKS(restore(s); add_collider(s).shape = SphereShape{1};
            s.colliders[0].animation = AnimationDescription{AnimationByProgram{}}),
     "collider[0].animation: needs collision.response = \"contact\""},
    {"plane_stops", "[[collider]]\nshape = {plane = [0, 1, 0]}\nwhen_blocked = 'stops'",
     BREAKS(add_collider(s).when_blocked = WhenBlocked::stops),
     "collider[0].when_blocked = \"stops\": a plane does not move: a box can"},
    {"collider_frames", "[[collider]]\nshape = {sphere = 1}\nkeyframes = [{time = -1}]",
     BREAKS(add_collider(s).shape = SphereShape{1}; s.colliders[0].keyframes = {{-1.0}}),
     "collider[0].keyframes[0].time = -1: must be 0 or more"},
};

const Rule kMaterialRules[] = {
    {"name", "name = ''", BREAKS(s.materials[0].name = ""), "material[0].name = \"\": must not be empty"},
    {"name_of_lines", "name = \"a\\n\\\"b\\u0001\"", BREAKS(s.materials[0].name = "a\n\"b\x01"),
     "material[0].name = \"a\\n\\\"b\\u0001\": must not have line breaks or other control characters"},
    {"youngs_modulus", "name = 'jelly'\nyoungs_modulus = 0", BREAKS(s.materials[0].youngs_modulus = 0),
     "material.jelly.youngs_modulus = 0: must be greater than 0"},
    {"density", "name = 'jelly'\ndensity = -2.5", BREAKS(s.materials[0].density = -2.5),
     "material.jelly.density = -2.5: must be greater than 0"},
    {"density_huge", "name = 'jelly'\ndensity = 1e16", BREAKS(s.materials[0].density = 1e16),
     "material.jelly.density = 1e+16: must be 0 or of a magnitude from 1e-15 to 1e15"},
    {"poisson_ratio", "name = 'jelly'\npoisson_ratio = 0.495", BREAKS(s.materials[0].poisson_ratio = 0.495),
     "material.jelly.poisson_ratio = 0.495: must be from 0 to 0.49"},
    {"neo_hookean_ratio", "name = 'jelly'\nmodel = 'neo_hookean'\npoisson_ratio = 0.5",
     BREAKS(s.materials[0].model = MaterialModel::neo_hookean; s.materials[0].poisson_ratio = 0.5),
     "material.jelly.poisson_ratio = 0.5: must be 0 or more and less than 0.5 with model = \"neo_hookean\""},
    {"damping", "name = 'jelly'\ndamping = inf", BREAKS(s.materials[0].damping = kInfinite),
     "material.jelly.damping = inf: must be finite"},
    {"friction", "name = 'jelly'\nfriction = -1", BREAKS(s.materials[0].friction = -1),
     "material.jelly.friction = -1: must be 0 or more"},
    {"friction_without_contact", "name = 'jelly'\nfriction = 1\n[collision]\nresponse = \'restore\'",
     BREAKS(restore(s); s.materials[0].friction = 1),
     "material.jelly.friction = 1: needs collision.response = \"contact\""},
    {"thickness", "name = 'jelly'\nthickness = 0", BREAKS(s.materials[0].thickness = 0),
     "material.jelly.thickness = 0: must be greater than 0"},
    {"thickness_without_contact", "name = 'jelly'\nthickness = 1\n[collision]\nresponse = \'restore\'",
     BREAKS(restore(s); s.materials[0].thickness = 1),
     "material.jelly.thickness = 1: needs collision.response = \"contact\""},
    {"contact_stiffness", "name = 'jelly'\ncontact_stiffness = 0",
     BREAKS(s.materials[0].contact_stiffness = 0),
     "material.jelly.contact_stiffness = 0: must be greater than 0"},
    {"contact_stiffness_without_contact",
     "name = 'jelly'\ncontact_stiffness = 2\n[collision]\nresponse = \'restore\'",
     BREAKS(restore(s); s.materials[0].contact_stiffness = 2),
     "material.jelly.contact_stiffness = 2: needs collision.response = \"contact\""},
    {"material_restitution", "name = 'jelly'\nrestitution = 2", BREAKS(s.materials[0].restitution = 2),
     "material.jelly.restitution = 2: must be from 0 to 1"},
    {"restitution_without_contact", "name = 'jelly'\nrestitution = 0.5\n[simulation]\nsolver = 'rk4'",
     BREAKS(s.materials[0].restitution = 0.5; s.simulation.solver = SolverKind::rk4),
     "material.jelly.restitution = 0.5: needs collision.response = \"contact\""},
    {"springs_of_a_model_without", "name = 'jelly'\nmodel = 'neo_hookean'\nsprings = ['structural', 'flex']",
     BREAKS(s.materials[0].model = MaterialModel::neo_hookean;
            s.materials[0].springs = (SpringKinds{true, false, true})),
     "material.jelly.springs = [\"structural\", \"flex\"]: must not be given with model = \"neo_hookean\", "
     "which "
     "has none"},
    {"no_kind_of_springs", "name = 'jelly'\nsprings = []",
     BREAKS(s.materials[0].springs = (SpringKinds{false, false, false})),
     "material.jelly.springs = []: must name at least one of structural, shear or flex"},
};

INSTANTIATE_TEST_SUITE_P(Settings, SettingRule, testing::ValuesIn(kSettingRules), rule_name);
INSTANTIATE_TEST_SUITE_P(Materials, MaterialRule, testing::ValuesIn(kMaterialRules), rule_name);

// What files say otherwise, or cannot say

class Validation : public RuleTest {
protected:
    static std::string error_of(const std::function<void(Scene&)>& breaks) {
        return code_error({"", "", breaks, ""});
    }
};

TEST_F(Validation, NamesWhatIsWrongWithAPairOfMaterials) {
    const auto error = [](const MaterialPair& pair, int count = 1) {
        return error_of([=](Scene& s) {
            s.collision.response = CollisionResponse::contact;
            s.collision.pairs.assign(static_cast<std::size_t>(count), pair);
        });
    };
    EXPECT_EQ(error({"jelly", "ice"}),
              "collision.pair[0].materials = [\"jelly\", \"ice\"]: must be of jelly");
    EXPECT_EQ(error({"jelly", "jelly"}, 2),
              "collision.pair[1].materials = [\"jelly\", \"jelly\"]: is there twice");
    EXPECT_EQ(error({"jelly", "jelly", -1.0}), "collision.pair[0].friction = -1: must be 0 or more");
    EXPECT_EQ(error({"jelly", "jelly", {}, 0.0}),
              "collision.pair[0].contact_stiffness = 0: must be greater than 0");
    EXPECT_EQ(error({"jelly", "jelly", {}, {}, 1.5}),
              "collision.pair[0].restitution = 1.5: must be from 0 to 1");
    EXPECT_EQ(error_of([](Scene& s) {
                  restore(s);
                  s.collision.pairs = {{"jelly", "jelly"}};
              }),
              "collision.pair[0] = [\"jelly\", \"jelly\"]: needs collision.response = \"contact\"");
}

TEST_F(Validation, TakesASoundScene) {
    EXPECT_NO_THROW(validate(scene_of_file()));
}

// The reader of a file says so itself.
TEST_F(Validation, UpIsYOrZ) {
    EXPECT_EQ(error_of(BREAKS(s.up = Axis::x)), "up = \"x\": must be \"y\" or \"z\"");
    EXPECT_NO_THROW(load("up = 'z'\n" + std::string(kBall)));
}

TEST_F(Validation, NeedsObjects) {
    EXPECT_EQ(error_of(BREAKS(s.objects.clear())), "has no objects: add an [[object]] or a [[rigid]]");
}

TEST_F(Validation, NeedsMaterials) {
    EXPECT_EQ(error_of(BREAKS(s.materials.clear(); s.objects[0].material = "")),
              "object.ball: needs a material: the scene has no [[material]]");
}

TEST_F(Validation, NamesAreFree) {
    EXPECT_EQ(error_of(BREAKS(s.materials.push_back(s.materials[0]))),
              "material.jelly.name = \"jelly\": is taken by another material");
    EXPECT_EQ(error_of(BREAKS(s.objects.push_back(s.objects[0]))),
              "object.ball.name = \"ball\": is taken by another object");
    const auto add_colliders = [](const std::vector<std::string>& names) {
        return [names](Scene& s) {
            for (const std::string& name : names) s.colliders.emplace_back().name = name;
        };
    };
    EXPECT_EQ(error_of(add_colliders({"", "", "ball"})), "no error") << "an object may have it, too";
    EXPECT_EQ(error_of(add_colliders({"wall", "floor", "wall"})),
              "collider.wall.name = \"wall\": is taken by another collider");
    EXPECT_EQ(error_of(add_colliders({"collider 2", ""})),
              "collider.collider 2.name = \"collider 2\": is taken by another collider");
    EXPECT_EQ(error_of(add_colliders({"a\nb"})),
              "collider[0].name = \"a\\nb\": must not have line breaks or other control characters");
}

// A file's directions are made unit as they are read.
TEST_F(Validation, DirectionsAreUnit) {
    EXPECT_EQ(error_of(BREAKS(add_collider(s).shape = PlaneCollider{glm::dvec3(0, 2, 0), 0})),
              "collider[0].shape.plane = [0, 2, 0]: must be of length 1");
    EXPECT_NO_THROW(load(std::string(kBall) + "[[collider]]\nshape = {plane = [1e-9, 2e5, 0]}"));
}

// As cosines of right angles are.
TEST_F(Validation, TakesCoordinatesThatRoundingLeavesOfZero) {
    EXPECT_EQ(error_of(BREAKS(s.objects[0].position.x = 6e-17)), "no error");
}

TEST_F(Validation, NamesTheFileOfASceneThatAProgramHasChanged) {
    Scene scene = load(kBall);
    scene.simulation.substeps = 0;
    try {
        validate(scene);
        FAIL();
    } catch (const InvalidInput& problem) {
        EXPECT_EQ(problem.problem().file, scene.file.string());
        EXPECT_EQ(problem.problem().field, "simulation.substeps");
        EXPECT_EQ(problem.problem().value, "0");
    }
}

// Copies are placed by their original's table.
TEST_F(Validation, TellsOfCopiesWhatTheirOwnValueIs) {
    EXPECT_EQ(file_error("[[material]]\nname = 'jelly'\n[[object]]\nname = 'b'\nshape = {sphere = 1}\n"
                         "position = [1e15, 0, 0]\ncopies = {counts = [2, 1, 1], spacing = [1e15, 1, 1]}"),
              "object.b.position[0] = 1000000000000000: 1500000000000000 must be 0 or of a magnitude from "
              "1e-15 to 1e15");
}

}  // namespace
}  // namespace gelatin::test
