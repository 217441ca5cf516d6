// Gas in hollows against closed forms: how far it inflates, how it swings, what it carries, and what it
// keeps.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gelatin/simulator.h"
#include "support/shells.h"
#include "verify/support/measured_run.h"
#include "verify/support/radial_sphere.h"

namespace gelatin::cavity_test {
namespace {

using namespace test;

constexpr double kAmbient = 101325.0;  // [Pa]

Material rubber(double youngs_modulus, double poisson_ratio, double damping = 0.0) {
    Material material;
    material.name = "rubber";
    material.model = MaterialModel::neo_hookean;
    material.youngs_modulus = youngs_modulus;
    material.poisson_ratio = poisson_ratio;
    material.damping = damping;
    return material;
}

// In flight, without gravity.
Scene scene_of(const std::shared_ptr<const Mesh>& mesh, const Material& material,
               const CavityDescription& cavity) {
    Scene scene;
    scene.simulation.gravity = glm::dvec3(0.0);
    scene.simulation.sleep = false;
    scene.collision.self_collision = false;
    scene.materials = {material};
    ObjectDescription& body = scene.objects.emplace_back();
    body.name = "body";
    body.shape = MeshShape{mesh};
    body.material = material.name;
    body.cavities = {cavity};
    return scene;
}

CavityDescription sealed(double pressure = 0.0, double amount = 1.0) {
    return {.pressure = pressure, .amount = amount};
}
CavityDescription constant(double pressure) {
    return {.law = GasLaw::constant, .pressure = pressure};
}

CavityStatus status(MeasuredRun& run) {
    return run.simulator().cavities()[0];
}

// Mean distance of the nodes from the origin that have this one at rest [m].
double mean_radius(MeasuredRun& run, double at_rest) {
    double sum = 0.0;
    int count = 0;
    const Model& model = run.model();
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (std::abs(glm::length(glm::dvec3(model.positions[n])) - at_rest) > 1e-4) continue;
        sum += glm::length(glm::dvec3(run.simulator().positions()[n]));
        ++count;
    }
    return sum / count;
}

// What the gas and the body have, gravity left out [J].
double energy(MeasuredRun& run) {
    const FrameStatistics now = run.statistics();
    const Cavity& cavity = run.model().cavities[0];
    return now.kinetic_energy + now.elastic_energy +
           cavity.energy(cavity.drive_at(0.0, {}), now.cavities[0].volume);
}

TEST(Cavities, AThickSphereGrowsAsLameSays) {
    const RadialSphere sphere{0.2, 0.3, rubber(1e6, 0.3, 0.05)};
    const double pressure = 2000.0;
    MeasuredRun run(scene_of(sphere_shell(0.2, 0.3, 8, 4), sphere.material, constant(pressure)));
    run.advance(0.5);
    const double growth = sphere.small_growth(pressure);
    EXPECT_NEAR(mean_radius(run, 0.2) - 0.2, growth, 0.02 * growth);
    // The reference of the next test is the same for small strains.
    EXPECT_NEAR(sphere.balance([](double) { return 1.0; })[0] - 0.2, sphere.small_growth(1.0), 1e-10);
}

// At a pressure that as a load stops a run.
TEST(Cavities, ABalloonGrowsAsAThickSphereForLargeStrains) {
    const RadialSphere sphere{0.27, 0.3, rubber(2.5e6, 0.45, 0.02)};
    const auto mesh = sphere_shell(0.27, 0.3, 8, 2);
    const double pressure = 8e4;
    MeasuredRun run(scene_of(mesh, sphere.material, constant(pressure)));
    run.advance(1.0);
    const auto radii = sphere.balance([&](double) { return pressure; });
    EXPECT_GT(radii[0], 1.14 * 0.27);
    EXPECT_NEAR(mean_radius(run, 0.27), radii[0], 0.005 * radii[0]);
    EXPECT_NEAR(mean_radius(run, 0.3), radii[1], 0.005 * radii[1]);

    // Sealed with as much again as is outside.
    MeasuredRun full(scene_of(mesh, sphere.material, sealed(0.0, 2.0)));
    full.advance(1.0);
    const double rest = run.model().cavities[0].rest_volume;
    const auto by_gas = sphere.balance([&](double v) { return kAmbient * (2.0 * rest / v - 1.0); });
    EXPECT_GT(by_gas[0], 1.05 * 0.27);
    EXPECT_NEAR(mean_radius(full, 0.27), by_gas[0], 0.005 * by_gas[0]);
}

// Rayleigh's quotient: w^2 = (k + k_gas) / m for the inner radius, with k = 4 pi a^2 p / u and
// k_gas = (4 pi a^2)^2 p_ambient / V.
TEST(Cavities, ABreathingSphereSwingsOnItsGas) {
    const RadialSphere sphere{0.27, 0.3, rubber(1e6, 0.3)};
    const double area = 4.0 * std::numbers::pi * 0.27 * 0.27, volume = area * 0.27 / 3.0;
    const double stiffness = area / sphere.small_growth(1.0), of_gas = area * area * kAmbient / volume;
    EXPECT_GT(of_gas, stiffness);
    const double frequency = std::sqrt((stiffness + of_gas) / sphere.moving_mass());
    Scene scene = scene_of(sphere_shell(0.27, 0.3, 6, 2), sphere.material, sealed());
    scene.simulation.frame_rate = 1500.0;
    MeasuredRun run(scene);
    std::vector<glm::vec3> velocities;
    for (const glm::vec4& p : run.model().positions) velocities.push_back(glm::normalize(glm::vec3(p)));
    run.simulator().set_velocities(0, velocities);
    const double rest = run.model().cavities[0].rest_volume, start = energy(run);
    std::vector<double> crossings;
    double before = 1.0, most = start;
    while (crossings.size() < 6 && run.simulator().time() < 1.0) {
        run.simulator().advance_frame();
        const double now = status(run).volume - rest;
        if (before < 0.0 && now >= 0.0)
            crossings.push_back(run.simulator().time() - now / (now - before) / 1500.0);
        before = now;
        most = std::max(most, energy(run));
    }
    ASSERT_EQ(crossings.size(), 6u);
    const double period = 2.0 * std::numbers::pi / frequency;
    EXPECT_NEAR(crossings[5] - crossings[0], 5.0 * period, 0.02 * 5.0 * period);
    EXPECT_LT(most, 1.002 * start);
    EXPECT_GT(energy(run), 0.6 * start);
}

double crushed_volume(MeasuredRun& run) {
    double sum = 0.0;
    for (const glm::uvec3& f : run.model().cavities[0].faces) {
        const auto at = [&](std::uint32_t n) { return glm::dvec3(run.simulator().positions()[n]); };
        sum += glm::dot(at(f.x), glm::cross(at(f.y), at(f.z))) / 6.0;
    }
    return sum;
}

// p V = amount (p_ambient + p_0) V_0.
TEST(Cavities, SealedGasKeepsPressureTimesVolume) {
    Scene scene = scene_of(sphere_shell(0.27, 0.3, 5, 1), rubber(1e6, 0.3, 0.02), sealed(-2e4));
    scene.objects[0].cavities[0].keyframes = {{.time = 0.6, .amount = 1.0}, {.time = 0.8, .amount = 1.8}};
    ColliderDescription lid;
    lid.shape = BoxShape{{1.0, 0.2, 1.0}};
    lid.position = {0.0, 0.45, 0.0};
    lid.keyframes = {{0.0}, {0.6, {0.0, -0.35, 0.0}}};
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.34};
    scene.colliders = {lid, floor};
    MeasuredRun run(scene);
    const double start = crushed_volume(run);
    double least = start;
    for (int k = 0; k < 10; ++k) {
        run.advance(0.1);
        const CavityStatus now = status(run);
        const double volume = crushed_volume(run);
        const double amount = std::lerp(1.0, 1.8, std::clamp((run.simulator().time() - 0.6) / 0.2, 0.0, 1.0));
        EXPECT_NEAR(now.volume, volume, 1e-6 * volume);
        EXPECT_NEAR((now.pressure + kAmbient) * volume, amount * (kAmbient - 2e4) * start,
                    1e-5 * kAmbient * start);
        least = std::min(least, volume);
    }
    EXPECT_LT(least, 0.85 * start);
    EXPECT_GT(status(run).pressure, 3e4);
}

