// Colliders whose vertices move, outside the solver: what is saved, continued, written and refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "mesh/shapes.h"
#include "model/scene/override_scene.h"
#include "sim/recording/recorded_meshes.h"
#include "sim/simulator_internals.h"
#include "support/gltf_maker.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using ::testing::HasSubstr;
using Vertices = std::vector<glm::dvec3>;

constexpr double kFrame = 1.0 / 60.0;

// A ball on a plate that is a mesh in memory.
class AnimatedColliders : public testing::Test {
protected:
    AnimatedColliders() {
        scene.materials.resize(1);
        scene.materials[0].name = "jelly";
        ObjectDescription& ball = scene.objects.emplace_back();
        ball.name = "ball";
        ball.material = "jelly";
        ball.shape = SphereShape{0.2, 3};
        ball.position.y = 0.305;
        const SurfaceMesh box = make_box({{1.0, 0.2, 1.0}, {1, 1, 1}});
        Mesh mesh;
        mesh.vertices = box.positions;
        mesh.triangles = box.faces;
        plate_vertices = mesh.vertices;
        ColliderDescription& plate = scene.colliders.emplace_back();
        plate.name = "plate";
        plate.shape = MeshShape{std::make_shared<const Mesh>(mesh)};
        plate.animation = AnimationDescription{AnimationByProgram()};
    }

    // The plate tips over and rises.
    Vertices vertices_at(double time) const {
        Vertices vertices = plate_vertices;
        for (glm::dvec3& p : vertices) p.y += 0.2 * time + 0.1 * std::sin(6.0 * time) * p.x;
        return vertices;
    }
    void advance(Simulator& simulator, int frames) const {
        for (int f = 0; f < frames; ++f) {
            simulator.set_collider_vertices("plate", vertices_at(simulator.time() + kFrame));
            simulator.advance_frame();
        }
    }
    static SimulatorOptions on_cpu() {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        return options;
    }

    Scene scene;
    Vertices plate_vertices;
};

TEST_F(AnimatedColliders, CheckpointsHaveWhereProgramsMoveThem) {
    const TemporaryFolder folder;
    Simulator first(scene, on_cpu());
    advance(first, 20);
    first.save_checkpoint(folder.path() / "a.gelck");
    advance(first, 5);
    for (int f = 0; f < 5; ++f) first.advance_frame();  // it stays where it is
    Simulator second(scene, on_cpu());
    second.load_checkpoint(folder.path() / "a.gelck", {});
    advance(second, 5);
    for (int f = 0; f < 5; ++f) second.advance_frame();
    EXPECT_EQ(first.read_frame().positions, second.read_frame().positions);
    // As long as a movement lasts, too.
    first.set_collider_vertices("plate", vertices_at(1.0));
    first.save_checkpoint(folder.path() / "b.gelck");
    first.advance_frame();
    Simulator third(scene, on_cpu());
    third.load_checkpoint(folder.path() / "b.gelck", {});
    third.advance_frame();
    EXPECT_EQ(first.read_frame().positions, third.read_frame().positions);
}

TEST_F(AnimatedColliders, RecordingsHaveWhereProgramsMoveThem) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "run.gel";
    Simulator run(scene, on_cpu());
    RecordingWriter writer(file, run);
    std::vector<std::vector<float>> positions;
    for (int f = 0; f < 40; ++f) {  // over two key frames
        if (f < 36) run.set_collider_vertices("plate", vertices_at(run.time() + kFrame));
        writer.write(run);
        positions.push_back(run.read_frame().positions);
        run.advance_frame();
    }
    writer.finish();
    const Range& plate = model_of(run).objects.back().nodes;
    const auto expect_plate = [&](const Simulator& simulator, const Vertices& vertices) {
        for (std::uint32_t n = 0; n < plate.count; ++n) {
            const glm::vec3 found(simulator.positions()[plate.first + n]);
            EXPECT_TRUE(std::any_of(vertices.begin(), vertices.end(), [&](const glm::dvec3& p) {
                return glm::distance(found, glm::vec3(p)) < 1e-5f;
            }));
        }
    };
    Simulator player(std::make_shared<const Recording>(file), on_cpu());
    for (const std::size_t k : {5u, 39u, 20u}) {
        player.show_recorded(k);
        EXPECT_EQ(player.read_frame().positions, positions[k]);
        expect_plate(player, vertices_at(kFrame * static_cast<double>(std::min<std::size_t>(k, 36))));
    }
    // What goes on from frame 20 ends the movement that was set there, and stays.
    Simulator later(scene, on_cpu()), other(scene, on_cpu());
    later.load_checkpoint(file, 20);
    other.go_on_from(player);
    for (Simulator* each : {&later, &other})
        for (int f = 0; f < 2; ++f) {
            each->advance_frame();
            expect_plate(*each, vertices_at(21.0 * kFrame));
        }
}

TEST_F(AnimatedColliders, ResetPutsThemBack) {
    Simulator simulator(scene, on_cpu());
    advance(simulator, 10);
    const std::vector<float> positions = simulator.read_frame().positions;
    simulator.reset();
    advance(simulator, 10);
    EXPECT_EQ(simulator.read_frame().positions, positions);
    simulator.reset();
    for (int f = 0; f < 10; ++f) simulator.advance_frame();
    EXPECT_NE(simulator.read_frame().positions, positions);
}

