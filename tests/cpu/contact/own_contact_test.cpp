#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/detect_own.h"
#include "cpu/contact/own_rooms.h"
#include "cpu/contact/pair_course.h"
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

// A bar that was found as it is at the start, and its rooms.
struct FoundBar {
    std::shared_ptr<const Model> model = make_blocks({{.cells = {12, 2, 3}, .size = {1.2, 0.2, 0.3}}});
    std::shared_ptr<const ContactSurface> surface =
        std::make_shared<const ContactSurface>(make_contact_surface(*model, 0.4));
    std::vector<glm::dvec4> positions{model->positions.begin(), model->positions.end()};
    cpu::DetectOwn<double> detection{model, surface};
    cpu::OwnRooms<double> rooms;

    FoundBar() {
        rooms.restart(model, {1});
        detection.run(0, positions, rooms);
    }
    std::vector<glm::dvec4> moved(const auto& move) const {
        std::vector<glm::dvec4> moved = positions;
        for (glm::dvec4& p : moved) p = glm::dvec4(move(glm::dvec3(p)), p.w);
        return moved;
    }
    std::vector<cpu::ContactPair> pairs() const {
        std::vector<cpu::ContactPair> all;
        detection.add_node_pairs(all);
        detection.add_edge_pairs(all);
        return all;
    }
};

glm::dvec3 turned(const glm::dvec3& p, double angle) {
    return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y,
            p.z};
}

// The bar's long axis becomes an arc.
glm::dvec3 bent(const glm::dvec3& p, double curvature) {
    const double angle = curvature * p.x, radius = 1.0 / curvature - p.y;
    return {radius * std::sin(angle), 1.0 / curvature - radius * std::cos(angle), p.z};
}

// The least gap of node and face, and of edges, without a common node and not in the list.
double least_unlisted_gap(const Model& model, const std::vector<cpu::ContactPair>& listed,
                          std::span<const glm::dvec4> positions) {
    const auto is_listed = [&](bool edges, std::uint32_t first, std::uint32_t second) {
        return std::any_of(listed.begin(), listed.end(), [&](const cpu::ContactPair& pair) {
            return pair.is_edges() == edges && pair.first == first && pair.second == second;
        });
    };
    const auto at = [&](std::uint32_t n) { return glm::dvec3(positions[n]); };
    double least = 1e9;
    for (const std::uint32_t n : model.surface_parts.nodes) {
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            const Face& face = model.faces[f];
            if (n == face.a || n == face.b || n == face.c || is_listed(false, n, f)) continue;
            const auto nearest =
                cpu::nearest_points<double>(at(n), std::array{at(face.a), at(face.b), at(face.c)});
            least = std::min(least, glm::length(nearest.apart));
        }
    }
    const auto& edges = model.surface_parts.edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        for (std::uint32_t g = e + 1; g < edges.size(); ++g) {
            const bool touch = edges[e].a == edges[g].a || edges[e].a == edges[g].b ||
                               edges[e].b == edges[g].a || edges[e].b == edges[g].b;
            if (touch || is_listed(true, e, g)) continue;
            const auto nearest = cpu::nearest_points<double>(std::array{at(edges[e].a), at(edges[e].b)},
                                                             std::array{at(edges[g].a), at(edges[g].b)});
            least = std::min(least, glm::length(nearest.apart));
        }
    }
    return least;
}

TEST(OwnRooms, AreNotUsedUpByMotionAndUniformDeformation) {
    const FoundBar bar;
    const auto moved = bar.moved([](const glm::dvec3& p) {
        return turned({1.05 * p.x, 0.95 * p.y + 0.05 * p.x, p.z}, 1.0) + glm::dvec3(3, 4, 5);
    });
    cpu::OwnRooms<double> rooms = bar.rooms;
    EXPECT_GT(rooms.used(0, moved), 10.0);
    rooms.follow(0, rooms.carried(0, moved));
    EXPECT_LT(rooms.used(0, moved), 1e-9);
}

TEST(OwnRooms, AreHardlyUsedUpByBending) {
    const FoundBar bar;
    const auto moved = bar.moved([](const glm::dvec3& p) { return bent(p, 0.4); });
    cpu::OwnRooms<double> rooms = bar.rooms;
    const auto carried = rooms.carried(0, moved);
    rooms.follow(0, carried);
    const double before = rooms.used(0, moved);
    rooms.follow(0, rooms.bent(0, carried, moved));
    EXPECT_GT(before, 1.0);
    EXPECT_LT(rooms.used(0, moved), 0.5 * before);
}

