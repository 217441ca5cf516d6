// What programs read and change between steps, on both backends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/log.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using test::largest_difference;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two boxes of 0.4 m, 1 m apart; nothing else.
Scene two_boxes(const glm::dvec3& gravity) {
    Scene scene;
    scene.simulation.gravity = gravity;
    Material& jelly = scene.materials.emplace_back();
    jelly.name = "jelly";
    jelly.damping = 0.02;
    for (const char* name : {"left", "right"}) {
        ObjectDescription& box = scene.objects.emplace_back();
        box.name = name;
        box.material = "jelly";
        box.shape = BoxShape{glm::dvec3(0.4), glm::ivec3(2)};
        box.position = {scene.objects.size() == 1 ? -0.5 : 0.5, 1.0, 0.0};
    }
    return scene;
}

std::vector<glm::vec3> places_of(const Simulator& simulator, std::size_t object) {
    const IndexRange nodes = simulator.object(object).nodes;
    const auto all = simulator.positions().subspan(nodes.first, nodes.count);
    return {all.begin(), all.end()};
}

glm::vec3 center_of(const Simulator& simulator, std::size_t object) {
    glm::vec3 sum(0.0f);
    const auto places = places_of(simulator, object);
    for (const glm::vec3& p : places) sum += p / static_cast<float>(places.size());
    return sum;
}

std::string message_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

class SimulatorStateTest : public test::SimulatorFixture, public ::testing::WithParamInterface<Backend> {
protected:
    Simulator make(const Scene& scene) { return Simulator(scene, on(GetParam())); }
    Simulator make_floating() { return make(two_boxes(glm::dvec3(0.0))); }
    static void advance(Simulator& simulator, int frames) {
        for (int f = 0; f < frames; ++f) simulator.advance_frame();
    }
};
INSTANTIATE_TEST_SUITE_P(Backends, SimulatorStateTest, ::testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& backend) { return backend.param == Backend::cpu ? "Cpu" : "Gl"; });

TEST_P(SimulatorStateTest, ObjectsAreFoundByNameWithWhatBelongsToThem) {
    const Simulator simulator = make_floating();
    EXPECT_EQ(simulator.object_index("left"), 0u);
    EXPECT_EQ(simulator.object_index("right"), 1u);
    EXPECT_EQ(message_of([&] { simulator.object_index("rihgt"); }),
              "there is no object 'rihgt' (did you mean \"right\"?); there are left and right");
    EXPECT_EQ(message_of([&] { simulator.object(2); }), "there is no object 2: there are 2, from 0");
    const Counts counts = simulator.counts();
    EXPECT_EQ(simulator.faces().size(), counts.faces);
    EXPECT_EQ(simulator.tets().size(), counts.tets);
    std::uint32_t nodes = 0, faces = 0, tets = 0;
    for (std::size_t o = 0; o < 2; ++o) {
        const ObjectInfo object = simulator.object(o);
        EXPECT_EQ(object.nodes.first, nodes);
        EXPECT_EQ(object.faces.first, faces);
        EXPECT_EQ(object.tets.first, tets);
        nodes = object.nodes.end(), faces = object.faces.end(), tets = object.tets.end();
        EXPECT_NEAR(object.rest_volume, 0.064, 1e-6);
        EXPECT_NEAR(object.mass, 64.0, 1e-3);
        double volume = 0.0;  // by the divergence theorem, which a face that is wound the wrong way spoils
        for (const glm::uvec3& face : simulator.faces().subspan(object.faces.first, object.faces.count)) {
            const auto p = [&](int k) { return glm::dvec3(simulator.positions()[face[k]]); };
            EXPECT_GE(face[0], object.nodes.first);
            EXPECT_LT(face[0], object.nodes.end());
            volume += glm::dot(p(0), glm::cross(p(1), p(2))) / 6.0;
        }
        EXPECT_NEAR(volume, 0.064, 1e-5);
        for (const glm::uvec4& tet : simulator.tets().subspan(object.tets.first, object.tets.count)) {
            EXPECT_GE(tet[3], object.nodes.first);
            EXPECT_LT(tet[3], object.nodes.end());
        }
    }
    EXPECT_EQ(nodes, counts.nodes);
}

