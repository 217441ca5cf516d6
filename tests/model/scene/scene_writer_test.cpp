#include "model/scene/scene_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/file.h"
#include "gelatin/error.h"
#include "model/assembly/build_model.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

// Everything that a scene file can say, nothing of it as usual.
constexpr const char* kEverything = R"(up = "z"

[simulation]
solver = "implicit"
forces = "divide_and_merge"
frame_rate = 50.5
substeps = 3
iterations = 7
gravity = [0.5, -1.5, 0.125]
frames = 11
sleep = false

[collision]
broad_phase = "boxes"
detection = "continuous"
response = "restore"
self_collision = true
proximity_radius = 0.01
friction = 0.7
restitution = 0.1

[camera]
eye = [1, 2, 3]
target = [0, 1, 0]
field_of_view = 40

[[material]]
name = "a \"soft\" \\ one"
youngs_modulus = 12345.678
density = 900
poisson_ratio = 0.4
damping = 0.001
springs = ["structural", "flex"]

[[material]]
name = "neo"
model = "neo_hookean"
youngs_modulus = 1000000
density = 1100
poisson_ratio = 0.45
damping = 0

[[object]]
name = "ball"
shape = { sphere = 0.3, frequency = 3 }
mesher = { kind = "tetgen", quality = 1.8, max_volume = 0.001, time_limit = 60 }
material = "a \"soft\" \\ one"
scale = 1.5
rotation = [10, 20, 30]
up = "x"
position = [0, 2, 0]
velocity = [1, 0, 0]
spin = [0, 90, 0]
start = { scale = [1, 0.5, 1], scatter = 0.01 }
pins = [{ box = [[-1, 0, -1], [1, 1.7, 1]] }, { sphere = [0, 3, 0], radius = 0.1 }]
color = [0.1, 0.2, 0.3]
skin = false

[[object.part]]
region = { plane = [0, 1, 0], offset = 1.9 }
material = "a \"soft\" \\ one"

[[object.part]]
attribute = 4
material = "a \"soft\" \\ one"

[[object.handle]]
region = { plane = [0, -1, 0], offset = -2.3 }
pivot = [0, 2, 0]
interpolation = "smooth"
release = 3
keyframes = [{ time = 0 }, { time = 1.5, move = [0, 0.5, 0], turn = [720, 0, 0], scale = 1.25 }]
drag = { move = [0, 0, 0.5], turn = [0, 30, 0] }

[[object.load]]
region = { sphere = [0, 2, 0], radius = 9 }
force = [0, 1, 0]
from = 0.5
until = 1

[[object.load]]
region = { sphere = [0, 2, 0], radius = 9 }
traction = [10, 0, 0]

[[object.load]]
region = { sphere = [0, 2, 0], radius = 9 }
pressure = -250
until = 2

[[object]]
name = "box"
shape = { box = [1, 2, 3], segments = [2, 3, 4] }
material = "neo"

[[object]]
name = "capsule"
shape = { capsule = 0.2, length = 0.6, frequency = 4 }
material = "neo"

[[object]]
name = "letter"
shape = { text = "\u00e9\"", depth = 0.4, size = 2, font = "DejaVu Sans" }
material = "neo"

[[object]]
name = "file"
shape = { file = "meshes/some mesh.obj" }
material = "neo"

[[collider]]
shape = { plane = [0, 1, 0], offset = -0.5 }
friction = 0.1
restitution = 0.2

[[collider]]
shape = { box = [1, 2, 3], segments = [1, 1, 1] }
position = [5, 0, 0]
rotation = [0, 45, 0]
up = "y"
friction = 0.7
restitution = 0.1

[[collider]]
shape = { sphere = 0.4, frequency = 10 }
position = [0, 0, 5]
rotation = [0, 0, 0]
friction = 0.7
restitution = 0.1

[[collider]]
shape = { capsule = 0.3, length = 0.8, frequency = 8 }
position = [0, 0, 9]
rotation = [0, 0, 0]
friction = 0.7
restitution = 0.1
)";

TEST(SceneWriter, WritesEverythingThatWasRead) {
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml", kEverything);
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    std::string expected = kEverything;
    const std::size_t letter = expected.find("\\u00e9");
    expected.replace(letter, 6, "\u00e9");  // as UTF-8
    EXPECT_EQ(read_file(folder.path() / "copy.toml"), expected);
}

// What colliders have with response = "contact".
constexpr const char* kMovingColliders = R"([[collider]]
name = "press"
shape = { file = "press.obj" }
position = [0, 1, 0]
rotation = [0, 0, 0]
scale = 2
friction = 0.4
restitution = 0.3
keyframes = [{ time = 0 }, { time = 1, move = [0, -1, 0] }]
interpolation = "smooth"
when_blocked = "stops"
pivot = [1, 1, 1]
surface_velocity = [0.5, 0, 0]