// Of two points anywhere, whatever the map was fitted to, and half way to it.
TEST(OwnRooms, MapsKeepEnoughOfAllDistances) {
    test::RandomMaker random(3);
    for (int round = 0; round < 40; ++round) {
        FoundBar bar;
        const double curvature = random.uniform(0.1, 12.0), shake = random.uniform(0.0, 0.2);
        auto moved = bar.moved([&](const glm::dvec3& p) { return bent(p, curvature) + random.point(shake); });
        if (round % 2 == 0)
            for (glm::dvec4& p : moved) p.x *= random.uniform(0.3, 0.9);
        const auto to = bar.rooms.bent(0, bar.rooms.carried(0, moved), moved);
        const double part = bar.rooms.part_between(0, to);
        for (const double share : {0.5, 1.0}) {
            cpu::OwnRooms<double> rooms = bar.rooms;
            const auto map = rooms.between(0, to, share * part);
            const std::uint32_t count = rooms.places(0).count;
            for (std::uint32_t a = 0; a < count; a += 3) {
                for (std::uint32_t b = a + 1; b < count; b += 2) {
                    const double found = glm::distance(rooms.offset(a), rooms.offset(b));
                    const double now = glm::distance(rooms.mapped(0, map, a), rooms.mapped(0, map, b));
                    ASSERT_GT(now, cpu::OwnRooms<double>::kLeastStretch * found) << round << " " << share;
                }
            }
        }
    }
}

// Each node at random at the edge of its room round where the map has it: nothing meets that is not listed.
TEST(DetectOwn, ListsAllThatCouldMeetWithinItsRooms) {
    test::RandomMaker random(5);
    FoundBar bar;
    // It is folded, so that it is near itself, and found so; then half of its nodes once more.
    const auto folded = bar.moved([](const glm::dvec3& p) { return bent(p, 5.2); });
    bar.positions = folded;
    bar.detection.run(0, bar.positions, bar.rooms);
    EXPECT_GT(bar.pairs().size(), 20u);
    for (int round = 0; round < 5; ++round) {
        std::vector<glm::dvec4> moved = bar.positions;
        const auto next = bar.moved([&](const glm::dvec3& p) { return turned(p, 0.1) + 0.05 * p.x * p; });
        bar.rooms.follow(0, bar.rooms.bent(0, bar.rooms.carried(0, next), next));
        const Range& places = bar.rooms.places(0);
        for (std::uint32_t s = places.first; s < places.end(); ++s) {
            const glm::dvec3 direction = glm::normalize(random.point(1.0) + glm::dvec3(1e-6));
            const glm::dvec3 place = bar.rooms.mapped(0, bar.rooms.map(0), s);
            moved[bar.model->surface_parts.nodes[s]] =
                glm::dvec4(place + bar.rooms.radius(s) * direction, 1.0);
        }
        ASSERT_GT(least_unlisted_gap(*bar.model, bar.pairs(), moved), 0.0) << round;
        std::vector<std::uint32_t> restless;
        for (std::uint32_t s = places.first; s < places.end(); s += 1 + round % 3) restless.push_back(s);
        bar.positions = moved;
        bar.detection.run_again(0, restless, moved, bar.rooms);
        for (const std::uint32_t s : restless)
            ASSERT_LT(
                glm::length(bar.rooms.deviation(s, glm::dvec3(moved[bar.model->surface_parts.nodes[s]]))),
                0.5 * bar.rooms.radius(s) + 0.02);
    }
}

// A pair that turns with its body stays apart, and what passes through another is not taken for apart.
TEST(PairCourse, IsApartAllTheWay) {
    test::RandomMaker random(7);
    int apart = 0, blocked = 0;
    for (int round = 0; round < 4000; ++round) {
        const bool are_edges = round % 2 == 0;
        cpu::ContactPair pair{{0, 1, 2, 3}, {}, 0, 0, 0, 0, are_edges ? 2u : 1u, 0.1f};
        std::array<glm::dvec3, 4> nodes, moved;
        const double angle = random.uniform(0.0, 0.4), noise = random.magnitude(1e-2, 3.0);
        for (std::size_t k = 0; k < 4; ++k) {
            nodes[k] = random.point(1.0);
            moved[k] =
                turned(nodes[k], angle) + glm::dvec3(1, 2, 3) + random.point(round % 8 < 4 ? 0.0 : noise);
        }
        const auto gap = [&](double part) {
            std::array<glm::dvec3, 4> at;
            for (std::size_t k = 0; k < 4; ++k) at[k] = nodes[k] + part * (moved[k] - nodes[k]);
            return glm::length(
                are_edges
                    ? cpu::nearest_points<double>(std::array{at[0], at[1]}, std::array{at[2], at[3]}).apart
                    : cpu::nearest_points<double>(at[0], std::array{at[1], at[2], at[3]}).apart);
        };
        const cpu::PairAim<double> aim{{1, 0, 0}, gap(0.0), 0.5};
        const double part = cpu::part_apart<double>(pair, aim, 0.1, nodes, moved, cpu::Closeness::motion);
        if (round % 8 < 4 && gap(0.0) > 0.1) {
            EXPECT_EQ(part, 1.0) << round;
        }
        if (part < 1.0) {
            ++blocked;
            continue;
        }
        ++apart;
        // By steps that are too short to touch.
        double speed = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
            speed = std::max(speed, glm::length((moved[k] - nodes[k]) - (moved[0] - nodes[0])));
        for (double at = 0.0; at < 1.0;) {
            const double now = gap(at);
            ASSERT_GT(now, 1e-7) << round;
            at += 0.5 * now / std::max(speed, 1e-9);
        }
    }
    EXPECT_GT(apart, 1500);
    EXPECT_GT(blocked, 100);
}

