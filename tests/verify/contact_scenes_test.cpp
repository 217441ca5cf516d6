// The scenes with contact that come with Gelatin do what they show, and nothing in them passes through
// anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gelatin/simulator.h"
#include "model/assembly/attachments.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/gl_fixture.h"
#include "support/overlaps.h"
#include "support/source_path.h"

namespace gelatin::contact_scenes_test {
namespace {

class ContactScene {
public:
    explicit ContactScene(const std::string& name, Backend backend = Backend::cpu,
                          const std::vector<std::string>& changes = {})
        : simulator_(load_scene(test::source_path() + "scenes/" + name, changes), on(backend)) {}

    // Looks for overlaps after every fifth frame, or so many.
    void advance_to(int frame, int every = 5) {
        while (simulator_.frame() < frame) {
            simulator_.advance_frame();
            now_ = simulator_.read_frame();
            if (simulator_.frame() % every != 0) continue;
            std::vector<cpu::Vec4<float>> positions;
            for (std::size_t n = 0; 3 * n < now_.positions.size(); ++n)
                positions.emplace_back(now_.positions[3 * n], now_.positions[3 * n + 1],
                                       now_.positions[3 * n + 2], 0.0f);
            const test::Overlaps which = simulator_.scene().collision.self_collision.value_or(true)
                                             ? test::Overlaps::all
                                             : test::Overlaps::between;
            const Model& model = model_of(simulator_);
            ASSERT_EQ(test::count_overlaps(model, positions, which, joined_bodies(simulator_.scene(), model)),
                      0u)
                << "frame " << simulator_.frame();
        }
    }

    glm::dvec3 center(std::size_t object) const { return mean(object, now_.positions); }
    glm::dvec3 velocity(std::size_t object) const { return mean(object, now_.velocities); }

    double fastest() const {
        double most = 0.0;
        for (std::size_t v = 0; v < now_.velocities.size(); v += 3)
            most = std::max(most, static_cast<double>(glm::length(glm::vec3(
                                      now_.velocities[v], now_.velocities[v + 1], now_.velocities[v + 2]))));
        return most;
    }

    // Of the nodes whose height is near y [m].
    glm::dvec3 extent_near_y(double y, double distance) const {
        glm::dvec3 low(1e9), high(-1e9);
        for (std::size_t n = 0; n < now_.positions.size(); n += 3) {
            const glm::dvec3 p(now_.positions[n], now_.positions[n + 1], now_.positions[n + 2]);
            if (std::abs(p.y - y) > distance) continue;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        return high - low;
    }

    FrameStatistics statistics() {
        simulator_.begin_statistics();
        return simulator_.take_statistics();
    }

    double weight(std::size_t object) const { return 9.81 * simulator_.object(object).mass; }  // [N]

    // A hand takes an object by all of its nodes.
    void grab(std::size_t object) {
        const Range& nodes = model_of(simulator_).objects[object].nodes;
        now_ = simulator_.read_frame();
        hand_ = center(object);
        Pull pull;
        pull.target = hand_;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::vec3 place(now_.positions[3 * n], now_.positions[3 * n + 1],
                                  now_.positions[3 * n + 2]);
            pull.nodes.push_back({n, place - glm::vec3(hand_), 50.0f});
        }
        pull.damping_time = 0.05;
        simulator_.set_pulls({pull});
    }
    // The hand goes straight to `place`. @param speed [m/s]
    void drag_to(const glm::dvec3& place, double speed) {
        const double way = speed * simulator_.scene().simulation.frame_time();
        while (glm::distance(hand_, place) > 1e-6) {
            const glm::dvec3 left = place - hand_;
            hand_ += std::min(1.0, way / glm::length(left)) * left;
            simulator_.move_pull(0, hand_);
            advance_to(simulator_.frame() + 1, 1);
        }
    }
    void let_go() { simulator_.set_pulls({}); }
    int frame() const { return simulator_.frame(); }

    // Of the first object's middle, after some frames each [m].
    double lowest_until(int frame) {
        double lowest = center(0).y;
        while (simulator_.frame() < frame) {
            advance_to(std::min(frame, simulator_.frame() + 5));
            lowest = std::min(lowest, center(0).y);
        }
        return lowest;
    }

private:
    static SimulatorOptions on(Backend backend) {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = backend == Backend::gl;
        return options;
    }
    glm::dvec3 mean(std::size_t object, const std::vector<float>& of) const {
        const Range& nodes = model_of(simulator_).objects[object].nodes;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += glm::dvec3(of[3 * n], of[3 * n + 1], of[3 * n + 2]);
        return sum / static_cast<double>(nodes.count);
    }