TEST_P(SimulatorStateTest, ViewsAreOfThePresentState) {
    Simulator simulator = make(two_boxes({0.0, -9.81, 0.0}));
    for (int f = 0; f < 3; ++f) {
        const HostFrame frame = simulator.read_frame();
        const auto positions = simulator.positions(), velocities = simulator.velocities();
        ASSERT_EQ(3 * positions.size(), frame.positions.size());
        for (std::size_t n = 0; n < positions.size(); ++n) {
            for (int k = 0; k < 3; ++k) {
                const std::size_t i = 3 * n + static_cast<std::size_t>(k);
                ASSERT_EQ(positions[n][k], frame.positions[i]);
                ASSERT_EQ(velocities[n][k], frame.velocities[i]);
            }
            ASSERT_GT(positions[n].w, 0.0f);
        }
        EXPECT_EQ(simulator.positions().data(), positions.data());  // no second copy
        simulator.advance_frame();
    }
    EXPECT_LT(simulator.velocities()[0].y, -0.4f);
}

TEST_P(SimulatorStateTest, PositionsAndVelocitiesCanBeSet) {
    Simulator simulator = make_floating();
    advance(simulator, 2);
    const glm::vec3 left = center_of(simulator, 0);
    std::vector<glm::vec3> places = places_of(simulator, 1);
    for (glm::vec3& p : places) p += glm::vec3(0.0f, 2.0f, 0.0f);
    simulator.set_positions(1, places);
    EXPECT_EQ(places_of(simulator, 1), places);
    EXPECT_EQ(simulator.frame(), 2);
    simulator.set_velocities(0, std::vector<glm::vec3>(places_of(simulator, 0).size(), {0.0f, 0.6f, 0.0f}));
    const double time = simulator.time();
    advance(simulator, 30);
    EXPECT_NEAR(simulator.time(), time + 0.5, 1e-9);
    EXPECT_LT(glm::distance(center_of(simulator, 0), left + glm::vec3(0.0f, 0.3f, 0.0f)), 1e-4f);
    EXPECT_LT(glm::distance(places_of(simulator, 1)[0], places[0]), 1e-4f);
}

// Programs that control bodies set velocities before each frame: what gravity does goes on.
TEST_P(SimulatorStateTest, VelocitiesThatAreSetToWhatTheyAreChangeNothing) {
    Scene scene = two_boxes(glm::dvec3(0.0, -9.81, 0.0));
    Simulator simulator = make(scene);
    const float start = center_of(simulator, 0).y;
    constexpr int kFrames = 20;
    for (int frame = 0; frame < kFrames; ++frame) {
        std::vector<glm::vec3> velocities;
        for (std::size_t n = 0; n < places_of(simulator, 0).size(); ++n)
            velocities.emplace_back(simulator.velocities()[n]);
        simulator.set_velocities(0, velocities);
        simulator.advance_frame();
    }
    const double time = kFrames / 60.0;
    EXPECT_NEAR(static_cast<double>(simulator.velocities()[0].y), -9.81 * time, 0.01);
    EXPECT_NEAR(static_cast<double>(center_of(simulator, 0).y - start), -0.5 * 9.81 * time * time, 0.04);
}

TEST_P(SimulatorStateTest, ForcesActUntilOthersAreSet) {
    Simulator simulator = make_floating();
    const ObjectInfo left = simulator.object(0);
    std::vector<glm::vec3> forces;  // all nodes alike: 2 m/s^2 upwards
    for (const glm::vec4& p : simulator.positions().subspan(left.nodes.first, left.nodes.count))
        forces.emplace_back(0.0f, 2.0f / p.w, 0.0f);
    simulator.set_forces(0, forces);
    const glm::vec3 start = center_of(simulator, 0), other = center_of(simulator, 1);
    advance(simulator, 60);
    EXPECT_NEAR(simulator.velocities()[left.nodes.first].y, 2.0f, 5e-3f);
    EXPECT_NEAR(center_of(simulator, 0).y - start.y, 1.0f, 0.02f);  // of the first order in the step
    EXPECT_LT(glm::distance(center_of(simulator, 1), other), 1e-5f);
    simulator.set_forces(0, {});
    advance(simulator, 10);
    // 0.43 of the last step's change, of 1/60 s, were still to come.
    EXPECT_NEAR(simulator.velocities()[left.nodes.first].y, 2.0f, 5e-3f + 0.43f * 2.0f / 60.0f);
}