// Both ends of a bar whose middle is pinned go at each other.
TEST(OwnContact, ABarThatFoldsDoesNotPassThroughItself) {
    for (const double speed : {3.0, 20.0}) {
        auto model = std::make_shared<Model>(
            *make_blocks({{.cells = {14, 2, 3}, .size = {1.4, 0.2, 0.3}, .youngs_modulus = 2e4}}));
        for (std::uint32_t n = 0; n < model->node_count(); ++n) {
            const glm::vec4& p = model->positions[n];
            if (std::abs(p.x - 0.7f) > 0.2f)
                model->velocities[n] = glm::vec4(0, float(speed) * std::abs(p.x - 0.7f), 0, 0);
            if (p.x > 0.7f) model->velocities[n].x = -float(speed);
            if (p.x < 0.7f) model->velocities[n].x = float(speed);
        }
        const std::shared_ptr<const Model> shared = model;
        cpu::CpuSolver<float> solver = make_solver<float>(shared);
        const ObjectMeasure start = cpu::measure(*shared, solver.nodes()).front();
        double energy = start.kinetic_energy;
        for (int frame = 0; frame < 60; ++frame) {
            solver.advance_nodes(kFrame);
            ASSERT_EQ(test::count_overlaps(*shared, solver.nodes().positions), 0u)
                << speed << " m/s, frame " << frame;
            const ObjectMeasure now = cpu::measure(*shared, solver.nodes()).front();
            EXPECT_LT(glm::length(now.momentum - start.momentum), 1e-4 * speed * shared->objects[0].mass);
            EXPECT_LT(now.kinetic_energy + now.elastic_energy, energy + 2e-3 * start.kinetic_energy);
            energy = now.kinetic_energy + now.elastic_energy;
        }
    }
}

TEST(OwnContact, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto run = [](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        const auto model = make_blocks({{.velocity = {8, 0, 0}, .youngs_modulus = 1e4},
                                        {.place = {0.34, 0.1, 0.05}, .youngs_modulus = 1e4}});
        cpu::CpuSolver<float> solver = make_solver<float>(model);
        for (int frame = 0; frame < 20; ++frame) solver.advance_nodes(kFrame);
        return solver.nodes().positions;
    };
    EXPECT_EQ(run(1), run(4));
}

// A ball of jelly between two plates, crushed by inertia: at no speed and in no material.
void fuzz_folds(unsigned first, int count) {
    for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
        test::RandomMaker random(seed);
        std::vector<Block> blocks;
        const int bodies = random.integer(1, 2);
        for (int k = 0; k < bodies; ++k)
            blocks.push_back(
                {.place = {0, 0.5 * k, 0},
                 .velocity = random.point(5.0),
                 .cells = {random.integer(6, 14), random.integer(1, 2), random.integer(1, 3)},
                 .size = {random.uniform(0.6, 1.5), random.uniform(0.03, 0.2), random.uniform(0.1, 0.4)},
                 .youngs_modulus = std::pow(10.0, random.uniform(3.0, 7.0)),
                 .poisson_ratio = random.uniform(0.2, 0.45)});
        auto model = std::make_shared<Model>(*make_blocks(blocks, {0, -9.81, 0}));
        const double speed = std::pow(10.0, random.uniform(0.0, 1.8));
        const double wave = random.uniform(2.0, 12.0);
        for (std::uint32_t n = 0; n < model->node_count(); ++n) {
            const glm::vec4& p = model->positions[n];
            const double phase = wave * static_cast<double>(p.x);
            model->velocities[n] +=
                glm::vec4(float(speed * std::cos(phase)), float(speed * std::sin(1.3 * phase)),
                          float(0.3 * speed * std::sin(0.7 * phase)), 0);
        }
        const std::shared_ptr<const Model> shared = model;
        if (test::count_overlaps(*shared, std::vector<glm::vec4>(shared->positions)) > 0) continue;
        cpu::CpuSolver<float> solver = make_solver<float>(shared, random.uniform(0.0, 0.8),
                                                          random.integer(1, 12), random.integer(0, 1) == 1);
        const int substeps = random.integer(1, 4);
        for (int frame = 0; frame < 30; ++frame) {
            for (int k = 0; k < substeps; ++k) solver.advance_nodes(kFrame / substeps);
            ASSERT_EQ(test::count_overlaps(*shared, solver.nodes().positions), 0u)
                << "seed " << seed << ", frame " << frame;
        }
    }
}

TEST(OwnContact, NothingPassesThroughItself) {
    fuzz_folds(1, 12);
}

TEST(OwnContactLong, NothingPassesThroughItself) {
    fuzz_folds(100, 300);
}

}  // namespace
}  // namespace gelatin
