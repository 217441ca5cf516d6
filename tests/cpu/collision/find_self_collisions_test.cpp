#include "cpu/collision/find_self_collisions.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "cpu/collision/respond_to_self.h"
#include "support/folded.h"

namespace gelatin {
namespace {

using test::Deformation;

constexpr double kSelfStep = 1e-3;  // [s]

std::uint32_t total(const test::SelfContacts& counts) {
    return std::accumulate(counts.begin(), counts.end(), 0u);
}

class SelfCollisionTest : public ::testing::TestWithParam<Deformation> {};
INSTANTIATE_TEST_SUITE_P(Deformations, SelfCollisionTest, ::testing::ValuesIn(test::kDeformations));

TEST_P(SelfCollisionTest, FindsWhatBruteForceFinds) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Model model = test::make_folded(GetParam(), seed);
        const test::SelfContacts expected = test::find_self_contacts_by_brute_force(model);
        EXPECT_EQ(test::find_self_contacts_on_cpu<float>(model), expected);
        EXPECT_EQ(test::find_self_contacts_on_cpu<double>(model), expected);
        const bool touches = GetParam() != Deformation::rigid && GetParam() != Deformation::affine;
        EXPECT_EQ(total(expected) > 20, touches) << total(expected);
    }
}

// Maps of a shape that was, and contacts of another, change nothing.
TEST_P(SelfCollisionTest, FindsTheSameWhateverWasBefore) {
    const Model model = test::make_folded(GetParam());
    const test::SelfContacts expected = test::find_self_contacts_by_brute_force(model);
    for (const Deformation deformation : {Deformation::rigid, Deformation::poked, Deformation::rolled}) {
        const Model before = test::make_folded(deformation);
        EXPECT_EQ(test::find_self_contacts_on_cpu_after<float>(before, model), expected);
        EXPECT_EQ(test::find_self_contacts_on_cpu_after<double>(before, model), expected);
    }
}

// No face of a body that is not deformed, or evenly, is tested, wherever it is.
TEST(FindSelfCollisions, LetsUndeformedBodiesBe) {
    for (const Deformation deformation : {Deformation::rigid, Deformation::affine}) {
        Model model = test::make_folded(deformation);
        for (const float away : {0.0f, 100.0f}) {
            for (glm::vec4& p : model.positions) p.x += away;
            std::size_t restless = 1;
            test::find_self_contacts_on_cpu<float>(model, &restless);
            EXPECT_EQ(restless, 0u);
        }
    }
}

TEST(FindSelfCollisions, BearsWhatIsNotANumber) {
    Model model = test::make_folded(Deformation::rolled);
    const std::uint32_t broken = model.faces[5].a;
    model.positions[broken].y = NAN;
    std::size_t restless = 0;
    const test::SelfContacts counts = test::find_self_contacts_on_cpu<float>(model, &restless);
    EXPECT_EQ(counts[5], 0u);
    EXPECT_GT(restless, 0u);
}

double kinetic_energy(const Model& model, const std::vector<glm::dvec4>& velocities) {
    double energy = 0.0;
    for (std::size_t n = 0; n < velocities.size(); ++n) {
        const auto inverse_mass = static_cast<double>(model.positions[n].w);
        const glm::dvec3 v(velocities[n]);
        if (inverse_mass > 0.0) energy += 0.5 * glm::dot(v, v) / inverse_mass;
    }
    return energy;
}

glm::dvec3 momentum(const Model& model, const std::vector<glm::dvec4>& velocities) {
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < velocities.size(); ++n) {
        const auto inverse_mass = static_cast<double>(model.positions[n].w);
        if (inverse_mass > 0.0) sum += glm::dvec3(velocities[n]) / inverse_mass;
    }
    return sum;
}