TEST(Cavities, KeyframesReachTheirPressure) {
    Scene scene = scene_of(sphere_shell(0.27, 0.3, 4, 1), rubber(2.5e6, 0.45, 0.05), constant(0.0));
    scene.objects[0].cavities[0].keyframes = {{.time = 0.1, .pressure = 1e4}, {.time = 0.4, .pressure = 4e4}};
    MeasuredRun run(scene);
    for (const auto& [time, pressure] : {std::pair(0.05, 1e4), {0.25, 2.5e4}, {1.0, 4e4}}) {
        run.advance(time - run.simulator().time());
        EXPECT_NEAR(status(run).pressure, pressure, 1e-6 * pressure);
    }
    run.simulator().set_cavity(0, {.pressure = 6e4});
    const double before = status(run).volume;
    run.advance(0.5);
    EXPECT_EQ(status(run).pressure, 6e4);
    EXPECT_GT(status(run).volume, 1.04 * before);
    run.simulator().reset();
    run.advance(0.05);
    EXPECT_NEAR(status(run).pressure, 1e4, 1e-2);
}

// Nothing acts on it: it moves on, rotates as fast as its velocities say, and has no more energy than before.
TEST(Cavities, InflatedBodiesKeepWhatTheyHaveInFlight) {
    for (const CavityDescription& cavity : {sealed(8e4), constant(6e4)}) {
        Scene scene = scene_of(sphere_shell(0.27, 0.3, 6, 2), rubber(2.5e6, 0.45, 0.02), cavity);
        MeasuredRun run(scene);
        run.advance(1.0);  // until it is in balance
        std::vector<glm::vec3> velocities;
        const glm::dvec3 spin(0.0, 1.5, 0.0);
        for (const glm::vec4& p : run.simulator().positions())
            velocities.emplace_back(glm::dvec3(0.5, 1.0, -0.3) + glm::cross(spin, glm::dvec3(p)));
        run.simulator().set_velocities(0, velocities);
        const glm::dvec3 momentum = run.momentum(), angular = run.angular_momentum();
        const glm::dquat before = run.simulator().rotation(0);
        const double start = energy(run);
        double most = start;
        for (int k = 0; k < 20; ++k) {
            run.advance(0.05);
            most = std::max(most, energy(run));
        }
        EXPECT_LT(glm::distance(run.momentum(), momentum), 1e-6 * glm::length(momentum));
        EXPECT_LT(glm::distance(run.angular_momentum(), angular), 5e-5 * glm::length(angular));
        const double rotated = glm::angle(run.simulator().rotation(0) * glm::conjugate(before));
        EXPECT_NEAR(rotated, glm::length(spin), 0.03 * glm::length(spin));
        const FrameStatistics now = run.statistics();
        EXPECT_LT(most - start, 0.002 * (now.kinetic_energy + now.elastic_energy));
    }
}

