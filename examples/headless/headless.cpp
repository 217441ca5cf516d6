// Simulates on the processor, without OpenGL: a mesh in memory falls, is pushed, and its state is read.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "gelatin/error.h"
#include "gelatin/scene.h"
#include "gelatin/simulator.h"
#include "gelatin/version.h"

namespace {

// An octahedron of 1 m from corner to corner; any closed surface will do.
std::shared_ptr<const gelatin::Mesh> make_octahedron() {
    gelatin::Mesh mesh;
    mesh.vertices = {{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return std::make_shared<const gelatin::Mesh>(std::move(mesh));
}

gelatin::Scene make_scene() {
    gelatin::Scene scene;
    gelatin::Material jelly;
    jelly.name = "jelly";
    jelly.youngs_modulus = 5e4;  // [Pa]
    scene.materials.push_back(jelly);

    gelatin::ObjectDescription body;
    body.name = "body";
    body.shape = gelatin::MeshShape{make_octahedron()};
    body.mesher.nodes = 300;
    body.material = jelly.name;
    body.position = {0.0, 1.0, 0.0};  // [m]
    scene.objects.push_back(body);

    gelatin::ColliderDescription floor;
    floor.shape = gelatin::PlaneCollider{};  // y = 0
    scene.colliders.push_back(floor);
    return scene;
}

}  // namespace

int main() {
    try {
        gelatin::SimulatorOptions options;
        options.backend = gelatin::Backend::cpu;
        gelatin::Simulator simulator(make_scene(), options);
        std::printf("gelatin %s on %s\n", gelatin::version(), simulator.device().c_str());

        const std::size_t body = simulator.object_index("body");
        const gelatin::IndexRange nodes = simulator.object(body).nodes;
        for (int frame = 0; frame < 120; ++frame) {
            if (frame == 60) {  // a push to the right, of 2 m/s
                std::vector<glm::vec3> velocities(nodes.count, glm::vec3(2.0f, 0.0f, 0.0f));
                simulator.set_velocities(body, velocities);
            }
            simulator.advance_frame();
        }
        glm::vec3 center(0.0f);  // of the nodes, straight from the solver's memory
        for (const glm::vec4& position : simulator.positions().subspan(nodes.first, nodes.count))
            center += glm::vec3(position) / static_cast<float>(nodes.count);
        std::printf("after %.2f s its centre is at %.2f %.2f %.2f m\n", simulator.time(), center.x, center.y,
                    center.z);
        for (const gelatin::ContactForce& force : simulator.contact_forces())
            std::printf("the floor presses it with %.0f N\n", force.normal[1]);
    } catch (const gelatin::Error& error) {
        std::fprintf(stderr, "headless: %s\n", error.what());
        return 1;
    }
}
