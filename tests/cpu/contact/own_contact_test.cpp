#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <set>
#include <tuple>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/detect_contacts.h"
#include "cpu/contact/detect_own.h"
#include "cpu/contact/guarded_move.h"
#include "cpu/contact/own_gaps.h"
#include "cpu/contact/own_rooms.h"
#include "cpu/measure/measure.h"
#include "model/corners.h"
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
        std::make_shared<const ContactSurface>(make_contact_surface(*model, {.friction = 0.4}));
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

// found(edges, first, second, gap, nodes) for all nodes and faces, and all edges, without a common node.
template <class Found>
void for_all_pairs(const Model& model, std::span<const glm::dvec4> positions, const Found& found) {
    const auto at = [&](std::uint32_t n) { return glm::dvec3(positions[n]); };
    for (const std::uint32_t n : model.surface_parts.nodes) {
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            const Face& face = model.faces[f];
            if (has_corner(face, n)) continue;
            const auto nearest =
                cpu::nearest_points<double>(at(n), std::array{at(face.a), at(face.b), at(face.c)});
            found(false, n, f, glm::length(nearest.apart), std::array{n, face.a, face.b, face.c});
        }
    }
    const auto& edges = model.surface_parts.edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        for (std::uint32_t g = e + 1; g < edges.size(); ++g) {
            const FaceEdge &a = edges[e], &b = edges[g];
            if (share_end(a, b)) continue;
            const auto nearest =
                cpu::nearest_points<double>(std::array{at(a.a), at(a.b)}, std::array{at(b.a), at(b.b)});
            found(true, e, g, glm::length(nearest.apart), std::array{a.a, a.b, b.a, b.b});
        }
    }
}

// Each pair is listed, or the rooms of its nodes are too small to bring it together.
void expect_complete(const FoundBar& bar) {
    std::set<std::tuple<bool, std::uint32_t, std::uint32_t>> listed;
    for (const cpu::ContactPair& pair : bar.pairs()) listed.emplace(pair.is_edges(), pair.first, pair.second);
    std::vector<glm::dvec4> found_at(bar.positions.size());
    for (std::uint32_t s = 0; s < bar.model->surface_parts.nodes.size(); ++s)
        found_at[bar.model->surface_parts.nodes[s]] = glm::dvec4(bar.rooms.offset(s), 0.0);
    constexpr double kPart = cpu::OwnRooms<double>::kRoom;
    std::size_t small = 0;
    for_all_pairs(*bar.model, found_at,
                  [&](bool edges, auto first, auto second, double gap, const auto& nodes) {
                      if (listed.count({edges, first, second}) > 0) return;
                      double most = 0.0;
                      for (const std::uint32_t n : nodes)
                          most = std::max(most, bar.rooms.radius(bar.surface->places[n]));
                      EXPECT_LE(most, (1.0 + 1e-9) * kPart * gap);
                      small += most > 0.9 * kPart * gap ? 1 : 0;
                  });
    EXPECT_GT(small, 100u);  // rooms are not smaller than they need be
}

TEST(OwnRooms, AreNotUsedUpByMotionAndUniformDeformation) {
    const FoundBar bar;
    const auto moved = bar.moved([](const glm::dvec3& p) {
        return turned({1.05 * p.x, 0.95 * p.y + 0.05 * p.x, p.z}, 1.0) + glm::dvec3(3, 4, 5);
    });
    cpu::OwnRooms<double> rooms = bar.rooms;
    EXPECT_GT(rooms.used(0, moved), 10.0);
    rooms.follow(0, rooms.fitted(0, moved));
    EXPECT_LT(rooms.used(0, moved), 1e-9);
}