TEST(RespondToSelf, KeepsMomentumAndLosesEnergy) {
    for (const Deformation deformation : {Deformation::rolled, Deformation::crushed, Deformation::tangled}) {
        Model model = test::make_folded(deformation);
        for (std::size_t n = 0; n < model.positions.size(); ++n)
            model.positions[n].w = 1.0f / model.masses[n];
        const std::vector<glm::dvec4> before(model.velocities.begin(), model.velocities.end());
        for (const CollisionSettings& settings : {CollisionSettings{.friction = 0.0, .restitution = 1.0},
                                                  CollisionSettings{.friction = 0.5, .restitution = 0.3}}) {
            const auto after = test::respond_to_self_on_cpu<double>(model, settings, kSelfStep).velocities;
            EXPECT_LT(glm::distance(momentum(model, after), momentum(model, before)),
                      1e-13 * glm::length(momentum(model, before)));
            const double energy = kinetic_energy(model, before);
            EXPECT_LT(kinetic_energy(model, after), (settings.restitution < 1.0 ? 0.9999 : 1.0) * energy);
        }
    }
}

TEST(RespondToSelf, LeavesPinnedNodesAndOtherFacesAlone) {
    const Model model = test::make_folded(Deformation::rolled);
    const test::SelfContacts contacts = test::find_self_contacts_on_cpu<double>(model);
    std::vector<bool> touched(model.node_count(), false);
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        if (contacts[f] == 0) continue;
        for (const std::uint32_t n : {model.faces[f].a, model.faces[f].b, model.faces[f].c})
            touched[n] = true;
    }
    const cpu::Nodes<double> after = test::respond_to_self_on_cpu<double>(model, {}, kSelfStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (touched[n] && model.positions[n].w > 0.0f) continue;
        EXPECT_EQ(after.positions[n], glm::dvec4(model.positions[n]));
        EXPECT_EQ(after.velocities[n], glm::dvec4(model.velocities[n]));
    }
}

// Two lumps of 1 and 3 kg that meet head on, and slide past one another.
TEST(RespondToSelf, LumpsPartByTheRestitution) {
    cpu::FaceLump<double> left{
        .mass = 1.0, .velocity = {2, 1, 0}, .displacement = {2e-3, 0, 0}, .normal = {1, 0, 0}};
    cpu::FaceLump<double> right{
        .mass = 3.0, .velocity = {-1, 0, 0}, .displacement = {-1e-3, 0, 0}, .normal = {-1, 0, 0}};
    const cpu::ContactProperties properties{.friction = 0.1, .restitution = 0.5};
    const auto a = cpu::self_response(left, right, properties, 0.01);
    const auto b = cpu::self_response(right, left, properties, 0.01);
    const glm::dvec3 apart = left.velocity + a.velocity - right.velocity - b.velocity;
    EXPECT_NEAR(apart.x, -0.5 * 3.0, 1e-15);
    // Reduced mass 3/4 kg: an impulse of 1.5 x 3 x 3/4 N s, of which friction takes a tenth.
    EXPECT_NEAR(a.velocity.y, -0.1 * 1.5 * 3.0 * 0.75, 1e-15);
    EXPECT_EQ(left.mass * a.velocity, -right.mass * b.velocity);
    EXPECT_NEAR(left.displacement.x + a.displacement.x, right.displacement.x + b.displacement.x, 1e-18);
    EXPECT_NEAR(a.displacement.x, -3e-3 * 0.75, 1e-18);
    right.velocity.x = 2.5;  // they part already
    EXPECT_EQ(cpu::self_response(left, right, properties, 0.01).velocity, glm::dvec3(0.0));
}

TEST(RespondToSelf, GivesTheSameBitsForAnyNumberOfThreads) {
    const Model model = test::make_folded(Deformation::crushed);
    const cpu::Nodes<float> many = test::respond_to_self_on_cpu<float>(model, {}, kSelfStep);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const cpu::Nodes<float> one = test::respond_to_self_on_cpu<float>(model, {}, kSelfStep);
    EXPECT_EQ(one.positions, many.positions);
    EXPECT_EQ(one.velocities, many.velocities);
}

}  // namespace
}  // namespace gelatin
