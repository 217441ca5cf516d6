#include "picture/shown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "model/scene/parse_scene.h"
#include "picture/surroundings.h"
#include "render/up_axis.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

constexpr float kAspect = 16.0f / 9.0f;

Simulator simulate(const std::string& text) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    return Simulator(parse_scene("[[material]]\nname = 'jelly'\n" + text, "scene.toml"), options);
}

std::string ball(const std::string& position, const std::string& more = "") {
    return "[[object]]\nname = 'ball " + position +
           "'\nshape = { sphere = 0.1, frequency = 3 }\nposition = " + position + "\n" + more + "\n";
}

std::string collider(const std::string& shape, const std::string& more = "") {
    return "[[collider]]\nshape = { " + shape + " }\n" + more + "\n";
}

/// Where things are in a picture: from -1 to 1 from its left to its right, and from below to above.
class Projection {
public:
    Projection(const Simulator& simulator, const render::Camera& camera)
        : up_(simulator.scene().up), camera_(render::to_y_up(camera, up_)) {}

    glm::vec2 operator()(const glm::vec3& point) const {
        const glm::vec4 clip =
            camera_.projection(kAspect) * camera_.view() * glm::vec4(render::to_y_up(point, up_), 1.0f);
        EXPECT_GT(clip.w, 0.0f);
        EXPECT_LT(std::abs(clip.z), clip.w) << "between the near and the far plane";
        return glm::vec2(clip) / clip.w;
    }

private:
    Axis up_;
    render::Camera camera_;
};