// Where they hold, nothing is as near as it presses. They hold in affine motions, and for some of what is
// random beside these.
TEST(OwnGaps, HoldWhereNothingPresses) {
    const FoundBar bar;
    const cpu::OwnGaps<double> rooms(bar.model, bar.surface);
    std::map<std::tuple<bool, std::uint32_t, std::uint32_t>, double> at_rest;
    for_all_pairs(*bar.model, bar.positions,
                  [&](bool edges, std::uint32_t a, std::uint32_t b, double gap, const auto&) {
                      at_rest[{edges, a, b}] = gap;
                  });
    test::RandomMaker random(8);
    const double reach = bar.surface->reach(0, 0);
    int held = 0;
    for (int round = 0; round < 30; ++round) {
        glm::dmat3 linear(1.0);
        for (int k = 0; k < 3; ++k) linear[k] += random.point(0.15);
        const glm::dquat turn = glm::normalize(glm::dquat(random.uniform(-1.0, 1.0), random.point(1.0)));
        const double uneven = random.uniform(0.0, 0.03);
        const auto affine = bar.moved([&](const glm::dvec3& p) { return turn * (linear * p); });
        EXPECT_TRUE(rooms.hold(0, affine));
        const auto moved =
            bar.moved([&](const glm::dvec3& p) { return turn * (linear * p + random.point(uneven)); });
        if (!rooms.hold(0, moved)) continue;
        ++held;
        for_all_pairs(*bar.model, moved,
                      [&](bool edges, std::uint32_t a, std::uint32_t b, double gap, const auto&) {
                          ASSERT_GT(gap, std::min(reach, 0.5 * at_rest.at({edges, a, b}))) << round;
                      });
    }
    EXPECT_GT(held, 5);
    EXPECT_LT(held, 25);
    EXPECT_FALSE(
        rooms.hold(0, bar.moved([](const glm::dvec3& p) { return glm::dvec3(p.x, 0.05 * p.y, p.z); })));
    EXPECT_FALSE(rooms.hold(0, bar.moved([](const glm::dvec3& p) { return bent(p, 2.0); })));
}

// Nodes that are looked at again may make the rooms of others smaller, which have used what is gone then.
TEST(OwnRooms, HoldTheirNodesAfterEachLook) {
    const FoundBar bar;
    test::RandomMaker random(5);
    cpu::DetectContacts<double> detection(bar.model, bar.surface);
    for (int round = 0; round < 20; ++round) {
        cpu::ContactList<double> list;
        list.own.restart(bar.model, {1});
        detection.run(bar.positions, {}, list);
        detection.run_own(std::vector<cpu::OwnLook>{{0, {}}}, bar.positions, list);
        cpu::OwnLook look{0, {}};
        std::vector<glm::dvec4> moved = bar.positions;
        for (std::uint32_t s = 0; s < bar.model->surface_parts.nodes.size(); ++s) {
            const double part = random.integer(0, 19) == 0 ? random.uniform(3.0, 30.0) : 0.35;
            const glm::dvec3 motion = part * list.own.radius(s) * glm::normalize(random.point(1.0));
            moved[bar.model->surface_parts.nodes[s]] += glm::dvec4(motion, 0.0);
            if (part > 1.0) look.places.push_back(s);
        }
        detection.run_own(std::span(&look, 1), moved, list);
        EXPECT_LT(list.own.used(0, moved), cpu::OwnRooms<double>::kByNodes);
    }
}

TEST(OwnRooms, AreHardlyUsedUpByBending) {
    const FoundBar bar;
    const auto moved = bar.moved([](const glm::dvec3& p) { return bent(p, 0.4); });
    cpu::OwnRooms<double> rooms = bar.rooms;
    const auto rigid = rooms.moved(0, bar.positions, moved);
    rooms.follow(0, rooms.fitted(0, moved));
    rooms.follow(0, rooms.fitted(0, moved));  // from the first one
    const double after = rooms.used(0, moved);
    rooms.follow(0, rigid);
    const double before = rooms.used(0, moved);
    EXPECT_GT(before, 1.0);
    EXPECT_LT(after, 0.45 * before);
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
        const cpu::ShapeMap<double> to = bar.rooms.fitted(0, moved).map;
        const double part = bar.rooms.part_between(0, to);
        for (const double share : {0.5, 1.0}) {
            cpu::OwnRooms<double> rooms = bar.rooms;
            const auto mapped = rooms.between(0, to, share * part).mapped;
            const std::uint32_t count = rooms.places(0).count;
            for (std::uint32_t a = 0; a < count; a += 3) {
                for (std::uint32_t b = a + 1; b < count; b += 2) {
                    const double found = glm::distance(rooms.offset(a), rooms.offset(b));
                    const double now = glm::distance(mapped[a], mapped[b]);
                    ASSERT_GT(now, cpu::OwnRooms<double>::kLeastKept * 0.98 * found) << round << " " << share;
                }
            }
        }
    }
}