TEST_P(SimulatorStateTest, BodiesThatAreSetIntoOthersAreMovedApart) {
    Simulator simulator = make_floating();
    std::vector<std::string> lines;
    set_log_callback([&](Severity severity, std::string_view line) {
        if (severity == Severity::warning) lines.emplace_back(line);
    });
    std::vector<glm::vec3> places = places_of(simulator, 1);
    for (glm::vec3& p : places) p.x -= 0.7f;  // 0.3 m apart, and 0.4 m wide
    simulator.set_positions(1, places);
    set_log_callback({});
    EXPECT_THAT(lines, ElementsAre(HasSubstr("'left' and 'right' overlap where they were set; ")));
    EXPECT_GT(center_of(simulator, 1).x - center_of(simulator, 0).x, 0.399f);
    advance(simulator, 5);
    EXPECT_GT(center_of(simulator, 1).x - center_of(simulator, 0).x, 0.399f);
}

TEST_P(SimulatorStateTest, BodiesThatCannotBeMovedApartAreRefused) {
    Scene scene = two_boxes(glm::dvec3(0.0));
    for (ObjectDescription& box : scene.objects) box.pins = {HalfSpaceRegion{{0, 1, 0}, 0.81}};
    Simulator simulator = make(scene);
    const auto before = places_of(simulator, 1);
    std::vector<glm::vec3> places = before;
    for (glm::vec3& p : places) p.x -= 0.7f;
    EXPECT_THAT(message_of([&] { simulator.set_positions(1, places); }),
                HasSubstr("needs objects that are apart where they were set; 'left' and 'right' overlap"));
    EXPECT_EQ(places_of(simulator, 1), before);
}

TEST_P(SimulatorStateTest, HeldNodesStayWhereTheyAre) {
    Scene scene = two_boxes(glm::dvec3(0.0));
    scene.objects[0].pins = {HalfSpaceRegion{{0, 1, 0}, 0.81}};
    Simulator simulator = make(scene);
    const auto before = places_of(simulator, 0);
    std::vector<glm::vec3> places = before;
    for (glm::vec3& p : places) p.y += 0.01f;
    simulator.set_positions(0, places);
    simulator.set_velocities(0, places);
    for (std::size_t n = 0; n < places.size(); ++n) {
        const bool is_held = before[n].y < 0.811f;
        EXPECT_EQ(simulator.positions()[n].w == 0.0f, is_held);
        EXPECT_EQ(glm::vec3(simulator.positions()[n]), is_held ? before[n] : places[n]);
        EXPECT_EQ(glm::vec3(simulator.velocities()[n]), is_held ? glm::vec3(0.0f) : places[n]);
    }
}

// The lower nodes of the right box.
std::vector<std::uint32_t> lower_nodes(const Simulator& simulator) {
    std::vector<std::uint32_t> lower;
    const auto places = places_of(simulator, 1);
    for (std::uint32_t n = 0; n < places.size(); ++n)
        if (places[n].y < center_of(simulator, 1).y - 0.15f) lower.push_back(n);
    return lower;
}

