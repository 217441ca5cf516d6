#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <glm/geometric.hpp>

#include "cpu/elasticity/elastic_energy.h"
#include "cpu/implicit/system_solver.h"
#include "cpu/measure/measure.h"
#include "support/contact_scenes.h"
#include "support/overlaps.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using test::Block;
using test::kFrame;
using test::make_blocks;
using test::make_solver;

struct Sums {
    glm::dvec3 momentum{0.0}, angular{0.0};
    double kinetic = 0.0, energy = 0.0;  // energy: of contacts, too [J]
};

template <class Real>
Sums sums_of(const Model& model, const cpu::SystemSolver<Real>& solver) {
    const cpu::Nodes<Real>& nodes = solver.nodes();
    Sums sums;
    sums.energy = solver.contact_energy();
    for (const ObjectMeasure& object : cpu::measure(model, nodes)) {
        sums.momentum += object.momentum;
        sums.kinetic += object.kinetic_energy;
        sums.energy += object.kinetic_energy + object.potential_energy;
    }
    for (std::size_t o = 0; o < model.body_count(); ++o)
        sums.energy += cpu::body_energy<Real>(model, model.objects[o], nodes.positions);
    for (std::size_t n = 0; n < nodes.positions.size(); ++n)
        sums.angular += static_cast<double>(model.masses[n]) *
                        glm::cross(glm::dvec3(nodes.positions[n]), glm::dvec3(nodes.velocities[n]));
    return sums;
}

// Two blocks that meet off their middles.
std::shared_ptr<const Model> make_impact(double speed, double youngs_modulus = 1e5) {
    return make_blocks(
        {{.velocity = {speed, 0.1, 0}, .youngs_modulus = youngs_modulus},
         {.place = {0.34, 0.12, 0.05}, .velocity = {-speed, 0, 0}, .youngs_modulus = youngs_modulus}});
}

template <class Real>
void expect_sound_impact(double speed, double youngs_modulus) {
    const auto model = make_impact(speed, youngs_modulus);
    cpu::SystemSolver<Real> solver = make_solver<Real>(model);
    const Sums before = sums_of(*model, solver);
    double energy = before.energy;
    for (int frame = 0; frame < 40; ++frame) {
        solver.advance({kFrame});
        ASSERT_EQ(test::count_overlaps(*model, solver.nodes().positions), 0u)
            << speed << " m/s, frame " << frame;
        const Sums now = sums_of(*model, solver);
        EXPECT_LT(now.energy, energy + 2e-2 * before.energy) << speed << " m/s, frame " << frame;
        energy = now.energy;
    }
    const Sums after = sums_of(*model, solver);
    const double size = std::sqrt(2.0 * before.kinetic * 54.0);  // of momenta, both masses 27 kg
    EXPECT_LT(glm::length(after.momentum - before.momentum),
              (std::is_same_v<Real, float> ? 3e-5 : 1e-10) * size);
    EXPECT_LT(after.kinetic, 0.9 * before.kinetic);  // they met
}

TEST(Contacts, BodiesMeetAndDoNotPassThroughEachOther) {
    for (const double speed : {1.0, 10.0, 60.0}) {
        expect_sound_impact<float>(speed, 1e5);
        expect_sound_impact<float>(speed, 1e8);
    }
    expect_sound_impact<double>(3.0, 1e5);
}

// However well the motions of many bodies together are solved.
// @param bound of the change [kg m/s]; forces of fast impacts, which cancel in the sum, are large
void expect_momentum_of_many(int count, double speed, bool divides_steps, double bound) {
    std::vector<Block> blocks;
    for (int k = 0; k < count; ++k)
        blocks.push_back({.place = {0.32 * k, 0.03 * (k % 3), 0.02 * (k % 2)},
                          .velocity = {k == 0 ? speed : -0.1 * speed, 0, 0},
                          .cells = {2, 2, 2},
                          .youngs_modulus = k % 2 == 0 ? 1e5 : 1e7});
    const auto model = make_blocks(blocks);
    cpu::SystemSolver<double> solver = make_solver<double>(model, 0.4, 10, divides_steps);
    const Sums before = sums_of(*model, solver);
    double energy = before.energy;
    for (int frame = 0; frame < 40; ++frame) {
        solver.advance({kFrame});
        ASSERT_EQ(test::count_overlaps(*model, solver.nodes().positions), 0u) << frame;
        const Sums now = sums_of(*model, solver);
        EXPECT_LT(glm::length(now.momentum - before.momentum), bound)
            << count << " bodies, " << speed << " m/s, frame " << frame;
        EXPECT_LT(now.energy, energy + 2e-3 * before.energy)
            << count << " bodies, " << speed << " m/s, frame " << frame;
        energy = now.energy;
    }
    EXPECT_LT(sums_of(*model, solver).kinetic, 0.9 * before.kinetic);
}

