#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "mesh/shapes.h"
#include "mesh/surface_file.h"
#include "model/assembly/build_model.h"
#include "model/scene/override_scene.h"
#include "sim/recording/compression.h"
#include "sim/recording/recorded_meshes.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// One orange pixel.
constexpr unsigned char kPng[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                                  0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                  0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
                                  0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0xdf, 0xc0, 0x00,
                                  0x00, 0x04, 0x01, 0x01, 0x80, 0xc5, 0x2a, 0x18, 0x5d, 0x00, 0x00, 0x00,
                                  0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

SimulatorOptions on_cpu() {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    return options;
}

// What is made of a shape and read from files: a surface with a texture, tets of two parts, and a collider.
class RecordedMeshesTest : public testing::Test {
protected:
    RecordedMeshesTest() {
        fs::create_directory(meshes());
        write_file(meshes() / "paint.mtl", "newmtl paint\nKd 1 0.5 0\nmap_Kd paint.png\n");
        write_file(meshes() / "paint.png", std::string(std::begin(kPng), std::end(kPng)));
        const SurfaceMesh sphere = make_sphere({0.3, 4});
        std::string obj = "mtllib paint.mtl\nusemtl paint\n";
        const auto line = [](const char* kind, double a, double b, double c) {
            return std::string(kind) + ' ' + std::to_string(a) + ' ' + std::to_string(b) + ' ' +
                   std::to_string(c) + '\n';
        };
        for (const glm::dvec3& p : sphere.positions)
            obj += line("v", p.x, p.y, p.z) + line("vt", p.x, p.y, 0);
        for (const glm::uvec3& face : sphere.faces) {
            obj += "f";
            for (int k = 0; k < 3; ++k)
                obj += ' ' + std::to_string(face[k] + 1) + '/' + std::to_string(face[k] + 1);
            obj += '\n';
        }
        write_file(meshes() / "ball.obj", obj);
        write_file(
            meshes() / "tets.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 1\n0.3 0 0 1\n0 0.3 0 1\n0 0 0.3 1\n"
            "0.3 0.3 0.3 1\nTetrahedra 2\n1 2 3 4 7\n2 3 4 5 8\nEnd\n");
        write_file(meshes() / "floor.obj", "v -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\nf 1 2 3 4\n");
    }

    fs::path meshes() const { return folder_.path() / "meshes"; }
    fs::path recorded() const { return folder_.path() / "run.gel"; }

    Scene scene() const {
        Scene scene = test::falling_balls();
        scene.simulation.solver = SolverKind::implicit;
        scene.simulation.frame_rate = 60.0;
        scene.objects[0].shape = FileShape{meshes() / "ball.obj"};
        scene.objects[0].mesher.nodes = 60;
        ObjectDescription tets = scene.objects[1];
        tets.name = "tets";
        tets.shape = FileShape{meshes() / "tets.mesh"};
        tets.position = {1.0, 0.3, 0.0};
        tets.parts = {{TetAttribute{8}, scene.materials[0].name}};
        scene.objects.push_back(tets);
        ColliderDescription floor;
        floor.shape = FileShape{meshes() / "floor.obj"};
        scene.colliders = {floor};
        return scene;
    }

    struct Run {
        HostFrame last, resumed;  // the last one again, as a run that goes on from the second frame has it
    };

    static HostFrame resume(const Scene& scene, const fs::path& file, int last) {
        Simulator simulator(scene, on_cpu());
        simulator.load_checkpoint(file, 2);
        while (simulator.frame() < last) simulator.advance_frame();
        return simulator.read_frame();
    }

    // So many frames.
    Run record(const Scene& scene, int frames) const {
        Simulator simulator(scene, on_cpu());
        RecordingWriter writer(recorded(), simulator);
        writer.write(simulator);
        for (int k = 0; k < frames; ++k) {
            simulator.advance_frame();
            writer.write(simulator);
        }
        writer.finish();
        return {simulator.read_frame(), resume(scene, recorded(), frames)};
    }

    // As somebody has it who was sent the recording, and nothing else.
    std::shared_ptr<const Recording> sent() const {
        fs::remove_all(meshes());
        fs::create_directory(folder_.path() / "elsewhere");
        fs::rename(recorded(), folder_.path() / "elsewhere" / "run.gel");
        return std::make_shared<const Recording>(folder_.path() / "elsewhere" / "run.gel");
    }

    static void expect_same(const HostFrame& frame, const HostFrame& expected) {
        EXPECT_EQ(frame.frame, expected.frame);
        EXPECT_EQ(frame.positions, expected.positions);
        EXPECT_EQ(frame.velocities, expected.velocities);
    }

    // It is played, and goes on from a frame.
    static void expect_whole(const std::shared_ptr<const Recording>& recording, const Run& run) {
        Simulator player(recording, on_cpu());
        player.show_recorded(recording->frame_count() - 1);
        expect_same(player.read_frame(), run.last);
        expect_same(resume(recording->scene(), recording->file(), run.last.frame), run.resumed);
    }

    TemporaryFolder folder_;
};

TEST_F(RecordedMeshesTest, NoFileOfTheSceneIsNeeded) {
    const Run run = record(scene(), 6);
    const Model before = build_model(scene());
    const auto recording = sent();
    expect_whole(recording, run);
    const Model model = build_model(recording->scene());
    ASSERT_EQ(model.skin.points.size(), before.skin.points.size());
    for (std::size_t p = 0; p < model.skin.points.size(); ++p)
        EXPECT_EQ(model.skin.points[p].weights, before.skin.points[p].weights);
    EXPECT_EQ(model.skin.look.corner_uvs, before.skin.look.corner_uvs);
    ASSERT_EQ(model.skin.look.materials.size(), 1u);
    const SurfaceMaterial& paint = model.skin.look.materials[0];
    EXPECT_EQ(paint.name, "paint");
    EXPECT_EQ(paint.color, before.skin.look.materials[0].color);
    ASSERT_NE(paint.image, nullptr);
    EXPECT_EQ(*paint.image, *before.skin.look.materials[0].image);
}

TEST_F(RecordedMeshesTest, RigidBodiesAreRecorded) {
    Scene scene = this->scene();
    scene.objects[1].shape = scene.objects[0].shape;
    scene.objects[1].rigid.emplace();
    ObjectDescription slab = scene.objects[1];
    slab.name = "slab";
    slab.shape = FileShape{meshes() / "slab.stl"};
    slab.position = {-1.0, 0.3, 0.0};
    write_surface(meshes() / "slab.stl", make_box({{0.4, 0.2, 0.3}, glm::ivec3(1)}));
    scene.objects.push_back(slab);
    const Run run = record(scene, 6);
    const Model before = build_model(scene);
    const auto recording = sent();
    expect_whole(recording, run);
    const Model model = build_model(recording->scene());
    EXPECT_EQ(model.positions, before.positions);
    EXPECT_EQ(model.skin.look.materials.size(), before.skin.look.materials.size());
    EXPECT_TRUE(model.objects[1].is_rigid);
    EXPECT_EQ(model.meshes->all.size(), 5u);  // of the first shape its tets, and its surface
}

// Not even TetGen is.
TEST_F(RecordedMeshesTest, NothingIsMeshedAgain) {
    record(scene(), 2);
    const Scene found = sent()->scene();
    const Model model = build_model(found);
    ASSERT_EQ(model.meshes->all.size(), 4u);  // those of three objects and of a collider
    for (const auto& mesh : model.meshes->all)
        EXPECT_NE(std::find(found.meshes->all.begin(), found.meshes->all.end(), mesh),
                  found.meshes->all.end());
}

TEST_F(RecordedMeshesTest, TheSceneCanBeChanged) {
    record(scene(), 2);
    const Scene found = sent()->scene();
    const Scene finer = override_scene(found, {"object.0.mesher.nodes=150", "simulation.frames=7"});
    EXPECT_EQ(finer.simulation.frames, 7);
    const Model model = build_model(finer);
    EXPECT_GT(model.objects[0].nodes.count, build_model(found).objects[0].nodes.count);
    EXPECT_FALSE(model.skin.look.is_empty());
}

TEST_F(RecordedMeshesTest, MeshesInMemoryAreRecorded) {
    const SurfaceMesh sphere = make_sphere({0.3, 4});
    Mesh ball{sphere.positions, sphere.faces, {}, {}};
    ball.vertices[0] *= 1.0 + 1e-15;  // to the last bit
    Scene scene = this->scene();
    scene.objects[0].shape = MeshShape{std::make_shared<const Mesh>(ball)};
    scene.objects[1].shape = scene.objects[0].shape;
    scene.objects[1].mesher = scene.objects[0].mesher;
    scene.objects[2].shape = MeshShape{
        std::make_shared<const Mesh>(Mesh{{{0, 0, 0}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, {0.3, 0.3, 0.3}},
                                          {},
                                          {{0, 1, 2, 3}, {1, 3, 2, 4}},
                                          {7, 8}})};
    scene.colliders[0].shape = MeshShape{std::make_shared<const Mesh>(
        Mesh{{{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}})};
    const Run run = record(scene, 6);
    const auto recording = sent();
    expect_whole(recording, run);
    const Scene& found = recording->scene();
    const Mesh& read = *std::get<MeshShape>(found.objects[0].shape).mesh;
    EXPECT_EQ(read.vertices, ball.vertices);
    EXPECT_EQ(read.triangles, ball.triangles);
    EXPECT_EQ(found.objects[1].shape, found.objects[0].shape) << "it is one mesh still";
    EXPECT_EQ(std::get<MeshShape>(found.objects[2].shape).mesh->attributes, (std::vector<int>{7, 8}));
    const Scene changed = override_scene(found, {"simulation.frames=7"});
    EXPECT_EQ(changed.objects[0].shape, found.objects[0].shape);
}

// A recording of what a recording plays, and of a run of its scene.
TEST_F(RecordedMeshesTest, WhatIsPlayedCanBeRecorded) {
    record(scene(), 3);
    const auto first = sent();
    const Run run = record(first->scene(), 6);
    const auto second = std::make_shared<const Recording>(recorded());
    expect_whole(second, run);
}

TEST_F(RecordedMeshesTest, DamageIsFound) {
    record(scene(), 2);
    const std::string whole = read_file(recorded());
    const auto expect_refused = [&](const std::string& bytes, const std::string& problem) {
        write_file(recorded(), bytes);
        try {
            Recording recording(recorded());
            ADD_FAILURE() << "it was not refused";
        } catch (const InvalidInput& error) {
            EXPECT_THAT(error.what(), HasSubstr(problem));
            EXPECT_THAT(error.what(), HasSubstr("run.gel"));
        }
    };
    std::string damaged = whole;
    damaged[whole.find("\x28\xB5\x2F\xFD") + 100] ^= 1;  // in the first zstd frame
    expect_refused(damaged, "is damaged: its checksum does not match");
    damaged = whole;
    damaged[8] = 1;  // the version
    expect_refused(damaged, "was written by another version of Gelatin: its format is 1, not 4");
    expect_refused(whole.substr(0, whole.find("\x28\xB5\x2F\xFD") + 100),
                   "is cut off before its first frame");
}

// A checksum protects from accidents alone.
TEST_F(RecordedMeshesTest, MeshesThatCannotBeAreRefused) {
    const Scene scene = this->scene();
    const Model model = build_model(scene);
    const RecordedScene right = recorded_scene(scene, model.meshes.get());
    EXPECT_EQ(restored_scene(right).meshes->all.size(), 4u);
    const std::string bytes = decompressed(right.meshes, 1 << 30);
    const auto refused = [&](const std::string& wrong) {
        RecordedScene recorded = right;
        recorded.meshes = wrong;
        EXPECT_THROW(restored_scene(recorded), InvalidInput);
    };
    refused("");
    refused(right.meshes.substr(0, right.meshes.size() - 1));
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1})
        refused(compressed(bytes.substr(0, size), 1));
    refused(compressed(bytes + "more", 1));
    auto torn = std::make_shared<ShapeMesh>(*model.meshes->all.back());
    torn->tets.tets[0].x = 4711;
    const SceneMeshes wrong{{torn}};
    EXPECT_THROW(restored_scene(recorded_scene(scene, &wrong)), InvalidInput);
}

}  // namespace
}  // namespace gelatin