// From the first side's nearest point to the second's.
glm::dvec3 apart(bool edges, const std::array<glm::dvec3, 4>& p) {
    if (edges) return cpu::nearest_points<double>(std::array{p[0], p[1]}, std::array{p[2], p[3]}).apart;
    return cpu::nearest_points<double>(p[0], std::array{p[1], p[2], p[3]}).apart;
}

// With whatever map, nothing that is not listed can meet in the nodes' rooms: not within faces, either.
TEST(OwnRooms, KeepApartWhatIsNotListed) {
    test::RandomMaker random(13);
    double least = 1.0;  // of gaps, over those without deviations
    for (int round = 0; round < 6; ++round) {
        FoundBar bar;
        const double curvature = random.uniform(0.2, 2.0), shake = random.uniform(0.0, 0.02);
        const auto goal =
            bar.moved([&](const glm::dvec3& p) { return bent(p, curvature) + random.point(shake); });
        bar.rooms.follow(0, bar.rooms.fitted(0, goal));
        std::set<std::tuple<bool, std::uint32_t, std::uint32_t>> listed;
        for (const cpu::ContactPair& pair : bar.pairs())
            listed.emplace(pair.is_edges(), pair.first, pair.second);
        std::vector<glm::dvec4> mapped = bar.positions;
        for (std::uint32_t s = 0; s < bar.model->surface_parts.nodes.size(); ++s)
            mapped[bar.model->surface_parts.nodes[s]] =
                glm::dvec4(-bar.rooms.deviation(s, glm::dvec3(0.0)), 1.0);
        for_all_pairs(*bar.model, mapped,
                      [&](bool edges, auto first, auto second, double gap, const auto& nodes) {
                          if (listed.count({edges, first, second}) > 0) return;
                          std::array<glm::dvec3, 4> moved;
                          for (std::size_t k = 0; k < 4; ++k) moved[k] = glm::dvec3(mapped[nodes[k]]);
                          const glm::dvec3 normal = apart(edges, moved) / gap;
                          for (std::size_t k = 0; k < 4; ++k)
                              moved[k] += (k < (edges ? 2u : 1u) ? 1.0 : -1.0) *
                                          bar.rooms.radius(bar.surface->places[nodes[k]]) * normal;
                          const double left = glm::dot(apart(edges, moved), normal);
                          ASSERT_GT(left, 0.0) << round;
                          least = std::min(least, left / gap);
                      });
    }
    EXPECT_LT(least, 0.4);  // rooms are not far smaller than they may be
}

// Of a bar that is folded, so that it is near itself; then of one of whose nodes some are found again.
TEST(DetectOwn, ListsAllThatCouldMeetWithinItsRooms) {
    test::RandomMaker random(5);
    FoundBar bar;
    bar.positions = bar.moved([](const glm::dvec3& p) { return bent(p, 5.2); });
    bar.detection.run(0, bar.positions, bar.rooms);
    EXPECT_GT(bar.pairs().size(), 20u);
    expect_complete(bar);
    for (unsigned round = 0; round < 4; ++round) {
        const Range& places = bar.rooms.places(0);
        std::vector<std::uint32_t> restless;
        for (std::uint32_t s = places.first + round; s < places.end(); s += 9) {
            restless.push_back(s);
            bar.positions[bar.model->surface_parts.nodes[s]] += glm::dvec4(random.point(0.03), 0.0);
        }
        bar.detection.run_again(0, restless, bar.positions, bar.rooms);
        for (const std::uint32_t s : restless)
            EXPECT_LT(glm::length(bar.rooms.deviation(
                          s, glm::dvec3(bar.positions[bar.model->surface_parts.nodes[s]]))),
                      1e-9);
        expect_complete(bar);
    }
}

