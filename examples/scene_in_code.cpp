// The C++ example of docs/tutorial.md: a scene made in code, whose node positions are read back.
#include <algorithm>
#include <cstdio>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"

int main() {
    gelatin::Scene scene;
    gelatin::Material jelly;
    jelly.name = "jelly";
    jelly.youngs_modulus = 1e5;  // [Pa]
    jelly.damping = 0.01;        // [s]
    scene.materials.push_back(jelly);

    gelatin::ObjectDescription ball;
    ball.name = "ball";
    ball.shape = gelatin::SphereShape{};  // of radius 0.5 m
    ball.material = jelly.name;
    ball.position = {0.0, 1.5, 0.0};  // [m]
    scene.objects.push_back(ball);

    gelatin::ColliderDescription floor;
    floor.shape = gelatin::PlaneCollider{};  // y = 0
    scene.colliders.push_back(floor);

    gelatin::Simulator simulator(scene);
    while (simulator.frame() < 120) {
        simulator.advance_frame();
        if (simulator.frame() % 20 != 0) continue;
        const gelatin::HostFrame now = simulator.read_frame();
        float lowest = now.positions[1], highest = lowest;  // y of the first node [m]
        for (std::size_t i = 1; i < now.positions.size(); i += 3) {
            lowest = std::min(lowest, now.positions[i]);
            highest = std::max(highest, now.positions[i]);
        }
        std::printf("%.2f s: from %5.2f m to %.2f m\n", now.time, lowest, highest);
    }
}
