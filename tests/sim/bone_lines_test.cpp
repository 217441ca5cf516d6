#include "sim/bone_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "gelatin/simulator.h"
#include "sim/simulator_internals.h"
#include "support/gltf_maker.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

// A bar of four metres at x = 1 on the bones of bending_bar, twice as large; both rise by a metre a second.
class BoneLines : public test::SimulatorFixture {
protected:
    BoneLines() {
        test::bending_bar().write(folder.path() / "bar.glb");
        scene.simulation.gravity = glm::dvec3(0.0);
        scene.materials.emplace_back().name = "flesh";
        ObjectDescription& bar = scene.objects.emplace_back();
        bar.name = "bar";
        bar.material = "flesh";
        bar.shape = BoxShape{{0.2, 2.2, 0.2}, {2, 22, 2}};
        bar.scale = 2.0;
        bar.position = {1.0, 2.0, 0.0};
        HandleDescription bones;
        bones.skeleton = SkeletonDescription{folder.path() / "bar.glb", 0.35};
        bones.keyframes = {{.time = 0.0}, {.time = 1.0, .move = {0.0, 1.0, 0.0}}};
        bones.release = 0.9;
        bar.handles = {bones};
        HandleDescription plain;
        plain.region = SphereRegion{{1.2, 0.0, 0.2}, 0.1};
        bar.handles.push_back(plain);
    }

    static std::vector<OverlayLine> of_kind(const std::vector<OverlayLine>& lines, float kind) {
        std::vector<OverlayLine> found;
        for (const OverlayLine& line : lines)
            if (line.from.w == kind) found.push_back(line);
        return found;
    }
    static std::vector<OverlayLine> lines_of(const Simulator& simulator, std::size_t handle, double time) {
        const Model& model = model_of(simulator);
        return bone_lines(model, handle, pose_at(model.handles[handle], time), time, simulator.positions());
    }

    TemporaryFolder folder;
    Scene scene;
};

TEST_F(BoneLines, BonesAreWhereTheClipAndKeyframesHaveThem) {
    const Simulator simulator(scene, on(Backend::cpu));
    const auto expect_joints = [&](double time, const std::vector<glm::vec3>& joints) {
        const std::vector<OverlayLine> bones = of_kind(lines_of(simulator, 0, time), OverlayLine::kBone);
        for (const auto& [a, b] : {std::pair(0u, 1u), std::pair(1u, 2u)}) {
            EXPECT_TRUE(std::any_of(bones.begin(), bones.end(),
                                    [&, a = a, b = b](const OverlayLine& bone) {
                                        return glm::distance(glm::vec3(bone.from), joints[a]) < 1e-5f &&
                                               glm::distance(glm::vec3(bone.to), joints[b]) < 1e-5f;
                                    }))
                << "bone " << a << " at " << time << " s";
        }
        EXPECT_EQ(bones.size(), 3u) << "and the last joint, as a point";
    };
    // The object is placed at its centre, the skeleton at its foot.
    expect_joints(0.0, {{1, 2, 0}, {1, 4, 0}, {1, 6, 0}});
    const float s = std::sqrt(2.0f);
    expect_joints(0.5, {{1, 2.5, 0}, {1, 4.5, 0}, {1 - s, 4.5f + s, 0}});
}

TEST_F(BoneLines, NodesAreThoseThatTheSkeletonCarries) {
    Simulator simulator(scene, on(Backend::cpu));
    for (int k = 0; k < 10; ++k) simulator.advance_frame();
    const auto carried = of_kind(lines_of(simulator, 0, simulator.time()), OverlayLine::kCarried);
    const Model& model = model_of(simulator);
    std::size_t count = 0;
    for (const HandleNode& held : model.handle_nodes) {
        if (held.handle != 0) continue;
        const glm::vec3 place(simulator.positions()[held.node]);
        EXPECT_TRUE(std::any_of(carried.begin(), carried.end(),
                                [&](const OverlayLine& line) { return glm::vec3(line.from) == place; }));
        ++count;
    }
    EXPECT_EQ(carried.size(), count);
    EXPECT_GT(count, 10u);
    EXPECT_TRUE(lines_of(simulator, 1, 0.0).empty()) << "it has no bones";
}

TEST_F(BoneLines, AreDrawnUntilTheNodesAreReleased) {
    Simulator simulator(scene, on(Backend::cpu));
    EXPECT_EQ(simulator.render_view().overlay.line_count, 0u);
    const auto count = static_cast<std::uint32_t>(lines_of(simulator, 0, 0.0).size());
    EXPECT_EQ(simulator.render_view({.bones = true}).overlay.line_count, count);
    while (simulator.time() < 0.95) simulator.advance_frame();
    EXPECT_EQ(simulator.render_view({.bones = true}).overlay.line_count, 0u);
}

}  // namespace
}  // namespace gelatin
