#include "cpu/contact/contact_aims.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/detect_contacts.h"
#include "cpu/contact/guarded_move.h"
#include "support/overlaps.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// Blocks that nearly touch: turned at random, one beside the other.
Model make_near_blocks(unsigned seed) {
    test::RandomMaker random(seed);
    std::vector<Body> bodies;
    for (int k = 0; k < 3; ++k) {
        Body body = test::make_body(test::make_block({3, 2, 3}, {0.3, 0.2, 0.3}, 0.2, seed + unsigned(k)));
        for (glm::dvec3& p : body.mesh.positions) p += glm::dvec3(0.01 * k, 0.218 * k, -0.02 * k);
        bodies.push_back(std::move(body));
    }
    Model model = pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
    for (glm::vec4& p : model.positions) p += glm::vec4(glm::vec3(random.point(0.007)), 0.0f);
    return model;
}

// Lists, aims and guards of a model's start.
template <class Real>
struct Contact {
    explicit Contact(const Model& of)
        : model(std::make_shared<const Model>(of)),
          surface(std::make_shared<const ContactSurface>(make_contact_surface(of, {.friction = 0.4}))),
          positions(of.positions.begin(), of.positions.end()),
          starts(positions),
          detection(model, surface),
          aims(model, surface),
          guard(model, surface->places) {
        for (std::size_t n = 0; n < positions.size(); ++n) {
            const Real inverse_mass = positions[n].w;
            starts[n].w = Real(0);
            targets.emplace_back(cpu::Vec3<Real>(positions[n]),
                                 inverse_mass > Real(0) ? Real(3600) / inverse_mass : Real(0));
        }
        detection.run(positions, {.longest = 0.5}, list);
        aims.begin(Real(1) / 60, targets, starts);
        aims.carry_over({}, list);
        aims.run(list, positions);
        guard.begin(positions);
    }

    std::shared_ptr<const Model> model;
    std::shared_ptr<const ContactSurface> surface;
    std::vector<cpu::Vec4<Real>> positions, starts, targets;
    cpu::DetectContacts<Real> detection;
    cpu::ContactList<Real> list;
    cpu::ContactAims<Real> aims;
    cpu::GuardedMove<Real> guard;
};

using Key = std::tuple<bool, std::uint32_t, std::uint32_t>;

// Distances of all nodes and faces, and all edges, of different bodies.
template <class Found>
void for_all_pairs(const Model& model, const std::vector<cpu::Vec4<double>>& x, const Found& found) {
    const auto objects = objects_of_nodes(model);
    const auto at = [&](std::uint32_t n) { return glm::dvec3(x[n]); };
    for (const std::uint32_t n : model.surface_parts.nodes) {
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            const Face& face = model.faces[f];
            if (face.object == objects[n]) continue;
            const auto nearest =
                cpu::nearest_points<double>(at(n), std::array{at(face.a), at(face.b), at(face.c)});
            found(Key{false, n, f}, std::sqrt(nearest.squared_distance),
                  std::vector{n, face.a, face.b, face.c});
        }
    }
    const auto& edges = model.surface_parts.edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        for (std::uint32_t f = e + 1; f < edges.size(); ++f) {
            if (edges[e].object == edges[f].object) continue;
            const auto nearest = cpu::nearest_points<double>(std::array{at(edges[e].a), at(edges[e].b)},
                                                             std::array{at(edges[f].a), at(edges[f].b)});
            found(Key{true, e, f}, std::sqrt(nearest.squared_distance),
                  std::vector{edges[e].a, edges[e].b, edges[f].a, edges[f].b});
        }
    }
}

