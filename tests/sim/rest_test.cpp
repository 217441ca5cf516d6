// What a scene does wakes its bodies when they sleep (cpu/implicit/rest_watch.h).
#include <gtest/gtest.h>

#include <algorithm>

#include "gelatin/simulator.h"

namespace gelatin {
namespace {

constexpr int kAsleep = 470, kWake = 480;  // frames, of 1/60 s

// A box on the floor, and one that hangs by its top.
Scene boxes() {
    Scene scene;
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    scene.materials[0].youngs_modulus = 1e6;
    scene.materials[0].damping = 0.02;  // else what hangs vibrates for ever
    for (const double height : {0.26, 2.0}) {
        ObjectDescription box;
        box.name = height < 1.0 ? "lies" : "hangs";
        box.shape = BoxShape{.size = glm::dvec3(0.5), .segments = glm::ivec3(2)};
        box.material = "jelly";
        box.position = {2.0 * height, height, 0.0};
        scene.objects.push_back(box);
    }
    HandleDescription top;
    top.region = HalfSpaceRegion{{0.0, -1.0, 0.0}, -2.2};
    scene.objects[1].handles.push_back(top);
    scene.colliders.push_back({});
    return scene;
}

class Resting {
public:
    explicit Resting(const Scene& scene) : simulator_(scene, on_cpu()) {}

    void expect_asleep_at(int frame) {
        while (simulator_.frame() < frame) simulator_.advance_frame();
        const HostFrame now = simulator_.read_frame();
        EXPECT_TRUE(
            std::all_of(now.velocities.begin(), now.velocities.end(), [](float v) { return v == 0.0f; }));
    }
    double height(std::size_t object) const {
        const auto nodes = simulator_.object(object).nodes;
        double sum = 0.0;
        for (std::size_t n = nodes.first; n < nodes.end(); ++n)
            sum += static_cast<double>(simulator_.positions()[n].y);
        return sum / static_cast<double>(nodes.count);
    }
    Simulator& simulator() { return simulator_; }

private:
    static SimulatorOptions on_cpu() {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        return options;
    }

    Simulator simulator_;
};

TEST(Rest, ALoadThatBeginsToActWakes) {
    Scene scene = boxes();
    LoadDescription lift{HalfSpaceRegion{{0.0, 1.0, 0.0}, 9.0}, ForceLoad{{0.0, 2.0 * 125.0 * 9.81, 0.0}}};
    lift.from = kWake / 60.0;
    scene.objects[0].loads.push_back(lift);
    Resting run(scene);
    run.expect_asleep_at(kAsleep);
    const double before = run.height(0);
    while (run.simulator().frame() < kWake + 30) run.simulator().advance_frame();
    EXPECT_NEAR(run.height(0), before + 0.5 * 9.81 * 0.25, 0.1);
}

TEST(Rest, AHandleThatLetsGoWakes) {
    Scene scene = boxes();
    scene.objects[1].handles[0].release = kWake / 60.0;
    Resting run(scene);
    run.expect_asleep_at(kAsleep);
    const double before = run.height(1);
    while (run.simulator().frame() < kWake + 30) run.simulator().advance_frame();
    EXPECT_NEAR(run.height(1), before - 0.5 * 9.81 * 0.25, 0.1);
}

TEST(Rest, WithoutSleepNothingSleeps) {
    Scene scene = boxes();
    scene.simulation.sleep = false;
    Resting run(scene);
    while (run.simulator().frame() < kAsleep) run.simulator().advance_frame();
    const HostFrame now = run.simulator().read_frame();
    EXPECT_TRUE(std::any_of(now.velocities.begin(), now.velocities.end(), [](float v) { return v != 0.0f; }));
}

}  // namespace
}  // namespace gelatin