TEST_P(SimulatorStateTest, PinsHoldNodesWhereTheyAre) {
    Simulator simulator = make(two_boxes({0.0, -9.81, 0.0}));
    advance(simulator, 5);
    const auto lower = lower_nodes(simulator);
    ASSERT_GE(lower.size(), 9u);
    const auto before = places_of(simulator, 1);
    simulator.pin(1, lower);
    EXPECT_EQ(places_of(simulator, 1), before);
    EXPECT_EQ(simulator.frame(), 5);
    const float left = center_of(simulator, 0).y;
    advance(simulator, 30);
    for (const std::uint32_t n : lower) EXPECT_EQ(places_of(simulator, 1)[n], before[n]);
    EXPECT_LT(center_of(simulator, 0).y, left - 1.0f);  // falls on
    EXPECT_GT(center_of(simulator, 1).y, 0.7f);
    const std::vector<HeldNodes> held = simulator.held_nodes();
    ASSERT_EQ(held.size(), 1u);
    EXPECT_EQ(held[0].object, 1u);
    EXPECT_TRUE(held[0].is_pin);
    EXPECT_EQ(held[0].count, lower.size());

    simulator.unpin(1);
    EXPECT_TRUE(simulator.held_nodes().empty());
    const float height = center_of(simulator, 1).y;
    advance(simulator, 30);
    EXPECT_LT(center_of(simulator, 1).y, height - 1.0f);
}

TEST_P(SimulatorStateTest, PinsCanBeDraggedAndResetReleasesThem) {
    Simulator simulator = make_floating();
    const auto lower = lower_nodes(simulator);
    simulator.pin(1, lower);
    const auto before = places_of(simulator, 1);
    simulator.drag(0, {{0.0, 0.2, 0.0}, {1.0, 0.0, 0.0, 0.0}});
    advance(simulator, 60);
    for (const std::uint32_t n : lower)
        EXPECT_LT(glm::distance(places_of(simulator, 1)[n], before[n] + glm::vec3(0.0f, 0.2f, 0.0f)), 1e-3f);
    simulator.reset();
    EXPECT_TRUE(simulator.held_nodes().empty());
    EXPECT_EQ(simulator.frame(), 0);
    EXPECT_EQ(places_of(simulator, 1), before);
    EXPECT_GT(simulator.positions()[simulator.object(1).nodes.first + lower[0]].w, 0.0f);
}

TEST_P(SimulatorStateTest, PinsComeAfterThoseOfTheSceneWhichGoOn) {
    Scene scene = two_boxes(glm::dvec3(0.0));
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{0, 1, 0}, 0.81};
    handle.keyframes = {{0.0, glm::dvec3(0.0)}, {1.0, {0.0, 0.0, 0.5}}};
    scene.objects[1].handles = {handle};
    scene.objects[0].pins = {HalfSpaceRegion{{0, 1, 0}, 0.81}};
    Simulator simulator = make(scene), alike = make(scene);
    advance(simulator, 10);
    advance(alike, 10);
    std::vector<std::uint32_t> upper;
    const auto places = places_of(simulator, 0);
    for (std::uint32_t n = 0; n < places.size(); ++n)
        if (places[n].y > 1.19f) upper.push_back(n);
    simulator.pin(0, upper);
    ASSERT_EQ(simulator.held_nodes().size(), 3u);
    EXPECT_EQ(simulator.held_nodes()[1].object, 0u);
    EXPECT_EQ(simulator.held_nodes()[1].index, 1u);
    advance(simulator, 30);
    advance(alike, 30);
    for (std::size_t n = 0; n < places_of(alike, 1).size(); ++n)
        EXPECT_LT(glm::distance(places_of(simulator, 1)[n], places_of(alike, 1)[n]), 1e-4f);
    for (const std::uint32_t n : upper)
        EXPECT_LT(glm::distance(places_of(simulator, 0)[n], places[n]), 1e-6f);
}

TEST_P(SimulatorStateTest, PinsAreNoPartOfCheckpoints) {
    const TemporaryFolder folder;
    Simulator pinned = make_floating(), free = make_floating();
    pinned.pin(1, lower_nodes(pinned));
    pinned.save_checkpoint(folder.path() / "pinned");
    free.save_checkpoint(folder.path() / "free");
    pinned.load_checkpoint(folder.path() / "free");
    free.load_checkpoint(folder.path() / "pinned");
    const auto held = [](const Simulator& simulator) {
        return std::count_if(simulator.positions().begin(), simulator.positions().end(),
                             [](const glm::vec4& p) { return p.w == 0.0f; });
    };
    EXPECT_EQ(held(free), 0);
    EXPECT_EQ(static_cast<std::size_t>(held(pinned)), lower_nodes(pinned).size());
}