// Every pair is listed, or its nodes' rooms are too small to bring it together.
TEST(ContactAims, ListsAllThatCouldMeetWithinItsRooms) {
    std::size_t listed = 0, loose = 0;
    for (unsigned seed = 1; seed < 6; ++seed) {
        Contact<double> contact(make_near_blocks(seed));
        std::set<Key> pairs;
        for (const cpu::ContactPair& pair : contact.list.pairs)
            EXPECT_TRUE(pairs.insert(Key{pair.is_edges(), pair.first, pair.second}).second);
        listed += pairs.size();
        for_all_pairs(*contact.model, contact.positions,
                      [&](const Key& key, double distance, const std::vector<std::uint32_t>& nodes) {
                          if (pairs.count(key) != 0) return;
                          ++loose;
                          double first = 0.0, second = 0.0;
                          const std::size_t split = std::get<0>(key) ? 2 : 1;
                          for (std::size_t k = 0; k < 4; ++k) {
                              const double room = contact.list.rooms[contact.surface->places[nodes[k]]];
                              double& side = k < split ? first : second;
                              side = std::max(side, room);
                          }
                          EXPECT_LT(first + second, distance);
                      });
    }
    EXPECT_GT(listed, 1000u);
    EXPECT_GT(loose, 10000u);
}

// Whatever nodes want, by the limits of each alone no face comes to pass another.
template <class Real>
void expect_limits_hold() {
    for (unsigned seed = 1; seed < 9; ++seed) {
        Contact<Real> contact(make_near_blocks(seed));
        ASSERT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u);
        test::RandomMaker random(seed);
        const auto before = contact.positions;
        double longest = 0.0;
        for (int pass = 0; pass < 12; ++pass) {
            for (std::uint32_t n = 0; n < contact.positions.size(); ++n) {
                const cpu::Vec3<Real> from(contact.positions[n]);
                cpu::Vec3<Real> to = from + cpu::Vec3<Real>(random.point(0.03));
                // To the faces between the blocks, from both sides.
                const bool is_lower = from.y < Real(0.209) || (from.y > Real(0.32) && from.y < Real(0.427));
                to.y += Real(is_lower ? 0.03 : -0.03);
                cpu::NodeTerms<Real> terms;
                terms.hessian.add_identity(Real(1e12));  // contacts do not hold it
                terms.force = Real(1e12) * (to - from);
                if (contact.aims.nodes().presses(n)) contact.aims.nodes().add(n, from, terms);
                const cpu::Vec3<Real> end = contact.aims.nodes().limited(contact.list, n, from, to, terms);
                contact.positions[n] = cpu::Vec4<Real>(end, contact.positions[n].w);
            }
            EXPECT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u)
                << seed;
            if (pass % 2 == 1) contact.aims.run(contact.list, contact.positions);
        }
        for (const std::uint32_t n : contact.model->surface_parts.nodes)
            longest = std::max(longest, double(glm::distance(cpu::Vec3<Real>(contact.positions[n]),
                                                             cpu::Vec3<Real>(before[n]))));
        EXPECT_GT(longest, contact.surface->reach(0, 1));  // they do move
    }
}

TEST(ContactAims, KeepsNodesApart) {
    expect_limits_hold<double>();
    expect_limits_hold<float>();
}

// A small block above a large one.
Model make_block_above(double gap, double x = 0.4) {
    std::vector<Body> bodies{test::make_body(test::make_block({1, 1, 1}, {1, 1, 1})),
                             test::make_body(test::make_block({1, 1, 1}, {0.2, 0.2, 0.2}))};
    for (glm::dvec3& p : bodies[1].mesh.positions) p += glm::dvec3(x, 1.0 + gap, 0.3);
    return pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
}

