#include "model/scene/rule_test.h"

namespace gelatin::test {
namespace {

// Of the object's own table, whose lines follow its name.
class ObjectRule : public RuleTest {};

TEST_P(ObjectRule, HoldsInFilesAndInCode) {
    EXPECT_EQ(code_error(GetParam()), GetParam().problem);
    EXPECT_EQ(file_error(std::string(kMaterials) + "[[object]]\n" + GetParam().lines), GetParam().problem);
}

#define BALL "name = 'ball'\nshape = {sphere = 0.5}\n"
#define REGION "region = {plane = [1, 0, 0]}\n"

const Rule kObjectRules[] = {
    {"name", "name = ''\nshape = {sphere = 1}", BREAKS(s.objects[0].name = ""),
     "object[0].name = \"\": must not be empty"},
    {"name_of_lines", "name = \"a\\tb\"\nshape = {sphere = 1}", BREAKS(s.objects[0].name = "a\tb"),
     "object[0].name = \"a\\tb\": must not have line breaks or other control characters"},
    {"sphere", "name = 'ball'\nshape = {sphere = -1}", BREAKS(s.objects[0].shape = SphereShape{-1}),
     "object.ball.shape.sphere = -1: must be greater than 0"},
    {"sphere_frequency", "name = 'ball'\nshape = {sphere = 1, frequency = 501}",
     BREAKS(s.objects[0].shape = (SphereShape{1, 501})),
     "object.ball.shape.frequency = 501: must be from 1 to 500"},
    {"box", "name = 'ball'\nshape = {box = [1, 1, nan]}",
     BREAKS(s.objects[0].shape = BoxShape{glm::dvec3(1, 1, kNan)}),
     "object.ball.shape.box[2] = nan: must be finite"},
    {"segments", "name = 'ball'\nshape = {box = [1, 1, 1], segments = [1, 0, 1]}",
     BREAKS(s.objects[0].shape = (BoxShape{glm::dvec3(1), glm::ivec3(1, 0, 1)})),
     "object.ball.shape.segments[1] = 0: must be from 1 to 1000"},
    {"capsule", "name = 'ball'\nshape = {capsule = 0}", BREAKS(s.objects[0].shape = CapsuleShape{0}),
     "object.ball.shape.capsule = 0: must be greater than 0"},
    {"capsule_length", "name = 'ball'\nshape = {capsule = 1, length = 0}",
     BREAKS(s.objects[0].shape = (CapsuleShape{1, 0})),
     "object.ball.shape.length = 0: must be greater than 0"},
    {"capsule_frequency", "name = 'ball'\nshape = {capsule = 1, frequency = 1}",
     BREAKS(s.objects[0].shape = (CapsuleShape{1, 1, 1})),
     "object.ball.shape.frequency = 1: must be from 2 to 500"},
    {"text", "name = 'ball'\nshape = {text = ''}", BREAKS(s.objects[0].shape = TextShape{""}),
     "object.ball.shape.text = \"\": must not be empty"},
    {"text_depth", "name = 'ball'\nshape = {text = 'A', depth = 0}",
     BREAKS(s.objects[0].shape = (TextShape{"A", 0})), "object.ball.shape.depth = 0: must be greater than 0"},
    {"text_size", "name = 'ball'\nshape = {text = 'A', size = -1}",
     BREAKS(s.objects[0].shape = (TextShape{"A", 1, -1})),
     "object.ball.shape.size = -1: must be greater than 0"},
    {"text_font", "name = 'ball'\nshape = {text = 'A', font = ''}",
     BREAKS(s.objects[0].shape = (TextShape{"A", 1, 1, ""})),
     "object.ball.shape.font = \"\": must not be empty"},
    {"file", "name = 'ball'\nshape = {file = ''}", BREAKS(s.objects[0].shape = FileShape{}),
     "object.ball.shape.file = \"\": must not be empty"},
    {"quality", BALL "mesher = {quality = 1}", BREAKS(s.objects[0].mesher.quality = 1),
     "object.ball.mesher.quality = 1: must be greater than 1"},
    {"max_volume", BALL "mesher = {max_volume = 0}", BREAKS(s.objects[0].mesher.max_volume = 0),
     "object.ball.mesher.max_volume = 0: must be greater than 0"},
    {"time_limit", BALL "mesher = {time_limit = -1}", BREAKS(s.objects[0].mesher.time_limit = -1),
     "object.ball.mesher.time_limit = -1: must be greater than 0"},
    {"nodes", BALL "mesher = {kind = 'lattice', nodes = 9}",
     BREAKS(s.objects[0].mesher.kind = MesherKind::lattice; s.objects[0].mesher.nodes = 9),
     "object.ball.mesher.nodes = 9: must be from 10 to 1000000"},
    {"cell_size", BALL "mesher = {kind = 'lattice', cell_size = 0}",
     BREAKS(s.objects[0].mesher.kind = MesherKind::lattice; s.objects[0].mesher.cell_size = 0.0),
     "object.ball.mesher.cell_size = 0: must be greater than 0"},
    {"cells_of_tetgen", BALL "mesher = {kind = 'tetgen', cell_size = 1}",
     BREAKS(s.objects[0].mesher.kind = MesherKind::tetgen; s.objects[0].mesher.cell_size = 1.0),
     "object.ball.mesher.cell_size = 1: is only for the lattice, not for kind = \"tetgen\"; nodes and "
     "max_volume are for both"},
    {"two_sizes", BALL "mesher = {kind = 'tetgen', nodes = 100, max_volume = 1}",
     BREAKS(s.objects[0].mesher.kind = MesherKind::tetgen; s.objects[0].mesher.nodes = 100;
            s.objects[0].mesher.max_volume = 1.0),
     "object.ball.mesher.nodes = 100: must not be given with another of nodes, cell_size and max_volume"},
    {"size_and_cells", BALL "mesher = {nodes = 100, cell_size = 1}",
     BREAKS(s.objects[0].mesher.nodes = 100; s.objects[0].mesher.cell_size = 1.0),
     "object.ball.mesher.cell_size = 1: must not be given with another of nodes, cell_size and max_volume"},
    {"quality_of_the_lattice", BALL "mesher = {kind = 'lattice', quality = 1.5}",
     BREAKS(s.objects[0].mesher.kind = MesherKind::lattice; s.objects[0].mesher.quality = 1.5),
     "object.ball.mesher.quality = 1.5: is only for TetGen, not for kind = \"lattice\""},
    {"material", BALL "material = 'jely'", BREAKS(s.objects[0].material = "jely"),
     "object.ball.material = \"jely\": no such material (did you mean \"jelly\"?); there is jelly"},
    {"no_material", BALL "material = ''", BREAKS(s.objects[0].material = ""),
     "object.ball: needs \"material\": one of jelly"},
    {"part_material", BALL "[[object.part]]\nmaterial = 'bone'\n" REGION, BREAKS(add_part(s, "bone")),
     "object.ball.part[0].material = \"bone\": no such material; there is jelly"},
    {"part_of_another_model",
     BALL "material = 'jelly'\n[[object.part]]\nmaterial = 'bone'\n" REGION
          "[[material]]\nname = 'bone'\nmodel = 'neo_hookean'",
     BREAKS(s.materials.push_back(s.materials[0]); s.materials[1].name = "bone";
            s.materials[1].model = MaterialModel::neo_hookean; add_part(s, "bone")),
     "object.ball.part[0].material = \"bone\": must have the same model and springs as the object's own, "
     "'jelly'"},
    {"part_of_other_springs",
     BALL "material = 'jelly'\n[[object.part]]\nmaterial = 'bone'\n" REGION
          "[[material]]\nname = 'bone'\nsprings = ['shear']",
     BREAKS(s.materials.push_back(s.materials[0]); s.materials[1].name = "bone";
            s.materials[1].springs = (SpringKinds{false, true, false}); add_part(s, "bone")),
     "object.ball.part[0].material = \"bone\": must have the same model and springs as the object's own, "
     "'jelly'"},
    {"part_region", BALL "[[object.part]]\nmaterial = 'jelly'\nregion = {plane = [0, 0, 0]}",
     BREAKS(s.objects[0].parts.push_back({Region(HalfSpaceRegion{glm::dvec3(0), 0}), "jelly"})),
     "object.ball.part[0].region.plane = [0, 0, 0]: must not be zero: a direction"},
    {"position", BALL "position = [0, inf, 0]", BREAKS(s.objects[0].position.y = kInfinite),
     "object.ball.position[1] = inf: must be finite"},
    {"rotation", BALL "rotation = [0, 0, nan]", BREAKS(s.objects[0].rotation.z = kNan),
     "object.ball.rotation[2] = nan: must be finite"},
    {"scale", BALL "scale = 0", BREAKS(s.objects[0].scale = 0),
     "object.ball.scale = 0: must be greater than 0"},
    {"velocity", BALL "velocity = [1e30, 0, 0]", BREAKS(s.objects[0].velocity.x = 1e30),
     "object.ball.velocity[0] = 1e+30: must be 0 or of a magnitude from 1e-15 to 1e15"},
    {"spin", BALL "spin = [nan, 0, 0]", BREAKS(s.objects[0].spin.x = kNan),
     "object.ball.spin[0] = nan: must be finite"},
    {"start_scale", BALL "start = {scale = [1, -1, 1]}", BREAKS(s.objects[0].start.scale.y = -1),
     "object.ball.start.scale[1] = -1: must be 0 or more"},
    {"start_scatter", BALL "start = {scatter = -1}", BREAKS(s.objects[0].start.scatter = -1),
     "object.ball.start.scatter = -1: must be 0 or more"},
    {"color", BALL "color = [0, 255, 0]", BREAKS(s.objects[0].color = glm::dvec3(0, 255, 0)),
     "object.ball.color[1] = 255: must be from 0 to 1"},
    {"pin_box_order", BALL "pins = [{box = [[0, 0, 0], [1, -1, 1]]}]",
     BREAKS(s.objects[0].pins = {BoxRegion{glm::dvec3(0), glm::dvec3(1, -1, 1)}}),
     "object.ball.pins[0].box = [[0, 0, 0], [1, -1, 1]]: the first corner must be the lower one: 0 is above "
     "-1 "
     "along y"},
    {"pin_box_finite", BALL "pins = [{plane = [0, 1, 0]}, {box = [[0, 0, 0], [1, inf, 1]]}]",
     BREAKS(s.objects[0].pins = {HalfSpaceRegion{glm::dvec3(0, 1, 0), 0},
                                 BoxRegion{glm::dvec3(0), glm::dvec3(1, kInfinite, 1)}}),
     "object.ball.pins[1].box = [[0, 0, 0], [1, inf, 1]]: corners must be three finite numbers each"},
    {"pin_center", BALL "pins = [{sphere = [nan, 0, 0], radius = 1}]",
     BREAKS(s.objects[0].pins = {SphereRegion{glm::dvec3(kNan, 0, 0), 1}}),
     "object.ball.pins[0].sphere[0] = nan: must be finite"},
    {"pin_radius", BALL "pins = [{sphere = [0, 0, 0], radius = 0}]",
     BREAKS(s.objects[0].pins = {SphereRegion{glm::dvec3(0), 0}}),
     "object.ball.pins[0].radius = 0: must be greater than 0"},
    {"pin_offset", BALL "pins = [{plane = [0, 1, 0], offset = nan}]",
     BREAKS(s.objects[0].pins = {HalfSpaceRegion{glm::dvec3(0, 1, 0), kNan}}),
     "object.ball.pins[0].offset = nan: must be finite"},
    {"handle_region", BALL "[[object.handle]]\nregion = {sphere = [0, 0, 0], radius = -1}",
     BREAKS(add_handle(s).region = (SphereRegion{glm::dvec3(0), -1})),
     "object.ball.handle[0].region.radius = -1: must be greater than 0"},
    {"pivot", BALL "[[object.handle]]\npivot = [0, nan, 0]\n" REGION,
     BREAKS(add_handle(s).pivot = glm::dvec3(0, kNan, 0)),
     "object.ball.handle[0].pivot[1] = nan: must be finite"},
    {"release", BALL "[[object.handle]]\nrelease = 0\n" REGION, BREAKS(add_handle(s).release = 0),
     "object.ball.handle[0].release = 0: must be greater than 0"},
    {"drag_move", BALL "[[object.handle]]\ndrag = {move = [inf, 0, 0]}\n" REGION,
     BREAKS(add_handle(s).drag.move.x = kInfinite),
     "object.ball.handle[0].drag.move[0] = inf: must be finite"},
    {"drag_turn", BALL "[[object.handle]]\ndrag = {turn = [inf, 0, 0]}\n" REGION,
     BREAKS(add_handle(s).drag.turn.x = kInfinite),
     "object.ball.handle[0].drag.turn[0] = inf: must be finite"},
    {"key_time", BALL "[[object.handle]]\nkeyframes = [{time = -1}]\n" REGION,
     BREAKS(add_handle(s).keyframes = {{-1.0}}),
     "object.ball.handle[0].keyframes[0].time = -1: must be 0 or more"},
    {"key_order", BALL "[[object.handle]]\nkeyframes = [{time = 1}, {time = 1}]\n" REGION,
     BREAKS(add_handle(s).keyframes = (std::vector<Keyframe>{{1.0}, {1.0}})),
     "object.ball.handle[0].keyframes[1].time = 1: must be greater than that of the keyframe before, 1"},
    {"key_rest", BALL "[[object.handle]]\nkeyframes = [{time = 0, move = [1, 0, 0]}]\n" REGION,
     BREAKS(add_handle(s).keyframes = {{0.0, glm::dvec3(1, 0, 0)}}),
     "object.ball.handle[0].keyframes[0]: the first keyframe is where the body starts: it must not move, "
     "rotate or scale it"},
    {"key_move", BALL "[[object.handle]]\nkeyframes = [{time = 0}, {time = 1, move = [nan, 0, 0]}]\n" REGION,
     BREAKS(add_handle(s).keyframes = (std::vector<Keyframe>{{0.0}, {1.0, glm::dvec3(kNan, 0, 0)}})),
     "object.ball.handle[0].keyframes[1].move[0] = nan: must be finite"},
    {"key_turn", BALL "[[object.handle]]\nkeyframes = [{time = 0}, {time = 1, turn = [0, nan, 0]}]\n" REGION,
     BREAKS(add_handle(s).keyframes = (std::vector<Keyframe>{{0.0}, {1.0, {}, glm::dvec3(0, kNan, 0)}})),
     "object.ball.handle[0].keyframes[1].turn[1] = nan: must be finite"},
    {"key_scale", BALL "[[object.handle]]\nkeyframes = [{time = 0}, {time = 1, scale = 0}]\n" REGION,
     BREAKS(add_handle(s).keyframes = (std::vector<Keyframe>{{0.0}, {1.0, {}, {}, 0.0}})),
     "object.ball.handle[0].keyframes[1].scale = 0: must be greater than 0"},
    {"stops", BALL "[[object.handle]]\nwhen_blocked = 'stops'\n" REGION,
     BREAKS(add_handle(s).when_blocked = WhenBlocked::stops),
     "object.ball.handle[0].when_blocked = \"stops\": needs keyframes or an animation"},
    {"skeleton_radius", BALL "[[object.handle]]\nskeleton = {file = 'a.glb', radius = 0}\n",
     BREAKS(add_handle(s).skeleton = SkeletonDescription{"a.glb"}),
     "object.ball.handle[0].skeleton.radius = 0: must be greater than 0"},
    {"skeleton_file", BALL "[[object.handle]]\nskeleton = {file = 'a.obj', radius = 1}\n",
     BREAKS(add_handle(s).skeleton = (SkeletonDescription{"a.obj", 1.0})),
     "object.ball.handle[0].skeleton.file = \"a.obj\": must end in .gltf or .glb"},
    {"stops_without_contact",
     BALL "[[object.handle]]\nwhen_blocked = 'stops'\nkeyframes = [{time = 0}]\n" REGION
          "\n[collision]\nresponse = 'restore'",
     BREAKS(s.collision.response = CollisionResponse::restore; add_handle(s).keyframes = {{}};
            s.objects[0].handles[0].when_blocked = WhenBlocked::stops),
     "object.ball.handle[0].when_blocked = \"stops\": needs collision.response = \"contact\""},
    {"stops_explicitly",
     BALL "[[object.handle]]\nwhen_blocked = 'stops'\nkeyframes = [{time = 0}]\n" REGION
          "\n[simulation]\nsolver = 'rk4'",
     BREAKS(s.simulation.solver = SolverKind::rk4; add_handle(s).keyframes = {{}};
            s.objects[0].handles[0].when_blocked = WhenBlocked::stops),
     "object.ball.handle[0].when_blocked = \"stops\": needs collision.response = \"contact\""},
    {"load_region", BALL "[[object.load]]\nforce = [1, 0, 0]\nregion = {plane = [0, 0, 0]}",
     BREAKS(add_load(s).region = (HalfSpaceRegion{glm::dvec3(0), 0})),
     "object.ball.load[0].region.plane = [0, 0, 0]: must not be zero: a direction"},
    {"force", BALL "[[object.load]]\nforce = [nan, 0, 0]\n" REGION,
     BREAKS(add_load(s).kind = ForceLoad{glm::dvec3(kNan, 0, 0)}),
     "object.ball.load[0].force[0] = nan: must be finite"},
    {"traction", BALL "[[object.load]]\ntraction = [nan, 0, 0]\n" REGION,
     BREAKS(add_load(s).kind = TractionLoad{glm::dvec3(kNan, 0, 0)}),
     "object.ball.load[0].traction[0] = nan: must be finite"},
    {"pressure", BALL "[[object.load]]\npressure = inf\n" REGION,
     BREAKS(add_load(s).kind = PressureLoad{kInfinite}),
     "object.ball.load[0].pressure = inf: must be finite"},
    {"load_from", BALL "[[object.load]]\nforce = [1, 0, 0]\nfrom = -1\n" REGION,
     BREAKS(add_load(s).from = -1), "object.ball.load[0].from = -1: must be 0 or more"},
    {"load_until", BALL "[[object.load]]\nforce = [1, 0, 0]\nuntil = 0\n" REGION,
     BREAKS(add_load(s).until = 0), "object.ball.load[0].until = 0: must be greater than 0"},
    {"load_span", BALL "[[object.load]]\nforce = [1, 0, 0]\nfrom = 2\nuntil = 1\n" REGION,
     BREAKS(add_load(s).from = 2; s.objects[0].loads[0].until = 1),
     "object.ball.load[0].until = 1: must be greater than from, 2"},
};

class RigidRule : public RuleTest {};

TEST_P(RigidRule, HoldsInFilesAndInCode) {
    const Rule& rule = GetParam();
    const auto breaks = [&](Scene& scene) {
        scene.objects[0].rigid.emplace();
        rule.breaks(scene);
    };
    EXPECT_EQ(code_error({rule.name, rule.lines, breaks, rule.problem}), rule.problem);
    EXPECT_EQ(file_error(std::string(kMaterials) + "[[rigid]]\n" + rule.lines), rule.problem);
}

const Rule kRigidRules[] = {
    {"name", "name = ''\nshape = {sphere = 1}", BREAKS(s.objects[0].name = ""),
     "rigid[0].name = \"\": must not be empty"},
    {"shape", "name = 'ball'\nshape = {sphere = -1}", BREAKS(s.objects[0].shape = SphereShape{-1}),
     "rigid.ball.shape.sphere = -1: must be greater than 0"},
    {"material", BALL "material = 'jely'", BREAKS(s.objects[0].material = "jely"),
     "rigid.ball.material = \"jely\": no such material (did you mean \"jelly\"?); there is jelly"},
    {"position", BALL "position = [0, inf, 0]", BREAKS(s.objects[0].position.y = kInfinite),
     "rigid.ball.position[1] = inf: must be finite"},
    {"mass", BALL "mass = 0", BREAKS(s.objects[0].rigid->mass = 0),
     "rigid.ball.mass = 0: must be greater than 0"},
    {"mass_finite", BALL "mass = nan", BREAKS(s.objects[0].rigid->mass = kNan),
     "rigid.ball.mass = nan: must be finite"},
    {"inertia", BALL "inertia = [1, -1, 1]", BREAKS(s.objects[0].rigid->inertia = glm::dvec3(1, -1, 1)),
     "rigid.ball.inertia[1] = -1: must be greater than 0"},
    {"inertia_of_x", BALL "inertia = [4, 1, 2]", BREAKS(s.objects[0].rigid->inertia = glm::dvec3(4, 1, 2)),
     "rigid.ball.inertia[0] = 4: must be at most the sum of the other two, 3"},
    {"inertia_of_y", BALL "inertia = [1, 4, 2]", BREAKS(s.objects[0].rigid->inertia = glm::dvec3(1, 4, 2)),
     "rigid.ball.inertia[1] = 4: must be at most the sum of the other two, 3"},
    {"inertia_of_z", BALL "inertia = [1, 2, 3.5]",
     BREAKS(s.objects[0].rigid->inertia = glm::dvec3(1, 2, 3.5)),
     "rigid.ball.inertia[2] = 3.5: must be at most the sum of the other two, 3"},
    {"load", BALL "[[rigid.load]]\npressure = inf\n" REGION,
     BREAKS(add_load(s).kind = PressureLoad{kInfinite}), "rigid.ball.load[0].pressure = inf: must be finite"},
    {"solver", BALL "[simulation]\nsolver = 'rk4'", BREAKS(s.simulation.solver = SolverKind::rk4),
     "rigid.ball: needs simulation.solver = \"implicit\""},
};

INSTANTIATE_TEST_SUITE_P(Rigid, RigidRule, testing::ValuesIn(kRigidRules), rule_name);

class ValidateRigid : public RuleTest {
protected:
    static std::string error_of(const std::function<void(Scene&)>& breaks) {
        return code_error({"", "", breaks, ""});
    }
    // Of a rigid ball with something else.
    static std::string rigid_error(const std::function<void(ObjectDescription&)>& change) {
        return error_of([&](Scene& scene) {
            scene.objects[0].rigid.emplace();
            change(scene.objects[0]);
        });
    }
};

// Without contact, too; of a flat body whose moments are rounded: 0.1 + 0.7 < 0.8.
TEST_F(ValidateRigid, TakesSoundOnes) {
    EXPECT_EQ(rigid_error([](ObjectDescription&) {}), "no error");
    EXPECT_EQ(rigid_error([](ObjectDescription& o) {
                  o.rigid = RigidDescription{2.0, glm::dvec3(0.1, 0.7, 0.8)};
              }),
              "no error");
    EXPECT_EQ(
        error_of(BREAKS(s.objects[0].rigid.emplace(); s.collision.response = CollisionResponse::restore)),
        "no error");
}

// Files are refused as they are read.
TEST_F(ValidateRigid, RefusesWhatOnlyDeformableObjectsHave) {
    const std::string nodes =
        ": a rigid body has none: an [[attachment]] holds it, and a [[collider]] follows keyframes";
    const std::string tets = ": a rigid body has none: it does not deform, and has no tets";
    const Region region = HalfSpaceRegion{{1, 0, 0}, 0.0};
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) { o.pins = {region}; }), "rigid.ball.pins" + nodes);
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) { o.handles.resize(1); }), "rigid.ball.handle" + nodes);
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) { o.mesher.nodes = 100; }), "rigid.ball.mesher" + tets);
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) {
                  o.parts = {{region, "jelly"}};
              }),
              "rigid.ball.part" + tets);
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) { o.start.scale.y = 0.5; }), "rigid.ball.start" + tets);
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) { o.start.scatter = 0.5; }), "rigid.ball.start" + tets);
    EXPECT_EQ(rigid_error([&](ObjectDescription& o) { o.skin = false; }), "rigid.ball.skin" + tets);
}