TEST(Contacts, KeepMomentumOfMany) {
    expect_momentum_of_many(6, 5.0, false, 1e-10);
    expect_momentum_of_many(6, 5.0, true, 1e-9);
}

TEST(ContactsHeavy, KeepMomentumOfTenAtAnySpeed) {
    for (const double speed : {1.0, 10.0, 100.0}) expect_momentum_of_many(10, speed, true, 1e-8 * speed);
}

// In the middle of an impact: nothing is left of its contacts.
TEST(Contacts, StartAgain) {
    const auto model = make_impact(3.0);
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    const State start = solver.read_state();
    const auto advance = [&] {
        for (int frame = 0; frame < 2; ++frame) solver.advance({kFrame});
        return solver.nodes().positions;
    };
    const std::vector<glm::vec4> first = advance();
    ASSERT_FALSE(solver.contact_forces().between.empty());  // they press each other
    solver.write_state(start);
    EXPECT_EQ(advance(), first);
}

// The elements of all materials know contacts.
TEST(Contacts, OfAllMaterials) {
    for (const MaterialModel kind : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        const auto model = make_blocks(
            {{.velocity = {3, 0, 0}, .poisson_ratio = 0.4, .model = kind},
             {.place = {0.34, 0.1, 0.05}, .velocity = {-3, 0, 0}, .poisson_ratio = 0.4, .model = kind}});
        cpu::SystemSolver<float> solver = make_solver<float>(model);
        const Sums before = sums_of(*model, solver);
        ASSERT_TRUE(test::stays_apart(solver, *model, 30));
        EXPECT_LT(sums_of(*model, solver).kinetic, 0.9 * before.kinetic);
    }
}

TEST(ContactsHeavy, BodiesBounceInDividedSteps) {
    const auto left_after = [](int substeps, bool divides_steps) {
        const auto model = make_impact(1.5, 2e4);
        cpu::SystemSolver<float> solver = make_solver<float>(model, 0.4, 10, divides_steps);
        for (int step = 0; step < 60 * substeps; ++step) solver.advance({kFrame / substeps});
        // Of the bodies' middles: what they vibrate with dies down.
        double sum = 0.0;
        for (const ObjectMeasure& object : cpu::measure(*model, solver.nodes()))
            sum += glm::dot(object.momentum, object.momentum) / (2.0 * 27.0);
        return sum;
    };
    const double fine = left_after(64, false), divided = left_after(1, true);
    EXPECT_GT(divided, 0.85 * fine);
    EXPECT_LT(divided, 1.4 * fine);
}

// Two that meet, and a carpet of bodies that press each other: an island so large that threads share it.
TEST(ContactsHeavy, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto run = [](const std::shared_ptr<const Model>& model, int frames, std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        cpu::SystemSolver<float> solver = make_solver<float>(model, 0.4, 10, true);
        for (int frame = 0; frame < frames; ++frame) solver.advance({kFrame});
        return solver.nodes().positions;
    };
    std::vector<Block> carpet;
    for (int k = 0; k < 144; ++k) {
        const double x = k % 12, z = k / 12;
        carpet.push_back(
            {.place = {0.31 * x, 0, 0.31 * z}, .velocity = {6 - x, 0, 6 - z}, .cells = {1, 1, 1}});
    }
    for (const auto& [model, frames] : {std::pair(make_impact(5.0), 20), std::pair(make_blocks(carpet), 3)}) {
        const std::vector<glm::vec4> alone = run(model, frames, 1);
        EXPECT_NE(alone, model->positions);
        for (int again = 0; again < 3; ++again) EXPECT_EQ(alone, run(model, frames, 2));
    }
}

TEST(ContactsHeavy, AStackStandsAndRests) {
    std::vector<Block> blocks;
    for (int k = 0; k < 4; ++k)
        blocks.push_back({.place = {0.01 * (k % 2), 0.01 + 0.31 * k, 0}, .youngs_modulus = 1e6});
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    const auto model = make_blocks(blocks, {0, -9.81, 0}, {floor});
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    for (int frame = 0; frame < 300; ++frame) {
        solver.advance({kFrame});
        if (frame % 10 == 0) {
            ASSERT_EQ(test::count_overlaps(*model, solver.nodes().positions), 0u);
        }
    }
    double fastest = 0.0, highest = 0.0;
    for (std::size_t n = 0; n < model->positions.size(); ++n) {
        fastest =
            std::max(fastest, static_cast<double>(glm::length(glm::vec3(solver.nodes().velocities[n]))));
        highest = std::max(highest, static_cast<double>(solver.nodes().positions[n].y));
    }
    EXPECT_LT(fastest, 0.02);
    EXPECT_NEAR(highest, 4 * 0.3, 0.05);
}