struct Rectangle {
    glm::vec2 low{HUGE_VALF}, high{-HUGE_VALF};
    void add(const glm::vec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool is_in_picture() const { return low.x > -1 && low.y > -1 && high.x < 1 && high.y < 1; }
    float height() const { return 0.5f * (high.y - low.y); }  // of the picture's
};

// Of all nodes of bodies.
Rectangle bodies_in(const Simulator& simulator, const render::Camera& camera) {
    const Projection project(simulator, camera);
    Rectangle all;
    for (std::uint32_t n = 0; n < model_of(simulator).body_node_count(); ++n)
        all.add(project(glm::vec3(simulator.positions()[n])));
    return all;
}

bool shows(const Simulator& simulator, const render::Camera& camera, const glm::vec3& point) {
    const glm::vec2 at = Projection(simulator, camera)(point);
    return std::abs(at.x) < 1 && std::abs(at.y) < 1;
}

// The floor is whatever is there.
TEST(ShownTest, HasABodyInThePictureAndWhatItFallsOn) {
    const std::string floors[] = {
        collider("plane = [0, 1, 0]"),
        collider("box = [4, 0.001, 4]"),
        collider("box = [400, 2, 400]", "position = [100, -1, 0]"),
        collider("sphere = 3", "position = [0, -3, 0]"),
        collider("capsule = 0.5, length = 9", "position = [0, -0.5, 0]\nrotation = [0, 0, 90]"),
        collider("box = [9, 0.1, 2]", "position = [0, -0.05, 0]\nsurface_velocity = [1, 0, 0]"),
        collider("plane = [0.3, 1, 0]"),
        "[collision]\nresponse = 'restore'\n" + collider("box = [4, 0.02, 4]", "position = [0, -0.01, 0]"),
    };
    for (const std::string& floor : floors) {
        const Simulator simulator = simulate(ball("[0, 1.5, 0]") + floor);
        const render::Camera camera = Shown(simulator).camera(kAspect);
        const Rectangle body = bodies_in(simulator, camera);
        EXPECT_TRUE(body.is_in_picture()) << floor;
        EXPECT_GT(body.height(), 0.05f) << floor;
        EXPECT_TRUE(shows(simulator, camera, {0, 0, 0})) << floor;
    }
}

TEST(ShownTest, HasSmallCollidersBesideBodiesWhollyInThePicture) {
    const std::string alone = ball("[0, 0.11, 0]") + collider("plane = [0, 1, 0]");
    const Simulator simulator =
        simulate(alone + collider("box = [0.3, 0.3, 0.3]", "position = [0.26, 0.15, 0]"));
    const glm::vec3 corner(0.41f, 0.3f, -0.15f);
    EXPECT_TRUE(shows(simulator, Shown(simulator).camera(kAspect), corner));
    const Simulator without = simulate(alone);
    EXPECT_FALSE(shows(without, Shown(without).camera(kAspect), corner));
}

// Everything that is shown is as large as the scene.
TEST(ShownTest, TakesScenesOfAnySize) {
    for (const std::string scale : {"0.001", "1", "1000"}) {
        const Simulator simulator =
            simulate("[[object]]\nname = 'ball'\nshape = { sphere = 1, frequency = 3 }\nscale = " + scale +
                     "\nposition = [0, " + scale + ", 0]\n" + collider("plane = [0, 1, 0]"));
        const Rectangle body = bodies_in(simulator, Shown(simulator).camera(kAspect));
        EXPECT_TRUE(body.is_in_picture()) << scale;
        EXPECT_GT(body.height(), 0.6f) << scale;
    }
}

TEST(ShownTest, FollowsBodiesThroughAFilm) {
    const std::string scenes[] = {
        ball("[0, 1.5, 0]", "velocity = [6, 2, 0]") + collider("plane = [0, 1, 0]"),
        ball("[0, 1, 0]") + collider("box = [3, 0.1, 3]", "rotation = [0, 0, -30]") +
            collider("box = [20, 1, 20]", "position = [0, -2, 0]"),
        ball("[0, 0.11, 0]") + ball("[0.5, 0.9, 0.2]") + collider("plane = [0, 1, 0]") +
            collider("box = [0.4, 0.1, 0.4]",
                     "position = [0, 1, 0]\nkeyframes = [{time = 0}, {time = 1, move = [0, -0.7, 0]}]"),
    };
    for (const std::string& scene : scenes) {
        Simulator simulator = simulate(scene);
        Shown shown(simulator);
        for (int f = 0; f < 60; ++f) {
            simulator.advance_frame();
            shown.add();
        }
        const render::Camera camera = shown.camera(kAspect);
        simulator.reset();
        for (int f = 0; f <= 60; ++f) {
            EXPECT_TRUE(bodies_in(simulator, camera).is_in_picture()) << "frame " << f << " of " << scene;
            simulator.advance_frame();
        }
    }
}

// Off the edge of a table, under which there is nothing.
TEST(ShownTest, DoesNotFollowWhatFallsForEver) {
    Simulator simulator = simulate(ball("[-0.3, 0.11, 0]") + ball("[0.4, 0.11, 0]", "velocity = [2, 0, 0]") +
                                   collider("box = [1, 0.02, 1]", "position = [0, -0.01, 0]"));
    Shown shown(simulator);
    const render::Camera start = shown.camera(kAspect);
    EXPECT_TRUE(bodies_in(simulator, start).is_in_picture());
    for (int f = 0; f < 120; ++f) {
        simulator.advance_frame();
        shown.add();
    }
    const render::Camera camera = shown.camera(kAspect);
    EXPECT_FALSE(bodies_in(simulator, camera).is_in_picture());
    EXPECT_TRUE(shows(simulator, camera, {-0.3f, 0.11f, 0.0f}));
    EXPECT_TRUE(shows(simulator, camera, {0.6f, -0.3f, 0.0f})) << "its fall begins in the picture";
    EXPECT_LT(glm::distance(camera.eye, camera.target), 5 * glm::distance(start.eye, start.target));
}

// Whether a straight line from the eye to the point meets a box that a scene has at `center`.
bool is_hidden(const render::Camera& camera, const glm::vec3& point, const glm::vec3& center,
               const glm::vec3& size) {
    for (int k = 0; k <= 1000; ++k) {
        const glm::vec3 at = glm::mix(point, camera.eye, 0.001f * static_cast<float>(k));
        if (glm::all(glm::lessThan(glm::abs(at - center), 0.5f * size))) return true;
    }
    return false;
}

TEST(ShownTest, LooksPastWallsAndIntoRooms) {
    const glm::vec3 wall(4.0f, 4.0f, 0.1f), in_front(0.0f, 1.0f, 0.5f);
    const Simulator behind = simulate(ball("[0, 0.1, 0]") + collider("plane = [0, 1, 0]") +
                                      collider("box = [4, 4, 0.1]", "position = [0, 1, 0.5]"));
    const render::Camera past = Shown(behind).camera(kAspect);
    EXPECT_FALSE(is_hidden(past, {0.0f, 0.1f, 0.0f}, in_front, wall));
    EXPECT_TRUE(bodies_in(behind, past).is_in_picture());

    std::string room = ball("[0, 0.11, 0]");
    for (const char* place :
         {"box = [2, 0.1, 2]|[0, -0.05, 0]", "box = [2, 0.1, 2]|[0, 1.55, 0]",
          "box = [0.1, 1.5, 2]|[1.05, 0.75, 0]", "box = [0.1, 1.5, 2]|[-1.05, 0.75, 0]",
          "box = [2, 1.5, 0.1]|[0, 0.75, 1.05]", "box = [2, 1.5, 0.1]|[0, 0.75, -1.05]"}) {
        const std::string text = place;
        const std::size_t bar = text.find('|');
        room += collider(text.substr(0, bar), "position = " + text.substr(bar + 1));
    }
    const Simulator inside = simulate(room);
    const render::Camera within = Shown(inside).camera(kAspect);
    EXPECT_LT(glm::abs(within.eye.x), 1.1f);
    EXPECT_LT(glm::abs(within.eye.z), 1.1f);
    EXPECT_LT(within.eye.y, 1.6f);
    EXPECT_TRUE(bodies_in(inside, within).is_in_picture());
}

TEST(ShownTest, LooksIntoAClosedBoxFromOutside) {
    const Simulator simulator =
        simulate(ball("[0.05, 0.11, 0]") + collider("box = [0.4, 0.4, 0.4]", "position = [0, 0.2, 0]"));
    const render::Camera camera = Shown(simulator).camera(kAspect);
    EXPECT_TRUE(bodies_in(simulator, camera).is_in_picture());
    for (const float x : {-0.2f, 0.2f})
        for (const float y : {0.0f, 0.4f})
            for (const float z : {-0.2f, 0.2f}) EXPECT_TRUE(shows(simulator, camera, {x, y, z}));
}

TEST(ShownTest, HasTheScenesOwnCamera) {
    const Simulator simulator =
        simulate(ball("[0, 1, 0]") + "[camera]\neye = [1, 2, 3]\ntarget = [4, 5, 6]\n");
    const render::Camera camera = Shown(simulator).camera(kAspect);
    EXPECT_EQ(camera.eye, glm::vec3(1, 2, 3));
    EXPECT_EQ(camera.target, glm::vec3(4, 5, 6));
}

TEST(ShownTest, LooksAtASceneAlikeWhicheverAxisPointsUp) {
    const Simulator y = simulate(ball("[0.5, 1, -0.25]") + collider("plane = [0, 1, 0]") +
                                 collider("sphere = 0.3", "position = [0.2, 0.1, 0]"));
    const std::string turned = ball("[0.5, 0.25, 1]") + collider("plane = [0, 0, 1]") +
                               collider("sphere = 0.3", "position = [0.2, 0, 0.1]");
    SimulatorOptions options;
    options.backend = Backend::cpu;
    const Simulator z(parse_scene("up = 'z'\n[[material]]\nname = 'jelly'\n" + turned, "scene.toml"),
                      options);
    const render::Camera a = Shown(y).camera(kAspect), b = render::to_y_up(Shown(z).camera(kAspect), Axis::z);
    EXPECT_LT(glm::distance(a.eye, b.eye), 1e-5f);
    EXPECT_LT(glm::distance(a.target, b.target), 1e-5f);
}

}  // namespace
}  // namespace gelatin