TEST_F(ValidateRigid, NamesAreFreeAmongAllObjects) {
    EXPECT_EQ(error_of(BREAKS(s.objects.push_back(s.objects[0]); s.objects[1].rigid.emplace())),
              "rigid.ball.name = \"ball\": is taken by another object");
}

// Files cannot contain them.
TEST(MeshShape, IsCheckedWhereItStands) {
    const auto error_of = [](const std::function<void(Scene&)>& breaks) {
        Scene scene = scene_of_file();
        breaks(scene);
        try {
            validate(scene);
        } catch (const InvalidInput& problem) {
            return std::string(problem.what());
        }
        return std::string("no error");
    };
    const auto tet = std::make_shared<Mesh>();
    tet->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tet->tets = {{0, 1, 2, 3}};
    EXPECT_EQ(error_of([&](Scene& s) { s.objects[0].shape = MeshShape{tet}; }), "no error");
    EXPECT_EQ(error_of([&](Scene& s) { s.objects[0].shape = MeshShape{}; }),
              "object.ball.shape.mesh = null: must be there");
    const auto far = std::make_shared<Mesh>(*tet);
    far->tets[0].w = 9;
    EXPECT_EQ(error_of([&](Scene& s) { s.objects[0].shape = MeshShape{far}; }),
              "object.ball.shape.mesh.tets[0] = 9: must name one of 4 vertices, from 0");
    const auto empty = std::make_shared<Mesh>();
    EXPECT_EQ(error_of([&](Scene& s) { s.objects[0].shape = MeshShape{empty}; }),
              "object.ball.shape.mesh: has neither triangles nor tets");
    EXPECT_EQ(error_of([&](Scene& s) {
                  s.collision.response = CollisionResponse::restore;
                  add_collider(s).shape = MeshShape{tet};
              }),
              "collider[0].shape.mesh: needs collision.response = \"contact\"");
}

INSTANTIATE_TEST_SUITE_P(Objects, ObjectRule, testing::ValuesIn(kObjectRules), rule_name);

}  // namespace
}  // namespace gelatin::test