// Of what a start out of shape has, nothing comes back by gas that is not accounted for.
TEST(Cavities, VibrationsHaveNoMoreEnergyThanBefore) {
    Scene scene = scene_of(sphere_shell(0.27, 0.3, 5, 1), rubber(1e6, 0.3), sealed(2e4));
    scene.objects[0].start.scale = {1.2, 0.8, 1.0};
    MeasuredRun run(scene);
    double least = energy(run);
    for (int k = 0; k < 60; ++k) {
        run.simulator().advance_frame();
        const double now = energy(run);
        const FrameStatistics all = run.statistics();
        EXPECT_LT(now - least, 0.004 * (all.kinetic_energy + all.elastic_energy)) << k;
        least = std::min(least, now);
    }
}

// A pressure that falls takes energy from the gas at once: what the body swings with is its own.
TEST(Cavities, VibrationsStayWhenAPressureFalls) {
    Scene scene = scene_of(sphere_shell(0.27, 0.3, 5, 1), rubber(1e6, 0.3), constant(1e4));
    scene.simulation.frame_rate = 600.0;
    MeasuredRun run(scene);
    const auto own = [&] {
        const FrameStatistics now = run.statistics();
        return now.kinetic_energy + now.elastic_energy;
    };
    run.advance(0.01);
    const double before = own();
    run.simulator().set_cavity(0, {.pressure = 0.0});
    run.advance(0.02);
    EXPECT_GT(own(), 0.8 * before);
    EXPECT_LT(own(), 1.01 * before);
}

std::vector<float> positions_after(const Scene& scene, int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
    MeasuredRun run(scene);
    for (int k = 0; k < 40; ++k) run.simulator().advance_frame();
    return run.simulator().read_frame().positions;
}

TEST(Cavities, BitsDoNotDependOnThreads) {
    Scene scene = scene_of(sphere_shell(0.27, 0.3, 6, 2), rubber(1e6, 0.3), sealed(2e4));
    scene.simulation.gravity = glm::dvec3(0.0, -9.81, 0.0);
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].name = "upper";
    scene.objects[1].position = {0.1, 0.65, 0.0};
    scene.colliders.emplace_back().shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.35};
    EXPECT_EQ(positions_after(scene, 1), positions_after(scene, 2));
}