[[collider]]
shape = { file = "walk.glb" }
position = [0, 0, 0]
rotation = [0, 0, 0]
friction = 0.4
restitution = 0.3
animation = { clip = "walk", start = 1, speed = 2, loop = true }

[[collider]]
shape = { file = "waves/wave_1.obj" }
position = [0, 0, 0]
rotation = [0, 0, 0]
friction = 0.4
restitution = 0.3
animation = { files = "waves/wave_*.obj", rate = 30 }

[[collider]]
shape = { box = [1, 1, 1], segments = [2, 2, 2] }
position = [0, 0, 0]
rotation = [0, 0, 0]
friction = 0.4
restitution = 0.3
animation = { by_program = true }
)";

TEST(SceneWriter, WritesHowCollidersMove) {
    const TemporaryFolder folder;
    const std::string head =
        "[collision]\nresponse = 'contact'\n[[material]]\nname = 'm'\n[[object]]\nname = 'o'\nshape = "
        "{sphere "
        "= 1}\n";
    write_file(folder.path() / "scene.toml", head + kMovingColliders);
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    const std::string copy = read_file(folder.path() / "copy.toml");
    EXPECT_EQ(copy.substr(copy.find("[[collider]]")), kMovingColliders);
}

TEST(SceneWriter, WritesSkeletons) {
    const TemporaryFolder folder;
    const std::string handle =
        "[[object.handle]]\nskeleton = { file = \"arm.glb\", radius = 0.05, clip = \"wave\", start = 0.5, "
        "speed = 2, loop = true }\nrelease = 3\n";
    write_file(folder.path() / "scene.toml",
               "[[material]]\nname = 'm'\n[[object]]\nname = 'o'\nshape = {sphere = 1}\n" + handle);
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    EXPECT_THAT(read_file(folder.path() / "copy.toml"), ::testing::HasSubstr(handle));
}

TEST(SceneWriter, WritesWhichHandlesStop) {
    const TemporaryFolder folder;
    const std::string handle =
        "[[object.handle]]\nregion = { plane = [0, 1, 0], offset = 0 }\n"
        "keyframes = [{ time = 0 }, { time = 1, move = [0, -1, 0] }]\nwhen_blocked = \"stops\"\n";
    write_file(folder.path() / "scene.toml",
               "[[material]]\nname = 'm'\n[[object]]\nname = 'o'\nshape = {sphere = 1}\n" + handle);
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    EXPECT_THAT(read_file(folder.path() / "copy.toml"), ::testing::HasSubstr(handle));
}

// In the order of the scene.
TEST(SceneWriter, WritesRigidBodiesAmongObjects) {
    constexpr const char* kObjects = R"([[rigid]]
name = "crate"
shape = { box = [1, 2, 3], segments = [1, 1, 1] }
material = "m"
scale = 1.5
rotation = [10, 20, 30]
up = "x"
position = [0, 2, 0]
velocity = [1, 0, 0]
spin = [0, 90, 0]
mass = 20
inertia = [1, 2, 2.5]
color = [0.1, 0.2, 0.3]

[[rigid.load]]
region = { sphere = [0, 2, 0], radius = 9 }
force = [0, 1, 0]

[[object]]
name = "ball"
shape = { sphere = 1, frequency = 10 }
material = "m"

[[rigid]]
name = "stone"
shape = { file = "stone.obj" }
material = "m"
)";
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml", "[[material]]\nname = 'm'\n" + std::string(kObjects));
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    const std::string copy = read_file(folder.path() / "copy.toml");
    EXPECT_EQ(copy.substr(copy.find("[[rigid]]")), kObjects);
}

TEST(SceneWriter, WritesAttachments) {
    constexpr const char* kAttachments = R"([[attachment]]
name = "a \"hook\""
object = "ball"
to = "beam"
region = { sphere = [0, 1, 0], radius = 0.25 }
compliance = 1e-05
break_force = 100

[[attachment]]
object = "ball"
to = "post"
point = [0, 1.5, 0]

[[attachment]]
object = "beam"
line = [[0, 1, -1], [0, 1, 1]]

[[attachment]]
object = "beam"
to = "ball"
)";
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml",
               "[[material]]\nname = 'm'\n[[object]]\nname = 'ball'\nshape = {sphere = 1}\n"
               "[[object]]\nname = 'beam'\nshape = {sphere = 1}\n"
               "[[collider]]\nname = 'post'\nshape = {sphere = 1}\n" +
                   std::string(kAttachments));
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    const std::string copy = read_file(folder.path() / "copy.toml");
    EXPECT_EQ(copy.substr(copy.find("[[attachment]]")), kAttachments);
}