    Simulator simulator_;
    HostFrame now_;
    glm::dvec3 hand_{0.0};
};

class ContactScenesOnGlHeavy : public test::GlTest {};

TEST(ContactScenesHeavy, ABallFallsThroughAFunnel) {
    ContactScene scene("funnel.toml");
    scene.advance_to(40);
    EXPECT_GT(scene.center(0).y, 0.5);  // in free fall it would be at 0.42
    scene.advance_to(300);
    EXPECT_LT(scene.center(0).y, 0.4);
}

TEST(ContactScenesHeavy, ARodPressesABallThroughARing) {
    ContactScene scene("squeeze.toml");
    scene.advance_to(70);
    EXPECT_GT(scene.center(0).y, 0.95);       // it is caught
    EXPECT_LT(scene.lowest_until(200), 0.6);  // on the floor, from which it bounces
}

// Pulled along y, the knot draws together and stays: a bar without one is 0.15 m thick.
TEST(ContactScenesHeavy, AKnotIsPulledTight) {
    ContactScene scene("knot.toml");
    scene.advance_to(130);
    const glm::dvec3 loose = scene.extent_near_y(0.0, 0.6);
    scene.advance_to(330);
    const glm::dvec3 tight = scene.extent_near_y(0.0, 0.6);
    EXPECT_GT(loose.x, 0.6);
    EXPECT_LT(tight.x, 0.45);
    EXPECT_GT(tight.x, 0.3);
}

TEST(ContactScenesHeavy, PlatesCarryABall) {
    ContactScene scene("gripper.toml");
    scene.advance_to(165);
    EXPECT_NEAR(scene.center(0).y, 1.35, 0.05);
    // Friction carries the weight of the ball, which sways.
    double lifting = 0.0;
    for (int frame = 171; frame <= 230; ++frame) {
        scene.advance_to(frame);
        for (const ContactForce& force : scene.statistics().contact_forces)
            lifting += (force.normal[1] + force.friction[1]) / 60.0;
    }
    EXPECT_NEAR(lifting, scene.weight(0), 0.05 * scene.weight(0));
    // The plates have gone 1.2 m (3 s^2 - 2 s^3) with s = 8 / 9, and press as before.
    EXPECT_NEAR(scene.center(0).x, 1.159, 0.01);
    EXPECT_GT(scene.statistics().elastic_energy, 75.0);
    scene.advance_to(400);
    EXPECT_GT(scene.center(0).x, 1.0);
    EXPECT_LT(scene.center(0).y, 1.0);  // it bounces
}

TEST(ContactScenesHeavy, BeltsCarryLettersIntoACrate) {
    ContactScene scene("conveyor.toml");
    scene.advance_to(600);
    for (const std::size_t object : {0, 1, 2, 3, 4}) {
        const glm::dvec3 center = scene.center(object);
        EXPECT_NEAR(center.x, 1.45, 0.6) << object;
        EXPECT_LT(center.y, 0.5) << object;
        EXPECT_NEAR(center.z, 2.6, 0.6) << object;
    }
}

TEST(ContactScenesHeavy, BlocksHoldAndSlideOnARamp) {
    ContactScene scene("ramp.toml");
    scene.advance_to(60);
    const glm::dvec3 held = scene.center(0);
    const double before = glm::length(scene.velocity(1));
    scene.advance_to(180);
    EXPECT_LT(glm::distance(scene.center(0), held), 1e-5);
    // 20 degrees, friction 0.33.
    EXPECT_NEAR((glm::length(scene.velocity(1)) - before) / 2.0, 9.81 * (0.34202 - 0.33 * 0.93969),
                0.02 * 9.81 * 0.33);
    EXPECT_GT(scene.center(2).x, 2.0);
}

TEST(ContactScenesHeavy, AStackStands) {
    ContactScene scene("stack.toml");
    scene.advance_to(300);
    EXPECT_LT(scene.fastest(), 1e-4);
    EXPECT_NEAR(scene.center(9).y, 0.80, 0.01);
}

// The halves of a bar swing against each other, and hang.
TEST(ContactScenesHeavy, ABarFoldsOverARod) {
    ContactScene scene("fold.toml");
    scene.advance_to(200);
    EXPECT_NEAR(scene.center(0).y, 1.7, 0.15);
    EXPECT_LT(scene.fastest(), 1.0);
}

TEST(ContactScenesHeavy, APlateStopsABallAtAnySpeed) {
    for (const auto& [speed, frames] : {std::pair(50.0, 4), std::pair(5000.0, 1)}) {
        ContactScene scene("bullet.toml", Backend::cpu,
                           {"object.ball.velocity=[0, 0, " + std::to_string(-speed) + "]"});
        scene.advance_to(frames, 1);
        EXPECT_GT(scene.velocity(1).z, -0.1 * speed) << speed;  // the plate may be deep then
    }
}

TEST(ContactScenesHeavy, LettersFallOnEachOther) {
    ContactScene scene("letters.toml");
    scene.advance_to(300);
    EXPECT_LT(scene.fastest(), 8.0);
}

TEST(ContactScenesHeavy, DropsRainOnEachOther) {
    ContactScene scene("rain.toml", Backend::cpu, {"object.drop.copies.counts=[3, 4, 3]"});
    scene.advance_to(300);
    EXPECT_LT(scene.fastest(), 3.0);
}

// Objects: the beam, three ropes, three balls, the long rope, the heavy ball. One ball is torn off its rope.
TEST(ContactScenesHeavy, BallsHangOnRopes) {
    ContactScene scene("ropes.toml");
    for (int frame = 5; frame <= 100; frame += 5) {
        scene.advance_to(frame);
        if (frame == 35) {  // before it is hit
            EXPECT_FALSE(scene.statistics().attachments[7].is_broken);
        }
        // 1.2 m of rope and ball below the joint, and what the rope yields.
        EXPECT_NEAR(glm::distance(scene.center(8), {-0.85, 2.22, 0.0}), 1.22, 0.15) << frame;
    }
    scene.advance_to(300);
    const std::vector<AttachmentStatus> attachments = scene.statistics().attachments;
    for (std::size_t a = 0; a < attachments.size(); ++a) EXPECT_EQ(attachments[a].is_broken, a == 7) << a;
    EXPECT_LT(scene.center(6).y, 0.5);
    for (const std::size_t ball : {4, 5}) EXPECT_GT(scene.center(ball).y, 1.0) << ball;
}

// Objects: two posts, two doors, a ball that flies towards -z. Each door's centre is 0.41 m from its hinge.
TEST(ContactScenesHeavy, DoorsSwingOnHinges) {
    ContactScene scene("hinge.toml");
    double least = 0.0, most = 0.0;
    for (int frame = 5; frame <= 360; frame += 5) {
        scene.advance_to(frame);
        for (const auto& [door, hinge] : {std::pair(2, -0.83), std::pair(3, 0.83)}) {
            const glm::dvec3 center = scene.center(static_cast<std::size_t>(door));
            EXPECT_NEAR(std::hypot(center.x - hinge, center.z), 0.41, 0.012) << door << " in " << frame;
            EXPECT_NEAR(center.y, 1.0, 0.012) << door << " in " << frame;
            least = std::min(least, center.z);
            most = std::max(most, center.z);
        }
        if (frame == 60) {
            EXPECT_LT(scene.center(4).z, -1.0);  // the ball is through
        }
    }
    EXPECT_LT(least, -0.35);
    EXPECT_GT(most, 0.35);
}

// Blocks 0.34 m apart, which a table 1.3 m high does not hold.
TEST(ContactScenesHeavy, ATrainFallsOffATable) {
    ContactScene scene("train.toml");
    for (int frame = 5; frame <= 300; frame += 5) {
        scene.advance_to(frame);
        for (std::size_t block = 0; block < 8; ++block)
            EXPECT_LT(glm::distance(scene.center(block), scene.center(block + 1)), 0.4) << frame;
        if (frame == 60) {
            EXPECT_GT(scene.center(0).y, 1.3);
        }
    }
    for (std::size_t block = 0; block < 9; ++block) EXPECT_LT(scene.center(block).y, 0.2) << block;
    EXPECT_LT(scene.fastest(), 1e-3);
}

// Objects: 21 crates by rows from below, a ball that flies towards +x, a cushion.
TEST(ContactScenesHeavy, ABallKnocksDownAPyramidOfCrates) {
    constexpr std::size_t kCrates = 21;
    ContactScene scene("crates.toml");
    scene.advance_to(1);
    std::vector<glm::dvec3> start;
    for (std::size_t crate = 0; crate < kCrates; ++crate) start.push_back(scene.center(crate));
    scene.advance_to(50);  // before it is hit
    for (std::size_t crate = 0; crate < kCrates; ++crate)
        EXPECT_LT(glm::distance(scene.center(crate), start[crate]), 0.01) << crate;
    scene.advance_to(300);
    EXPECT_LT(scene.center(kCrates - 1).y, 1.0);  // the top one, from 1.66
    std::size_t high = 0, on_cushion = 0;
    for (std::size_t crate = 0; crate < kCrates; ++crate) {
        const glm::dvec3 center = scene.center(crate);
        EXPECT_GT(center.y, 0.14) << crate;
        high += center.y > 0.9 ? 1 : 0;  // six at the start
        on_cushion += std::abs(center.x - 1.85) < 0.8 && std::abs(center.z) < 0.7 && center.y > 0.45 ? 1 : 0;
    }
    EXPECT_LT(high, 3u);
    EXPECT_GT(on_cushion, 0u);
}

// Objects: 15 links of 0.16 m from the ball to the suspension, the ball, nine columns.
TEST(ContactScenesHeavy, ABallOnAChainKnocksDownColumns) {
    constexpr std::size_t kLinks = 15, kBall = 15;
    ContactScene scene("wrecker.toml");
    for (int frame = 5; frame <= 300; frame += 5) {
        scene.advance_to(frame);
        for (std::size_t link = 0; link + 1 < kLinks; ++link)
            EXPECT_LT(glm::distance(scene.center(link), scene.center(link + 1)), 0.162) << frame;
        EXPECT_LT(glm::distance(scene.center(kBall), {0.0, 3.1, 0.0}), 2.69) << frame;
        if (frame == 50) {  // before the ball arrives
            EXPECT_LT(scene.center(kBall).x, 0.0);
            for (std::size_t column = kBall + 1; column <= kBall + 9; ++column)
                EXPECT_NEAR(scene.center(column).y, 0.6, 0.03) << column;
        }
    }
    for (std::size_t column = kBall + 1; column <= kBall + 9; ++column)
        EXPECT_LT(scene.center(column).y, 0.35) << column;
}

// Objects: a ball, a carriage, a palm, two fingers.
TEST(ContactScenesHeavy, AGripperWithMotorsCarriesABall) {
    ContactScene scene("grab.toml");
    for (int frame = 10; frame <= 480; frame += 10) {
        scene.advance_to(frame);
        const glm::dvec3 ball = scene.center(0);
        if (frame == 80) {
            EXPECT_NEAR(ball.y, 0.23, 0.02);
        }
        if (frame >= 180 && frame <= 360) {
            EXPECT_GT(ball.y, 0.6) << frame;
        }
        if (frame == 360) {
            EXPECT_NEAR(ball.x, 1.0, 0.15);
        }
        if (frame <= 360) {
            EXPECT_LT(std::abs(ball.z), 0.05) << frame;
        }
    }
    EXPECT_NEAR(scene.center(1).x, 1.0, 1e-3);
    EXPECT_NEAR(scene.center(2).y, 0.85 + 0.5, 1e-3);
    EXPECT_LT(scene.center(0).y, 0.35);
}

// Objects: a body, then of four wheels a carrier, a rim and a tyre.
TEST(ContactScenesHeavy, ACarDrivesOverALogAndUpAKerb) {
    ContactScene scene("car.toml");
    for (int frame = 10; frame <= 300; frame += 10) {
        scene.advance_to(frame);
        for (std::size_t wheel = 0; wheel < 4; ++wheel) {
            const glm::dvec3 rim = scene.center(2 + 3 * wheel);
            EXPECT_NEAR(glm::distance(scene.center(1 + 3 * wheel), rim), 0.09, 2e-3) << frame;
            EXPECT_LT(glm::distance(scene.center(3 + 3 * wheel), rim), 0.03) << frame;
        }
        EXPECT_LT(std::abs(scene.center(0).z), 0.1) << frame;
        if (frame == 30) {
            EXPECT_NEAR(scene.center(0).y, 0.45, 0.04);
        }
    }
    EXPECT_GT(scene.center(0).x, 2.3);
    EXPECT_NEAR(scene.center(0).y, 0.1 + 0.45, 0.04);  // on the kerb
}

// Objects: two wheels on an axle, and their tyres.
TEST(ContactScenesHeavy, WheelsRollOnTyresThatAreFilled) {
    ContactScene scene("tyre.toml");
    scene.advance_to(45);
    const double flat = scene.center(0).y;
    const std::vector<CavityStatus> before = scene.statistics().cavities;
    scene.advance_to(105);
    const std::vector<CavityStatus> after = scene.statistics().cavities;
    EXPECT_GT(scene.center(0).y, flat + 0.02);
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_GT(after[c].pressure, before[c].pressure + 1e4);
        EXPECT_GT(after[c].volume, 1.1 * before[c].volume);
    }
    scene.advance_to(205);
    EXPECT_GT(scene.center(0).x, 2.3) << "beyond the ledge";
    EXPECT_LT(std::abs(scene.center(0).z), 0.1);
    for (std::size_t tyre = 1; tyre <= 2; ++tyre)
        EXPECT_LT(std::abs(scene.center(tyre).y - scene.center(0).y), 0.03) << "it holds the wheel";
}

// Objects: a top that leans, one with a level axis on a post, a slow one.
TEST(ContactScenesHeavy, TopsPrecessUnlessTheyAreSlow) {
    ContactScene scene("tops.toml");
    const glm::dvec3 joint(0.0, 0.4, -0.1);
    scene.advance_to(1);
    const double leaning = scene.center(0).y;
    double turned = 0.0;
    for (int frame = 5; frame <= 480; frame += 4) {
        const glm::dvec3 before = scene.center(1) - joint;
        scene.advance_to(frame);
        const glm::dvec3 now = scene.center(1) - joint;
        turned += std::atan2(before.z * now.x - before.x * now.z, before.x * now.x + before.z * now.z);
        EXPECT_NEAR(now.y, 0.0, 0.01) << frame;
        EXPECT_NEAR(scene.center(0).y, leaning, 0.01) << frame;
        if (frame == 121) {
            EXPECT_NEAR(turned / 2.0, 1.98, 0.03 * 1.98);  // m g l / (I w)
        }
    }
    EXPECT_LT(scene.center(2).y, 0.85 * leaning);
}

// What a user does with it: a stack is hit, and a cube thrown into a ring.
void play(Backend backend) {
    ContactScene scene("play.toml", backend);
    scene.advance_to(10);
    const glm::dvec3 stacked = scene.center(3);
    scene.grab(0);
    scene.drag_to({-0.7, 0.7, 0.0}, 3.0);
    scene.drag_to({1.2, 0.6, -0.5}, 12.0);
    scene.let_go();
    scene.advance_to(scene.frame() + 30, 1);
    EXPECT_GT(glm::distance(scene.center(3), stacked), 0.2);
    scene.grab(3);
    scene.drag_to({0.1, 1.0, 1.0}, 6.0);
    scene.drag_to({0.1, 0.0, 1.0}, 20.0);  // the hand presses it into the ring and the floor
    scene.let_go();
    scene.advance_to(scene.frame() + 60, 1);
    EXPECT_GT(scene.center(3).y, 0.1);
}

TEST(ContactScenesHeavy, NothingPassesThroughAnythingInAHand) {
    play(Backend::cpu);
}
TEST_F(ContactScenesOnGlHeavy, NothingPassesThroughAnythingInAHand) {
    play(Backend::gl);
}

TEST_F(ContactScenesOnGlHeavy, DoWhatTheyDoOnTheCpu) {
    ContactScene squeeze("squeeze.toml", Backend::gl);
    squeeze.advance_to(70);
    EXPECT_GT(squeeze.center(0).y, 0.95);
    EXPECT_LT(squeeze.lowest_until(200), 0.6);
    ContactScene gripper("gripper.toml", Backend::gl);
    gripper.advance_to(165);
    EXPECT_NEAR(gripper.center(0).y, 1.35, 0.05);
    ContactScene stack("stack.toml", Backend::gl);
    stack.advance_to(300);
    EXPECT_LT(stack.fastest(), 1e-4);
    ContactScene knot("knot.toml", Backend::gl);
    knot.advance_to(330);
    EXPECT_LT(knot.extent_near_y(0.0, 0.6).x, 0.45);
}

TEST(ContactScenesLong, AStackStandsForTwentySeconds) {
    ContactScene scene("stack.toml");
    scene.advance_to(1200);
    EXPECT_LT(scene.fastest(), 1e-4);
}

TEST(ContactScenesLong, APileComesToRest) {
    ContactScene scene("pile.toml");
    double peak = 0.0;
    for (int frame = 10; frame <= 480; frame += 10) {
        scene.advance_to(frame);
        if (HasFatalFailure()) return;
        peak = std::max(peak, scene.statistics().kinetic_energy);
    }
    EXPECT_LT(scene.statistics().kinetic_energy, 1e-6 * peak);
    for (std::size_t object = 0; object < 60; ++object) {
        const glm::dvec3 center = scene.center(object);
        EXPECT_LT(std::max(std::abs(center.x), std::abs(center.z)), 1.0) << object;
        EXPECT_GT(center.y, 0.0) << object;
    }
}

}  // namespace
}  // namespace gelatin::contact_scenes_test