// A ring of tube, as of a tyre.
std::shared_ptr<const Mesh> tube(double radius, double outer, double wall, int around, int across) {
    std::vector<glm::uvec3> faces;
    const auto vertex = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % around) * across + j % across);
    };
    const auto layer = [&](double r) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < around; ++i)
            for (int j = 0; j < across; ++j) {
                const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
                points.emplace_back((radius + r * std::cos(v)) * std::cos(u), r * std::sin(v),
                                    (radius + r * std::cos(v)) * std::sin(u));
            }
        return points;
    };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            faces.emplace_back(vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j));
            faces.emplace_back(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1));
        }
    return make_shell({layer(outer - wall), layer(outer)}, faces);
}

// A thin tube is flattened without being stretched, unlike a sphere. Then its section is two half circles,
// and flat between them by w, where it rests on both plates: 2 w + pi H is its circumference. It carries p w
// for each metre of its length.
TEST(Cavities, ATubeCarriesItsPressureTimesItsPatch) {
    const double radius = 1.6, outer = 0.2, pressure = 1.15e4;
    const int across = 40;
    CavityDescription air = constant(0.0);
    air.keyframes = {{.time = 0.0, .pressure = 0.0}, {.time = 0.3, .pressure = pressure}};
    Scene scene = scene_of(tube(radius, outer, 0.005, 30, across), rubber(2e6, 0.3, 0.05), air);
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, -outer - 0.02};
    ColliderDescription lid;
    lid.shape = BoxShape{{6.0, 0.2, 6.0}};
    lid.position = {0.0, outer + 0.12, 0.0};
    lid.keyframes = {{0.0}, {0.3}, {1.3, {0.0, -0.12, 0.0}}};
    floor.friction = lid.friction = 0.0;
    scene.colliders = {floor, lid};
    MeasuredRun run(scene);
    run.advance(1.8);
    // The section at angle 0, by angles.
    std::vector<std::pair<double, glm::dvec3>> section;
    double low = 1.0, high = -1.0, middle = 0.0;
    int pressed = 0;
    for (std::uint32_t n = 0; n < run.model().node_count(); ++n) {
        const glm::dvec3 rest(run.model().positions[n]), now(run.simulator().positions()[n]);
        const double x = std::hypot(rest.x, rest.z) - radius;
        if (run.model().objects[0].nodes.end() <= n || std::hypot(x, rest.y) < outer - 1e-3) continue;
        low = std::min(low, now.y);
        high = std::max(high, now.y);
        if (std::abs(rest.z) < 1e-4 && rest.x > 0.0) section.emplace_back(std::atan2(rest.y, x), now);
        if (run.simulator().node_contact_forces()[n].y == 0.0f) continue;
        middle += std::hypot(now.x, now.z);
        ++pressed;
    }
    std::sort(section.begin(), section.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    ASSERT_EQ(section.size(), static_cast<std::size_t>(across));
    double circumference = 0.0;
    for (std::size_t k = 0; k < section.size(); ++k)
        circumference += glm::distance(section[k].second, section[(k + 1) % section.size()].second);
    const double width = 0.5 * (circumference - std::numbers::pi * (high - low));
    EXPECT_GT(width, outer);
    const double load = pressure * width * 2.0 * std::numbers::pi * middle / pressed;
    for (const ContactForce& force : run.simulator().contact_forces())
        EXPECT_NEAR(std::abs(force.normal[1]), load, 0.05 * load);
}

// Between two hollows there is a wall, and only the gas of one presses it.
TEST(Cavities, HollowsOfOneBodyHaveGasOfTheirOwn) {
    Scene scene = scene_of(joined(*sphere_shell(0.17, 0.2, 4, 1), *sphere_shell(0.17, 0.2, 4, 1), {1, 0, 0}),
                           rubber(2.5e6, 0.45, 0.05), constant(4e4));
    scene.objects[0].cavities[0].region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.5};
    scene.objects[0].cavities.push_back({.name = "other", .region = HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.5}});
    MeasuredRun run(scene);
    run.advance(0.5);
    const std::vector<CavityStatus> cavities = run.simulator().cavities();
    ASSERT_EQ(cavities.size(), 2u);
    EXPECT_GT(cavities[0].volume, 1.1 * run.model().cavities[0].rest_volume);
    EXPECT_NEAR(cavities[1].volume, run.model().cavities[1].rest_volume, 1e-4 * cavities[1].volume);
    EXPECT_EQ(run.simulator().cavity_index("body", "other"), 1u);
}

}  // namespace
}  // namespace gelatin::cavity_test