// Whatever a move wants, a body does not pass through itself: with the list, or without it by its rooms.
TEST(OwnGuard, KeepsBodiesFromThemselves) {
    test::RandomMaker random(11);
    for (int round = 0; round < 10; ++round) {
        FoundBar bar;
        cpu::DetectContacts<double> detection(bar.model, bar.surface);
        cpu::ContactList<double> list;
        list.own.restart(bar.model, {1});
        detection.run(bar.positions, {.longest = 0.5}, list);
        detection.run_own(std::vector<cpu::OwnLook>{{0, {}}}, bar.positions, list);
        cpu::ContactAims<double> aims(bar.model, bar.surface);
        cpu::GuardedMove<double> guard(bar.model, bar.surface->places);
        std::vector<glm::dvec4> starts = bar.positions, targets = bar.positions;
        for (glm::dvec4& target : targets) target.w = 3600.0 / target.w;
        aims.begin(kFrame, targets, starts);
        aims.carry_over({}, list);
        aims.run(list, bar.positions);
        guard.begin(bar.positions);
        const double size = random.magnitude(0.05, 0.5);
        auto ends = bar.moved([&](const glm::dvec3& p) {
            return round % 2 == 0 ? p + random.point(size) : glm::dvec3(p.x, -2.0 * p.y, p.z);
        });
        ASSERT_GT(test::count_overlaps(*bar.model, ends) + std::size_t(round % 2), 0u);
        std::vector<glm::dvec4> positions = bar.positions;
        guard.plan(list, aims, positions, ends, cpu::Closeness::motion);
        guard.go(list, ends, false, positions);
        EXPECT_EQ(test::count_overlaps(*bar.model, positions), 0u) << round;
        EXPECT_LT(list.own.used(0, positions), 1.0 + 1e-9);
    }
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
        cpu::ImplicitSolver<float> solver = make_solver<float>(shared);
        const ObjectMeasure start = cpu::measure(*shared, solver.nodes()).front();
        double energy = start.kinetic_energy;
        for (int frame = 0; frame < 60; ++frame) {
            solver.advance({kFrame});
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
        cpu::ImplicitSolver<float> solver = make_solver<float>(model);
        for (int frame = 0; frame < 20; ++frame) solver.advance({kFrame});
        return solver.nodes().positions;
    };
    EXPECT_EQ(run(1), run(4));
}

// Bars thrown into waves, half of them over a floor, at speeds from 1 to 60 m/s and of 1 kPa to 10 MPa.
template <template <class> class Solver>
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
        std::vector<ColliderDescription> floor;
        if (seed % 2 == 0) floor.push_back({.shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.1}});
        auto model = std::make_shared<Model>(*make_blocks(blocks, {0, -9.81, 0}, floor));
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
        Solver<float> solver = make_solver<float, Solver>(shared, random.uniform(0.0, 0.8),
                                                          random.integer(1, 12), random.integer(0, 1) == 1);
        const int substeps = random.integer(1, 4);
        const test::BodySums energy = test::sum_bodies(*shared, solver.nodes());
        ASSERT_TRUE(test::stays_apart(solver, *shared, 30 * substeps, kFrame / substeps,
                                      energy.sum() + 0.2 * energy.kinetic))
            << "scene " << seed;
    }
}

TEST(OwnContact, NothingPassesThroughItself) {
    fuzz_folds<cpu::ImplicitSolver>(1, 3);
    fuzz_folds<cpu::SystemSolver>(1, 3);
}

TEST(OwnContactHeavy, NothingPassesThroughItself) {
    fuzz_folds<cpu::ImplicitSolver>(4, 9);
    fuzz_folds<cpu::SystemSolver>(4, 9);
}

TEST(OwnContactLong, NothingPassesThroughItself) {
    fuzz_folds<cpu::ImplicitSolver>(100, 300);
    fuzz_folds<cpu::SystemSolver>(100, 300);
}

}  // namespace
}  // namespace gelatin