TEST(SceneWriter, WritesCavities) {
    constexpr const char* kCavities = R"([[object.cavity]]
name = "air"
region = { sphere = [0, 1, 0], radius = 0.25 }
law = "constant"
pressure = 5000
keyframes = [{ time = 1, pressure = 100 }, { time = 2, pressure = 200 }]

[[object.cavity]]
amount = 1.5
ambient = 90000
keyframes = [{ time = 0, amount = 2 }]
)";
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml",
               "[[material]]\nname = 'm'\n[[object]]\nname = 'ball'\nshape = {sphere = 1}\n" +
                   std::string(kCavities));
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    const std::string copy = read_file(folder.path() / "copy.toml");
    EXPECT_EQ(copy.substr(copy.find("[[object.cavity]]")), kCavities);
}

TEST(SceneWriter, WritesJoints) {
    constexpr const char* kJoints = R"([[attachment]]
name = "door"
object = "ball"
to = "beam"
line = [[0, 1, -1], [0, 1, 1]]
compliance = 1e-05
limits = [-10, 90.5]
spring = { stiffness = 20, damping = 0.5, rest = 45 }
motor = { speed = 60, position = 30, force = 100, keyframes = [{ time = 1, speed = 30 }, { time = 2.5, position = 0, force = 0 }] }

[[attachment]]
object = "ball"
rail = [[0, 1, -1], [0, 1, 1]]
spring = { damping = 2 }
motor = { speed = -0.5 }

[[attachment]]
object = "ball"
to = "beam"
universal = { point = [0, 1.5, 0], own = [1, 0, 0], of_other = [0, 0, 2] }

[[attachment]]
object = "ball"
to = "beam"
distance = [[0, 1, 0], [0, 3, 0]]
limits = [0, 2]
)";
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml",
               "[[material]]\nname = 'm'\n[[rigid]]\nname = 'ball'\nshape = {sphere = 1}\n"
               "[[rigid]]\nname = 'beam'\nshape = {sphere = 1}\n" +
                   std::string(kJoints));
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    const std::string copy = read_file(folder.path() / "copy.toml");
    EXPECT_EQ(copy.substr(copy.find("[[attachment]]")), kJoints);
}

TEST(SceneWriter, WritesHowMaterialsPress) {
    constexpr const char* kText = R"([[collision.pair]]
materials = ["ice", "rubber"]
friction = 0.1
contact_stiffness = 3

[[collision.pair]]
materials = ["ice", "ice"]
friction = 0.02

[[material]]
name = "ice"
youngs_modulus = 1000000
density = 900
poisson_ratio = 0.25
damping = 0
friction = 0.05
thickness = 0.001
contact_stiffness = 2

)";
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml",
               "[collision]\nresponse = 'contact'\n" + std::string(kText) +
                   "[[material]]\nname = 'rubber'\n[[object]]\nname = 'o'\nshape = {sphere = 1}\nmaterial = "
                   "'ice'\n");
    save_scene(folder.path() / "copy.toml", load_scene(folder.path() / "scene.toml"));
    const std::string copy = read_file(folder.path() / "copy.toml");
    EXPECT_NE(copy.find(kText), std::string::npos) << copy;
}

TEST(SceneWriter, MeshFilesAreFoundFromWhereItIsWritten) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "elsewhere");
    write_file(folder.path() / "scene.toml",
               "material = [{name = 'm'}]\nobject = [{name = 'o', shape = {file = 'a.obj'}}]\n");
    const fs::path copy = folder.path() / "elsewhere" / "copy.toml";
    save_scene(copy, load_scene(folder.path() / "scene.toml"));
    const Scene scene = load_scene(copy);
    EXPECT_EQ(fs::weakly_canonical(std::get<FileShape>(scene.objects[0].shape).file),
              fs::weakly_canonical(folder.path() / "a.obj"));
}

TEST(SceneWriter, SaysThatAMeshInMemoryCannotBeWritten) {
    Scene scene;
    scene.objects.resize(1);
    scene.objects[0].shape = MeshShape{std::make_shared<Mesh>()};
    EXPECT_THROW(to_toml(scene, "."), InvalidInput);
}

// The scenes that come with Gelatin, among them copies and text.
TEST(SceneWriter, ScenesStayWhatTheyAre) {
    const TemporaryFolder folder;
    for (const auto& entry : fs::directory_iterator(fs::path(test::source_path()) / "scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const fs::path once = folder.path() / "once.toml", twice = folder.path() / "twice.toml";
        save_scene(once, load_scene(entry.path()));
        save_scene(twice, load_scene(once));
        EXPECT_EQ(read_file(twice), read_file(once)) << entry.path();
    }
    const Scene squash = load_scene(fs::path(test::source_path()) / "scenes" / "squash.toml");
    save_scene(folder.path() / "squash.toml", squash);
    const Model before = build_model(squash), after = build_model(load_scene(folder.path() / "squash.toml"));
    EXPECT_EQ(after.positions, before.positions);
    EXPECT_EQ(after.velocities, before.velocities);
    EXPECT_EQ(after.tets, before.tets);
}

}  // namespace
}  // namespace gelatin