// A block on a pinned plate, under gravity that is inclined. After it has settled:
struct Slide {
    double distance;      // in a second [m]
    double acceleration;  // [m/s^2]
};

// @param of_material of the block's material
Slide slide(double friction, double slope, double youngs_modulus = 1e6,
            std::optional<double> of_material = {}) {
    const double angle = std::atan(slope);
    const Region everywhere = HalfSpaceRegion{{1.0, 0.0, 0.0}, 100.0};
    const auto model = make_blocks(
        {{.place = {-1.0, -0.1, -0.6}, .cells = {100, 1, 10}, .size = {16.0, 0.1, 1.6}, .pins = {everywhere}},
         {.place = {-0.2, 0.012, 0},
          .size = {0.3, 0.2, 0.3},
          .youngs_modulus = youngs_modulus,
          .friction = of_material}},
        9.81 * glm::dvec3(std::sin(angle), -std::cos(angle), 0));
    cpu::SystemSolver<float> solver = make_solver<float>(model, friction);
    const auto mean = [&](const std::vector<glm::vec4>& of) {
        double sum = 0.0;
        const Range& nodes = model->objects[1].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) sum += static_cast<double>(of[n].x);
        return sum / nodes.count;
    };
    for (int frame = 0; frame < 90; ++frame) solver.advance({kFrame});
    const double start = mean(solver.nodes().positions), speed = mean(solver.nodes().velocities);
    for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
    return {mean(solver.nodes().positions) - start, mean(solver.nodes().velocities) - speed};
}

TEST(ContactsHeavy, FrictionIsCoulombs) {
    for (const double youngs_modulus : {1e5, 1e7})
        EXPECT_LT(std::abs(slide(0.5, 0.4, youngs_modulus).distance), 1e-4) << youngs_modulus;
    const double angle = std::atan(0.6), friction = 0.5 * 9.81 * std::cos(angle);  // [m/s^2]
    EXPECT_NEAR(slide(0.5, 0.6, 1e5).acceleration, 9.81 * std::sin(angle) - friction, 0.05 * friction);
    // The geometric mean of 0.8 and 0.2, and of 0.8 and 0.
    EXPECT_LT(std::abs(slide(0.8, 0.3, 1e5, 0.2).distance), 1e-4);
    EXPECT_NEAR(slide(0.8, 0.1, 1e6, 0.0).acceleration, 9.81 * std::sin(std::atan(0.1)), 0.01);
}

// At up to 7 m/s, over edges in all directions.
TEST(ContactsHeavy, NothingStopsWhatSlidesWithoutFriction) {
    for (const double youngs_modulus : {3e4, 1e6, 1e7}) {
        for (const double slope : {0.1, 0.2, 0.3}) {
            EXPECT_NEAR(slide(0.0, slope, youngs_modulus).acceleration, 9.81 * std::sin(std::atan(slope)),
                        0.01)
                << youngs_modulus << ", " << slope;
        }
    }
}

// A ram that a handle moves presses a block on a bed flat, and lets it go.
// Blocks in a row follow each other, and the first is stopped. The gaps between them are more than the last
// goes in a step.
TEST(Contacts, ARowThatStopsDoesNotStopAtOnce) {
    std::vector<Block> blocks{{.cells = {1, 1, 1}, .pins = {HalfSpaceRegion{{1, 0, 0}, 0.1}}}};
    constexpr int kBlocks = 60;
    constexpr double kSpeed = 6.0, kPitch = 0.303;
    for (int k = 1; k < kBlocks; ++k)
        blocks.push_back({.place = {k * kPitch, 0, 0}, .velocity = {-kSpeed, 0, 0}, .cells = {1, 1, 1}});
    const auto model = make_blocks(blocks);
    for (const int sweeps : {1, 10}) {
        cpu::SystemSolver<float> solver = make_solver<float>(model, 0.4, sweeps);
        solver.advance({kFrame});
        const Range& nodes = model->objects.back().nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            EXPECT_NEAR(solver.nodes().velocities[n].x, -kSpeed, 0.02 * kSpeed) << sweeps;
    }
}

