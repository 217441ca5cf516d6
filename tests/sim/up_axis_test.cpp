#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <string>

#include "gelatin/simulator.h"
#include "model/scene/parse_scene.h"

namespace gelatin {
namespace {

// A capsule and a text that fall onto a sphere, which moves, and a floor. %: coordinates in the scene's axes.
Scene scene_with(Axis up, const std::string& response) {
    const auto vector = [&](double x, double y, double z) {
        return up == Axis::y
                   ? "[" + std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + "]"
                   : "[" + std::to_string(x) + "," + std::to_string(-z) + "," + std::to_string(y) + "]";
    };
    std::string text = up == Axis::y ? "" : "up = 'z'\n";
    text +=
        "[simulation]\nsubsteps = 2\n[collision]\nresponse = '" + response +
        "'\n[[material]]\nname = 'jelly'\n"
        "[[object]]\nname = 'capsule'\nshape = { capsule = 0.2, length = 0.4, frequency = 3 }\nposition = " +
        vector(0, 1, 0.05) + "\nvelocity = " + vector(0.5, -1, 0.25) +
        "\n[[object]]\nname = 'text'\nshape = { text = 'T' }\nposition = " + vector(1, 0.3, 0) +
        "\nspin = " + vector(0, 90, 20) + "\n[[collider]]\nshape = { plane = " + vector(0, 1, 0) +
        " }\n[[collider]]\nshape = { capsule = 0.2, length = 0.3 }\nposition = " + vector(0.1, 0.1, 0) + "\n";
    if (response == "contact")
        text += "keyframes = [{time = 0}, {time = 1, move = " + vector(0.3, 0, 0) + "}]\n";
    return parse_scene(text, "scene.toml");
}

glm::dvec3 with_y_up(const glm::vec4& p, Axis up) {
    return up == Axis::y ? glm::dvec3(p) : glm::dvec3(p.x, p.z, -p.y);
}

// The largest distance between nodes of both, after some frames [m].
double difference(const std::string& response, int frames) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator y(scene_with(Axis::y, response), options), z(scene_with(Axis::z, response), options);
    double largest = 0.0;
    for (int f = 0; f < frames; ++f) {
        y.advance_frame();
        z.advance_frame();
    }
    const std::size_t end = y.object(1).nodes.end();  // nodes of colliders may have another order
    EXPECT_EQ(end, z.object(1).nodes.end());
    for (std::size_t n = 0; n < end; ++n)
        largest = std::max(largest, glm::distance(with_y_up(y.positions()[n], Axis::y),
                                                  with_y_up(z.positions()[n], Axis::z)));
    return largest;
}

// Rounding alone differs: of single precision, which contacts amplify. Nodes that are pushed off the tip of a
// capsule, where a start that is moved by 1e-7 m makes as much of a difference, amplify it most.
TEST(UpAxis, DoesNotChangeTheMotion) {
    for (const std::string response : {"contact", "restore"})
        EXPECT_LT(difference(response, 0), 1e-6) << response;
    EXPECT_LT(difference("contact", 20), 4e-3);
    EXPECT_LT(difference("restore", 7), 1e-6);  // until then
    EXPECT_LT(difference("restore", 20), 1e-2);
}

}  // namespace
}  // namespace gelatin