TEST_F(AnimatedColliders, GoOnWhenTablesAreMadeAnew) {
    Simulator plain(scene, on_cpu()), pinned(scene, on_cpu());
    const std::vector<std::uint32_t> nodes = {0, 1};
    for (Simulator* simulator : {&plain, &pinned}) advance(*simulator, 10);
    pinned.pin(0, nodes);  // then the plate waits for it
    for (Simulator* simulator : {&plain, &pinned}) advance(*simulator, 10);
    const Range& plate = model_of(plain).objects.back().nodes;
    for (std::uint32_t n = plate.first; n < plate.end(); ++n)
        EXPECT_LT(glm::distance(plain.positions()[n], pinned.positions()[n]), 0.02f);
}

TEST_F(AnimatedColliders, RefuseWhatDoesNotFit) {
    Simulator simulator(scene, on_cpu());
    const auto refusal_of = [&](const std::string& name, const Vertices& vertices) {
        try {
            simulator.set_collider_vertices(name, vertices);
        } catch (const InvalidInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal_of("plat", plate_vertices), "there is no collider 'plat' that a program moves");
    EXPECT_EQ(refusal_of("plate", Vertices(7)), "collider 'plate': 7 vertices: its shape has 8");
    Vertices lost = plate_vertices;
    lost[3].y = NAN;
    EXPECT_THAT(refusal_of("plate", lost), HasSubstr("vertices[3] = ["));
}

TEST_F(AnimatedColliders, FramesInMemoryAreRecordedAndOverridden) {
    auto frames = std::make_shared<std::vector<Vertices>>();
    for (int f = 0; f < 4; ++f) frames->push_back(vertices_at(f * kFrame));
    scene.colliders[0].animation = AnimationDescription{AnimationFrames{frames, 60.0}, 0.5};
    const auto frames_of = [](const Scene& of) {
        const AnimationDescription& animation = *of.colliders[0].animation;
        EXPECT_EQ(animation.start, 0.5);
        return std::get<AnimationFrames>(animation.source);
    };
    const Scene changed = override_scene(scene, {"collider.0.friction=0.9"});
    EXPECT_EQ(frames_of(changed).frames, frames);
    EXPECT_EQ(changed.colliders[0].friction, 0.9);
    const Scene restored = restored_scene(recorded_scene(scene, nullptr));
    EXPECT_EQ(*frames_of(restored).frames, *frames);
    EXPECT_EQ(frames_of(restored).rate, 60.0);
}

TEST_F(AnimatedColliders, ErrorsOfFilesNameTheCollider) {
    const TemporaryFolder folder;
    test::bending_bar().write(folder.path() / "bar.glb");
    scene.colliders[0].shape = FileShape{folder.path() / "bar.glb"};
    scene.colliders[0].animation = AnimationDescription{AnimationClip{"jump"}};
    try {
        Simulator simulator(scene, on_cpu());
        ADD_FAILURE() << "was not refused";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("plate.animation = "), HasSubstr("bar.glb"),
                                                 HasSubstr("jump: is not there: it has 'bend'")));
    }
}

// The viewer's way from one scene to the next: a skeleton that is new holds nodes where its bones are then.
TEST_F(AnimatedColliders, SkeletonsThatAreNewBeginWhereTheirBonesAre) {
    const TemporaryFolder folder;
    test::bending_bar().write(folder.path() / "bar.glb");
    scene.colliders.clear();
    scene.objects[0].shape = BoxShape{{0.3, 2.4, 0.3}, {2, 12, 2}};
    Simulator without(scene, on_cpu());
    for (int f = 0; f < 30; ++f) without.advance_frame();
    HandleDescription handle;
    handle.skeleton = SkeletonDescription{folder.path() / "bar.glb", 0.1};
    scene.objects[0].handles = {handle};
    Simulator with(scene, on_cpu()), alone(scene, on_cpu());
    with.go_on_from(without);
    for (int f = 0; f < 30; ++f) with.advance_frame();
    for (int f = 0; f < 60; ++f) alone.advance_frame();
    ASSERT_FALSE(model_of(with).handle_nodes.empty());
    for (const HandleNode& held : model_of(with).handle_nodes)
        EXPECT_LT(glm::distance(with.positions()[held.node], alone.positions()[held.node]), 1e-4f);
}

TEST_F(AnimatedColliders, ErrorsOfSkeletonsNameTheHandle) {
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml",
               "[[material]]\nname = 'm'\n[[object]]\nname = 'b'\nshape = {sphere = 1}\n[[object.handle]]\n"
               "skeleton = {file = 'gone.glb', radius = 1}\n");
    try {
        Simulator simulator(load_scene(folder.path() / "scene.toml"), on_cpu());
        ADD_FAILURE() << "was not refused";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("scene.toml:6: object.b.handle[0].skeleton = "),
                                                 HasSubstr("gone.glb: no such file")));
    }
}

}  // namespace
}  // namespace gelatin