TEST(Contacts, AHandlePressesABody) {
    const Region everywhere = HalfSpaceRegion{{1.0, 0.0, 0.0}, 100.0};
    std::vector<Body> bodies;
    for (const double height : {-0.05, 0.02, 0.35}) {
        const bool is_block = height == 0.02;
        Body body = is_block ? test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}))
                             : test::make_body(test::make_block({6, 1, 6}, {0.6, 0.05, 0.6}));
        for (glm::dvec3& p : body.mesh.positions)
            p += glm::dvec3(is_block ? 0.15 : 0.0, height, is_block ? 0.15 : 0.0);
        bodies.push_back(std::move(body));
    }
    bodies[0].pins = {everywhere};
    HandleDescription handle;
    handle.region = everywhere;
    handle.keyframes = {{0.0}, {0.5, {0.0, -0.2, 0.0}}, {1.0}};
    bodies[2].handles = {handle};
    const auto model = std::make_shared<const Model>(pack_bodies(bodies, {}, {0.0, -9.81, 0.0}));
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    const std::uint32_t ram = model->objects[2].nodes.first;
    const auto start = static_cast<double>(model->positions[ram].y);
    double least = start;
    for (int frame = 0; frame < 90; ++frame) {
        test::advance(solver, *model, frame);
        ASSERT_EQ(test::count_overlaps(*model, solver.nodes().positions), 0u) << frame;
        least = std::min(least, static_cast<double>(solver.nodes().positions[ram].y));
    }
    EXPECT_NEAR(least, start - 0.2, 1e-3);  // all the way, which leaves the block half of its height
    EXPECT_GT(cpu::measure(*model, solver.nodes())[1].volume, 0.9 * 0.027);
}

// Violent scenes at random; a few here, more in the long tests.
void fuzz(unsigned first, unsigned count, int most_substeps = 4, int most_iterations = 12) {
    for (unsigned seed = first; seed < first + count; ++seed) {
        test::RandomMaker random(seed);
        const auto model = make_blocks(test::violent_blocks(random, 5), {0, -9.81, 0});
        const int substeps = random.integer(1, most_substeps),
                  iterations = random.integer(1, most_iterations);
        const bool divides_steps = random.integer(0, 1) == 0;
        cpu::SystemSolver<float> solver = make_solver<float>(model, 0.4, iterations, divides_steps);
        const test::BodySums energy = test::sum_bodies(*model, solver.nodes());
        const double most = energy.sum() + 0.2 * energy.kinetic;
        ASSERT_TRUE(test::stays_apart(solver, *model, 20 * substeps, kFrame / substeps, most))
            << "scene " << seed;
    }
}

// Whoever sets nodes from outside may put bodies into each other. Those get no guarantee, but steps end.
TEST(Contacts, GoOnWhereBodiesOverlapAlready) {
    const auto model = make_blocks({{}, {.place = {0.32, 0.05, 0.05}}, {.place = {0.05, 0.32, 0.05}}});
    ASSERT_GT(test::count_overlaps(*model,
                                   std::vector<glm::dvec4>(model->positions.begin(), model->positions.end())),
              0u);
    cpu::SystemSolver<double> solver = make_solver<double>(model);
    for (int frame = 0; frame < 5; ++frame) solver.advance({kFrame});
    for (const glm::dvec4& position : solver.nodes().positions)
        EXPECT_TRUE(std::isfinite(glm::length(position)));
}

TEST(Contacts, NothingPassesThroughAnything) {
    fuzz(1, 3);
}

TEST(ContactsHeavy, NothingPassesThroughAnything) {
    fuzz(4, 9);
    fuzz(205, 1);  // what the guard stopped pressed on and gained energy
    fuzz(1197, 1, 16,
         60);  // a soft body that is torn to twenty times its size, and moved while its map is old
}

// Of so many, one or two that are short of room within a step wait for the next one.
TEST(ContactsHeavy, ManyBodiesPassThroughNothing) {
    test::RandomMaker random(7);
    std::vector<Block> blocks;
    for (int k = 0; k < 240; ++k)
        blocks.push_back({.place = 0.27 * glm::dvec3(k % 6, k / 36, k / 6 % 6),
                          .velocity = random.point(random.magnitude(1.0, 30.0)),
                          .cells = glm::ivec3(2),
                          .size = glm::dvec3(0.2),
                          .youngs_modulus = random.magnitude(1e4, 1e7)});
    const auto model = make_blocks(blocks);
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    const test::BodySums energy = test::sum_bodies(*model, solver.nodes());
    EXPECT_TRUE(test::stays_apart(solver, *model, 20, kFrame, energy.sum()));
}

TEST(ContactsLong, NothingPassesThroughAnything) {
    fuzz(100, 500);
    fuzz(1000, 200, 16, 60);
}

}  // namespace
}  // namespace gelatin