// Both use what they may of the gap, which leaves what nobody may use.
TEST(ContactAims, DividesTheGap) {
    constexpr double kGap = 0.01;
    Contact<double> contact(make_block_above(kGap));
    for (std::uint32_t n = 0; n < contact.positions.size(); ++n) {
        const glm::dvec3 from(contact.positions[n]);
        const double way = n < contact.model->objects[1].nodes.first ? 0.025 : -0.025;
        cpu::NodeTerms<double> terms;
        terms.hessian.add_identity(1e12);
        terms.force.y = 1e12 * way;
        const glm::dvec3 end =
            contact.aims.nodes().limited(contact.list, n, from, from + glm::dvec3(0.0, way, 0.0), terms);
        contact.positions[n] = glm::dvec4(end, contact.positions[n].w);
    }
    double top = 0.0, low = 2.0;
    for (std::uint32_t n = 0; n < contact.positions.size(); ++n) {
        const double y = contact.positions[n].y;
        if (n < contact.model->objects[1].nodes.first) {
            top = std::max(top, y);
        } else {
            low = std::min(low, y);
        }
    }
    EXPECT_GT(top, 1.0);
    EXPECT_LT(low, 1.0 + kGap);
    EXPECT_NEAR(low - top, 0.05 * kGap + 0.95 * 0.02 * contact.surface->reach(0, 1), 1e-6);
    EXPECT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u);
    // A move by what is left, and more, is seen, though the aim tells the whole gap.
    auto ends = contact.positions;
    for (std::uint32_t n = 0; n < ends.size(); ++n)
        ends[n].y += n < contact.model->objects[1].nodes.first ? 0.0 : -0.004;
    contact.guard.plan(contact.list, contact.aims, contact.positions, ends, cpu::Closeness::motion);
    contact.guard.go(contact.list, ends, false, contact.positions);
    EXPECT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u);
}

// Where bodies would be that fly up to `farthest` [m] and are deformed.
std::vector<glm::vec4> random_ends(const Contact<float>& contact, double farthest,
                                   test::RandomMaker& random) {
    auto ends = contact.positions;
    for (const ModelObject& object : contact.model->objects) {
        const glm::vec3 motion(random.point(farthest));
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
            ends[n] += glm::vec4(motion + glm::vec3(random.point(0.02)), 0.0f);
    }
    return ends;
}

// Bodies that fly through each other stop; what an island has in common it keeps, however far.
TEST(GuardedMove, KeepsBodiesApart) {
    for (unsigned seed = 1; seed < 9; ++seed) {
        Contact<float> contact(make_near_blocks(seed));
        test::RandomMaker random(seed);
        auto ends = random_ends(contact, 0.3, random);
        contact.guard.plan(contact.list, contact.aims, contact.positions, ends, cpu::Closeness::motion);
        const auto momentum = [&](const std::vector<glm::vec4>& at) {
            glm::dvec3 sum(0.0);
            for (std::size_t n = 0; n < at.size(); ++n)
                sum += static_cast<double>(contact.model->masses[n]) *
                       glm::dvec3(at[n] - contact.model->positions[n]);
            return sum;
        };
        contact.guard.go(contact.list, ends, true, contact.positions);
        EXPECT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u);
        double mass = 0.0;
        for (const float m : contact.model->masses) mass += static_cast<double>(m);
        EXPECT_LT(glm::length(momentum(contact.positions) - momentum(ends)), 1e-6 * mass)
            << "of an island that may move so far";
    }
}

// Nodes of blocks that fly through each other, each for itself, and of some objects less than they could.
TEST(GuardedMove, KeepsNodesApart) {
    for (unsigned seed = 1; seed < 9; ++seed) {
        Contact<float> contact(make_near_blocks(seed));
        test::RandomMaker random(seed);
        auto ends = random_ends(contact, 0.02, random);
        contact.guard.plan(contact.list, contact.aims, contact.positions, ends, cpu::Closeness::guess,
                           cpu::Movers::nodes);
        std::size_t whole = 0;
        for (std::size_t n = 0; n < ends.size(); ++n) whole += contact.guard.part(n) == 1.0f ? 1 : 0;
        EXPECT_GT(whole, ends.size() / 6);  // some are in the way of others, the rest go on
        EXPECT_LT(whole, ends.size());
        const std::vector<float> parts{float(random.uniform(0, 1)), 1.0f, float(random.uniform(0, 1))};
        contact.guard.shorten(contact.list, contact.aims, contact.positions, ends, parts);
        contact.guard.go(contact.list, ends, false, contact.positions);
        EXPECT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u)
            << seed;
    }
}