// As another simulator of that material that goes on from there.
TEST_P(SimulatorStateTest, MaterialsChangeWithoutAnotherState) {
    Scene scene = two_boxes({0.0, -9.81, 0.0});
    scene.objects[0].pins = {HalfSpaceRegion{{0, 1, 0}, 0.81}};
    Simulator simulator = make(scene);
    advance(simulator, 10);
    Material other = scene.materials[0];
    other.youngs_modulus = 2e4;
    other.density = 500.0;
    other.poisson_ratio = 0.4;
    other.damping = 0.05;
    other.friction = 0.9;
    scene.materials[0] = other;
    Simulator expected = make(scene);
    expected.go_on_from(simulator);
    simulator.set_material(other);
    EXPECT_NEAR(simulator.object(1).mass, 32.0, 1e-3);
    EXPECT_EQ(simulator.frame(), 10);
    EXPECT_EQ(simulator.scene().materials[0].youngs_modulus, 2e4);
    advance(simulator, 10);
    advance(expected, 10);
    EXPECT_EQ(simulator.frame(), expected.frame());
    EXPECT_EQ(largest_difference(simulator.read_frame(), expected.read_frame()), 0.0);
    simulator.reset();
    EXPECT_NEAR(simulator.object(1).mass, 32.0, 1e-3);
}

TEST_P(SimulatorStateTest, ForcesAndPullsStayWhenTheModelChanges) {
    Simulator simulator = make_floating();
    const ObjectInfo left = simulator.object(0), right = simulator.object(1);
    simulator.set_forces(0, std::vector<glm::vec3>(left.nodes.count, {0.0f, 5.0f, 0.0f}));
    Pull pull;
    for (std::uint32_t n = right.nodes.first; n < right.nodes.end(); ++n)
        pull.nodes.push_back({n, {}, 10.0f});
    pull.target = {0.5, 3.0, 0.0};
    simulator.set_pulls({pull});
    simulator.pin(0, std::vector<std::uint32_t>{0});
    simulator.unpin(0);
    advance(simulator, 10);
    EXPECT_GT(center_of(simulator, 0).y, 1.001f);
    EXPECT_GT(center_of(simulator, 1).y, 1.001f);
}

TEST_P(SimulatorStateTest, SeveralHandsPullAtOnce) {
    Simulator simulator = make_floating();
    std::vector<Pull> pulls(2);
    for (std::size_t o = 0; o < 2; ++o) {
        const IndexRange nodes = simulator.object(o).nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            pulls[o].nodes.push_back({n, glm::vec3(simulator.positions()[n]), 100.0f});
        pulls[o].damping_time = 0.1;
    }
    simulator.set_pulls(pulls);
    simulator.move_pull(0, {0.0, 0.5, 0.0});
    simulator.move_pull(1, {0.0, -0.25, 0.0});
    advance(simulator, 240);
    EXPECT_NEAR(center_of(simulator, 0).y, 1.5f, 1e-2f);
    EXPECT_NEAR(center_of(simulator, 1).y, 0.75f, 1e-2f);
}

