#include "support/simulator_fixture.h"

#include <cmath>

namespace gelatin::test {

Scene falling_balls() {
    Scene scene;
    scene.simulation.solver = SolverKind::semi_implicit_euler;
    scene.simulation.frame_rate = 500.0;
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    scene.materials[0].damping = 5e-4;
    for (int i = 0; i < 2; ++i) {
        ObjectDescription ball;
        ball.name = "ball " + std::to_string(i);
        ball.shape = SphereShape{0.3, 4};
        ball.material = "jelly";
        ball.position = {i, 0.4, 0.0};
        scene.objects.push_back(ball);
    }
    scene.colliders.push_back({});
    return scene;
}

Scene driven_balls(SolverKind solver) {
    Scene scene = falling_balls();
    scene.simulation.solver = solver;
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, -0.1};
    handle.interpolation = Interpolation::smooth;
    handle.keyframes = {{0.003}, {0.05, {-0.02, 0.03, 0.0}, {30.0, 10.0, 0.0}, 1.1}};
    handle.release = 0.03;
    scene.objects[0].handles = {handle};
    LoadDescription push{HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.3}, ForceLoad{{0.0, 400.0, 100.0}}};
    push.from = 0.0101;
    push.until = 0.0507;
    scene.objects[1].loads = {push, {HalfSpaceRegion{{1.0, 0.0, 0.0}, 9.0}, PressureLoad{2e3}}};
    scene.objects[1].spin = {0.0, 200.0, 0.0};
    return scene;
}

double largest_difference(const HostFrame& a, const HostFrame& b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.positions.size(); ++k) {
        largest = std::max(
            largest, std::abs(static_cast<double>(a.positions[k]) - static_cast<double>(b.positions[k])));
    }
    return largest;
}

}  // namespace gelatin::test