TEST(GuardedMove, LeavesHeldNodesToTheirObjects) {
    Model model = make_near_blocks(1);
    for (const std::size_t n : {std::size_t(0), std::size_t(1), model.positions.size() - 1})
        model.positions[n].w = 0.0f;
    Contact<float> contact(model);
    auto ends = contact.positions;
    for (glm::vec4& p : ends) p += glm::vec4(0.0f, 0.001f, 0.0f, 0.0f);
    for (const bool are_nodes : {true, false}) {
        auto moved = contact.positions;
        contact.guard.plan(contact.list, contact.aims, moved, ends, cpu::Closeness::guess,
                           are_nodes ? cpu::Movers::nodes : cpu::Movers::objects);
        contact.guard.go(contact.list, ends, false, moved);
        for (std::size_t n = 0; n < moved.size(); ++n) {
            if (moved[n].w > 0.0f) continue;
            EXPECT_EQ(moved[n] == contact.positions[n], are_nodes) << n;
        }
    }
}

// More room helps what leaves its room, not what another body is in the way of.
TEST(GuardedMove, AsksForRoomWhereThatHelps) {
    Contact<float> contact(make_block_above(0.01));
    const auto plan = [&](float way) {
        auto ends = contact.positions;
        for (std::size_t n = contact.model->objects[1].nodes.first; n < ends.size(); ++n) ends[n].y += way;
        return contact.guard.plan(contact.list, contact.aims, contact.positions, ends, cpu::Closeness::guess);
    };
    EXPECT_TRUE(plan(-0.5f));
    EXPECT_LT(contact.guard.part(1), 0.9f);
    EXPECT_TRUE(plan(0.015f));
    EXPECT_EQ(contact.guard.part(1), 1.0f);
    EXPECT_FALSE(plan(0.5f));
    EXPECT_LT(contact.guard.part(1), 0.9f);
}

// A plan that rooms end is not made if another detection can follow.
TEST(GuardedMove, LooksNoFurtherThanAtRoomsUnlessItIsFinal) {
    Contact<float> contact(make_block_above(0.01));
    const auto far_apart = [&](float way, bool is_final) {
        auto ends = contact.positions;
        for (std::size_t n = contact.model->objects[1].nodes.first; n < ends.size(); ++n) ends[n].y += way;
        const bool is_free = contact.guard.plan(contact.list, contact.aims, contact.positions, ends,
                                                cpu::Closeness::guess, cpu::Movers::objects, {}, is_final);
        return std::pair(is_free, contact.guard.lacks_room());
    };
    EXPECT_EQ(far_apart(-0.5f, false), std::pair(false, true));
    EXPECT_EQ(far_apart(-0.5f, true), std::pair(true, true));
    EXPECT_EQ(far_apart(-0.012f, false), std::pair(true, false));  // in its room, but another is in the way
    EXPECT_LT(contact.guard.part(1), 1.0f);
}

// Of more pairs than a thread takes at a time, every third is not listed any more.
TEST(ContactAims, CarryOverTheGripsOfPairsThatStayListed) {
    std::vector<Body> plates(2, test::make_body(test::make_block({12, 1, 12}, {1.2, 0.1, 1.2})));
    for (glm::dvec3& p : plates[1].mesh.positions) p += glm::dvec3(0.03, 0.103, 0.04);
    Contact<float> contact(pack_bodies(plates, {}, {0.0, 0.0, 0.0}));
    ASSERT_GT(contact.list.pairs.size(), 2000u);
    const glm::vec4* first = contact.positions.data();
    std::vector<glm::vec4> moved = contact.positions;  // each pair slips by its own
    for (std::size_t n = contact.model->objects[1].nodes.first; n < moved.size(); ++n)
        moved[n].x += 1e-4f * (1.0f + first[n].x + 3.0f * first[n].z);
    contact.aims.end(contact.list, moved);
    const std::vector<cpu::ContactPair> old = contact.list.pairs;
    const auto key = [](const cpu::ContactPair& pair) {
        return std::tuple(pair.is_edges(), pair.first, pair.second);
    };
    contact.aims.run(contact.list, moved, cpu::AimFor::guess);
    std::map<Key, glm::vec3> held;
    for (const cpu::Press<float>& press : contact.aims.presses())
        if (press.grip.grips) held[key(old[press.pair])] = press.grip.held;
    ASSERT_GT(held.size(), 100u);

    std::size_t p = 0;
    std::erase_if(contact.list.pairs, [&](const cpu::ContactPair&) { return p++ % 3 == 0; });
    contact.list.first_edges -= (contact.list.first_edges + 2) / 3;
    contact.aims.carry_over(old, contact.list);
    contact.aims.run(contact.list, moved, cpu::AimFor::guess);
    std::size_t kept = 0;
    for (const cpu::Press<float>& press : contact.aims.presses()) {
        const auto before = held.find(key(contact.list.pairs[press.pair]));
        if (before == held.end()) continue;
        ++kept;
        EXPECT_TRUE(press.grip.grips);
        EXPECT_EQ(press.grip.held, before->second);
    }
    EXPECT_GT(kept, held.size() / 2);
    EXPECT_LT(kept, held.size());
}