TEST_P(SimulatorStateTest, WrongValuesAreRefused) {
    Simulator simulator = make_floating();
    const std::size_t nodes = simulator.object(0).nodes.count;
    std::vector<glm::vec3> values(nodes - 1);
    EXPECT_EQ(message_of([&] { simulator.set_positions(0, values); }),
              "positions of object 'left': are " + std::to_string(nodes - 1) + ", and must be " +
                  std::to_string(nodes) + ", one for each of its nodes");
    values.resize(nodes, glm::vec3(0.0f));
    values[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(message_of([&] { simulator.set_velocities(0, values); }),
              "velocities of object 'left' = [0, nan, 0]: must be finite, at node 3");
    EXPECT_THAT(message_of([&] { simulator.set_forces(0, values); }), HasSubstr("forces of object 'left'"));
    EXPECT_EQ(message_of([&] { simulator.set_forces(7, {}); }), "there is no object 7: there are 2, from 0");
    using Nodes = std::vector<std::uint32_t>;
    EXPECT_EQ(message_of([&] { simulator.pin(0, Nodes{}); }), "a pin of object 'left' has no nodes");
    EXPECT_THAT(message_of([&] { simulator.pin(0, Nodes{999999}); }), HasSubstr("has no node 999999"));
    EXPECT_EQ(message_of([&] {
                  simulator.pin(0, Nodes{1, 1});
              }),
              "node 1 of object 'left' is held already, or there twice");
    Material material;
    material.name = "jely";
    EXPECT_EQ(message_of([&] { simulator.set_material(material); }),
              "there is no material 'jely' (did you mean \"jelly\"?); there are jelly");
    material.name = "jelly";
    material.density = -1.0;
    EXPECT_EQ(message_of([&] { simulator.set_material(material); }),
              "material.jelly.density = -1: must be greater than 0");
    material = simulator.scene().materials[0];
    material.model = MaterialModel::neo_hookean;
    EXPECT_THAT(message_of([&] { simulator.set_material(material); }), HasSubstr("model and springs cannot"));
    Pull pull;
    pull.nodes = {{999999, {}, 1.0f}};
    EXPECT_THAT(message_of([&] { simulator.set_pulls({pull}); }), HasSubstr("there is no node 999999"));
    pull.nodes = {{0, {}, 0.0f}};
    EXPECT_THAT(message_of([&] { simulator.set_pulls({pull}); }), HasSubstr("must be positive"));
    pull.nodes = {{0, {}, 1.0f}, {0, {}, 1.0f}};
    EXPECT_THAT(message_of([&] { simulator.set_pulls({pull}); }), HasSubstr("node 0 is there twice"));
    EXPECT_THAT(message_of([&] { simulator.move_pull(0, {}); }), HasSubstr("there is no pull 0"));
    EXPECT_EQ(simulator.scene().materials[0].density, 1000.0);
    advance(simulator, 1);
}

TEST_P(SimulatorStateTest, CallbacksComeBeforeAndAfterEachStep) {
    Simulator simulator = make_floating();
    std::vector<std::string> calls;
    double time = -1.0;
    simulator.before_step([&](Simulator& now) {
        calls.push_back("before");
        EXPECT_EQ(now.time(), std::max(time, 0.0));
    });
    simulator.after_step([&](Simulator& now) {
        calls.push_back("after");
        time = now.time();
        EXPECT_GT(time, 0.0);
        if (calls.size() == 4) throw std::runtime_error("enough");
    });
    simulator.step();
    EXPECT_THROW(simulator.step(), std::runtime_error);
    EXPECT_THAT(calls, ElementsAre("before", "after", "before", "after"));
    EXPECT_NEAR(simulator.time(), 2.0 * simulator.step_size(), 1e-12);
    simulator.after_step({});
    simulator.before_step([](Simulator& now) {
        now.set_velocities(0, std::vector<glm::vec3>(now.object(0).nodes.count, {0.0f, 1.0f, 0.0f}));
    });
    const float height = center_of(simulator, 0).y;
    simulator.step();
    EXPECT_NEAR(center_of(simulator, 0).y - height, simulator.step_size(), 1e-5);
}

TEST_P(SimulatorStateTest, ContactForcesCarryABody) {
    Scene scene = two_boxes({0.0, -9.81, 0.0});
    for (ObjectDescription& box : scene.objects) box.position.y = 0.2;
    scene.colliders.emplace_back().shape = PlaneCollider{};
    Simulator simulator = make(scene);
    advance(simulator, 120);
    const auto forces = simulator.contact_forces();
    ASSERT_EQ(forces.size(), 2u);
    for (std::size_t o = 0; o < 2; ++o) {
        const ObjectInfo object = simulator.object(o);
        EXPECT_EQ(forces[o].object, o);
        EXPECT_NEAR(forces[o].normal[1], object.mass * 9.81, 0.05 * object.mass * 9.81);
        glm::vec3 sum(0.0f);
        for (const glm::vec4& f :
             simulator.node_contact_forces().subspan(object.nodes.first, object.nodes.count))
            sum += glm::vec3(f);
        EXPECT_NEAR(static_cast<double>(sum.y), forces[o].normal[1] + forces[o].friction[1], 1e-2);
    }
}

}  // namespace
}  // namespace gelatin