// They have no planes.
TEST(ContactAims, LetNothingMoveThatWasAimedForAGuess) {
    Contact<float> contact(make_block_above(0.01));
    const auto count_moved = [&] {
        std::size_t moved = 0;
        for (const std::uint32_t n : contact.model->surface_parts.nodes) {
            const glm::vec3 from(contact.positions[n]), to = from + glm::vec3(1e-5f, 0.0f, 0.0f);
            moved += contact.aims.nodes().limited(contact.list, n, from, to, {}) != from ? 1 : 0;
        }
        return moved;
    };
    EXPECT_EQ(count_moved(), contact.model->surface_parts.nodes.size());
    const std::vector<cpu::PairAim<float>> before = contact.aims.aims();
    contact.aims.run(contact.list, contact.positions, cpu::AimFor::guess);
    EXPECT_EQ(count_moved(), 0u);
    ASSERT_EQ(contact.aims.aims().size(), before.size());
    for (std::size_t p = 0; p < before.size(); ++p) EXPECT_EQ(contact.aims.aims()[p].gap, before[p].gap);
    contact.aims.run(contact.list, contact.positions);
    EXPECT_EQ(count_moved(), contact.model->surface_parts.nodes.size());
}

// What was above at the aim and is beside now is not separated along the direction of the aim any more.
TEST(GuardedMove, FindsAnotherDirectionThanThatOfAnOldAim) {
    Contact<float> contact(make_block_above(0.01, 0.995));
    auto ends = contact.positions;
    for (std::size_t n = contact.model->objects[1].nodes.first; n < ends.size(); ++n) {
        contact.positions[n] += glm::vec4(0.008f, -0.015f, 0.0f, 0.0f);
        ends[n] = contact.positions[n] - glm::vec4(0.02f, 0.0f, 0.0f, 0.0f);
    }
    ASSERT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u);
    ASSERT_GT(test::count_overlaps(*contact.model, ends, test::Overlaps::between), 0u);
    contact.guard.plan(contact.list, contact.aims, contact.positions, ends, cpu::Closeness::guess);
    contact.guard.go(contact.list, ends, false, contact.positions);
    EXPECT_EQ(test::count_overlaps(*contact.model, contact.positions, test::Overlaps::between), 0u);
}

TEST(GuardedMove, DoesNotStopWhatFliesTogether) {
    Contact<float> contact(make_near_blocks(1));
    auto ends = contact.positions;
    for (glm::vec4& p : ends) p += glm::vec4(0.02f, -0.01f, 0.03f, 0.0f);
    EXPECT_TRUE(
        contact.guard.plan(contact.list, contact.aims, contact.positions, ends, cpu::Closeness::guess));
    contact.guard.go(contact.list, ends, false, contact.positions);
    for (std::size_t n = 0; n < ends.size(); ++n)
        EXPECT_LT(glm::distance(glm::vec3(ends[n]), glm::vec3(contact.positions[n])), 1e-6f);
}

}  // namespace
}  // namespace gelatin
