// Neo-Hookean bodies against the continuum: patch test, Young's modulus and Poisson's ratio of a pulled bar,
// a bar that hangs under its own weight, and recovery from any start. Quasi-static and in double precision
// but for the last.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "cpu/implicit/system_solver.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "mesh/topology.h"
#include "support/test_models.h"
#include "verify/support/equilibrium.h"

namespace gelatin::neo_hookean_test {
namespace {

constexpr double kYoungsModulus = 1e6;  // [Pa]

// Squares of this edge on all sides, and tets to match.
TetMesh box_of_tets(const glm::dvec3& size, double edge) {
    BoxShape box;
    box.size = size;
    box.segments = glm::ivec3(glm::round(size / edge));
    MesherSettings mesher;
    mesher.quality = 1.5;
    mesher.max_volume = 0.2 * std::pow(edge, 3);
    return tetrahedralise(make_box(box), mesher, "box");
}

Body make_body(const TetMesh& mesh, double poisson_ratio) {
    Material material;
    material.model = MaterialModel::neo_hookean;
    material.youngs_modulus = kYoungsModulus;
    material.poisson_ratio = poisson_ratio;
    return test::make_body(mesh, material);
}

Eigen::Vector3d start_of(const Model& model, std::uint32_t node) {
    const glm::dvec3 p(model.positions[node]);
    return {p.x, p.y, p.z};
}

std::vector<bool> find_boundary(const Model& model) {
    std::vector<bool> result(model.node_count(), false);
    for (const Face& face : model.faces) result[face.a] = result[face.b] = result[face.c] = true;
    return result;
}

// Held at the boundary as a uniform deformation has it, small, large or inside out, the rest of the body
// follows.
TEST(NeoHookeanPatch, AUniformDeformationIsInEquilibrium) {
    const Model model = test::make_model(make_body(box_of_tets({0.5, 0.5, 0.5}, 0.1), 0.4));
    const std::vector<bool> is_boundary = find_boundary(model);
    Eigen::Matrix3d small, large, turned;
    small << 1e-3, 2e-3, 0, -1e-3, -2e-3, 1e-3, 0, 5e-4, 1e-3;
    large << 0.3, 0.2, 0.0, -0.1, -0.2, 0.1, 0.0, 0.3, 0.1;
    turned = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix() -
             Eigen::Matrix3d::Identity();
    for (const Eigen::Matrix3d& change : {small, large, turned}) {
        test::Equilibrium body(model);
        int inside = 0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            inside += is_boundary[n] ? 0 : 1;
            if (!is_boundary[n]) continue;
            const Eigen::Vector3d way = change * start_of(model, n);
            for (int axis = 0; axis < 3; ++axis) body.hold(n, axis, way[axis]);
        }
        ASSERT_GT(inside, 50);
        body.solve();
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            // 0.5 m in single precision
            EXPECT_LT((body.displacement(n) - change * start_of(model, n)).norm(), 1e-7);
        }
    }
}

struct Answer {
    double modulus;  // over the one asked for
    double poisson_ratio;
};

// Pulls a bar apart between smooth plates, a twentieth of its length at a time.
Answer pull_apart(const Model& model, const glm::dvec3& size, double strain) {
    test::Equilibrium bar(model);
    std::vector<std::uint32_t> far_end, side;
    const auto is_at = [](double x, double place) { return std::abs(x - place) < 1e-5; };
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const Eigen::Vector3d p = start_of(model, n);
        if (is_at(p.x(), 0.5 * size.x)) side.push_back(n);
        if (is_at(p.y(), -0.5 * size.y)) bar.hold(n, 1, 0.0);
        if (!is_at(p.y(), 0.5 * size.y)) continue;
        far_end.push_back(n);
        // One corner that stays and one that slides keep it from floating away.
        if (is_at(p.x(), -0.5 * size.x) && is_at(std::abs(p.z()), 0.5 * size.z)) bar.hold(n, 0, 0.0);
        if (is_at(p.x(), -0.5 * size.x) && is_at(p.z(), -0.5 * size.z)) bar.hold(n, 2, 0.0);
    }
    const int steps = 1 + static_cast<int>(strain / 0.05);
    for (int s = 1; s <= steps; ++s) {
        for (const std::uint32_t n : far_end) bar.hold(n, 1, strain * size.y * s / steps);
        bar.solve();
    }
    double force = 0.0, sideways = 0.0;
    for (const std::uint32_t n : far_end) force -= bar.elastic_force(n).y();
    for (const std::uint32_t n : side) sideways += bar.displacement(n).x() / static_cast<double>(side.size());
    return {force / (size.x * size.z) / strain / kYoungsModulus, -sideways / size.x / strain};
}

// A uniform stress is one that linear tets have exactly, at any refinement: what is left is the second order
// in the strain.
TEST(NeoHookeanBar, AnswersWithTheModuliAskedFor) {
    const glm::dvec3 size(0.25, 1.0, 0.25);
    for (const int edges : {2, 4}) {
        const TetMesh mesh = box_of_tets(size, size.x / edges);
        for (const double nu : {0.0, 0.25, 0.4, 0.45}) {
            const Answer answer = pull_apart(test::make_model(make_body(mesh, nu)), size, 1e-4);
            EXPECT_NEAR(answer.modulus, 1.0, 1e-3) << nu;
            EXPECT_NEAR(answer.poisson_ratio, nu, 1e-3) << nu;
        }
    }
}

// Stretched to 1.5 of its length: the force of the energy's own stress with free sides,
//   P = mu (1 - 1 / (I + 1)) s + (lambda (J - 1) - 3/4 mu) t^2,   I = s^2 + 2 t^2,   J = s t^2,
// with the t for which there is none sideways.
TEST(NeoHookeanBar, FollowsItsEnergyAtLargeStretch) {
    const glm::dvec3 size(0.25, 1.0, 0.25);
    const double nu = 0.4, s = 1.5;
    const double shear = kYoungsModulus / (2 * (1 + nu)), lame = 2 * shear * nu / (1 - 2 * nu);
    const double mu = 4.0 / 3.0 * shear, lambda = lame + 5.0 / 6.0 * shear;
    const auto stress = [&](double t, bool along) {
        const double stretch = mu * (1.0 - 1.0 / (s * s + 2 * t * t + 1.0));
        const double pressure = lambda * (s * t * t - 1.0) - 0.75 * mu;
        return along ? stretch * s + pressure * t * t : stretch * t + pressure * s * t;
    };
    double low = 0.5, high = 1.5;
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (low + high);
        (stress(middle, false) < 0.0 ? low : high) = middle;
    }
    const Answer answer =
        pull_apart(test::make_model(make_body(box_of_tets(size, 0.125), nu)), size, s - 1.0);
    EXPECT_NEAR(answer.modulus * kYoungsModulus * (s - 1.0) / stress(low, true), 1.0, 1e-5);
    EXPECT_NEAR(answer.poisson_ratio, (1.0 - low) / (s - 1.0), 1e-5);
}

// A bar of two materials, one behind the other or side by side: E over 1 / mean(1 / E) or mean(E). Where they
// meet, each hinders the other's waist.
double answer_of_two(int axis, double ratio, double second_poisson_ratio) {
    const glm::dvec3 size(0.25, 1.0, 0.25);
    Body body = make_body(box_of_tets(size, size.x / 4), 0.25);
    body.part_materials = {body.material};
    body.part_materials[0].youngs_modulus *= ratio;
    body.part_materials[0].poisson_ratio = second_poisson_ratio;
    for (const glm::uvec4& t : body.mesh.tets) {
        double middle = 0.0;
        for (int k = 0; k < 4; ++k) middle += body.mesh.positions[t[k]][axis];
        body.tet_materials.push_back(middle > 0.0 ? 1u : 0u);
    }
    const double theory = axis == 1 ? 2.0 / (1.0 + 1.0 / ratio) : 0.5 * (1.0 + ratio);
    return pull_apart(test::make_model(body), size, 1e-4).modulus / theory;
}

TEST(NeoHookeanBar, OfTwoMaterialsAnswersAsRecorded) {
    EXPECT_NEAR(answer_of_two(1, 1.0, 0.49), 1.002, 5e-3);
    EXPECT_NEAR(answer_of_two(0, 1.0, 0.49), 1.007, 5e-3);
    EXPECT_NEAR(answer_of_two(1, 10.0, 0.49), 1.030, 5e-3);
    EXPECT_NEAR(answer_of_two(0, 10.0, 0.49), 0.999, 5e-3);
}

// The measured E of a bar that hangs by its upper end, relative to the requested one: it lengthens by rho g
// L^2 / (2 E). The end is also held sideways, which the formula does not include: sides that narrow by nu are
// prevented from doing so there, and the bar is slightly stiffer.
double hang(int edges_across, double poisson_ratio) {
    const double length = 1.0, width = 0.25, gravity = 9.81, density = 1000.0;
    Body body = make_body(box_of_tets({width, length, width}, width / edges_across), poisson_ratio);
    body.material.density = density;
    body.pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.4999 * length}};
    const Model model = test::make_model(body, {0.0, -gravity, 0.0});
    test::Equilibrium bar(model);
    bar.pull_by_gravity();
    bar.solve();
    double sag = 0.0;
    int count = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (model.positions[n].y > -0.4999f * static_cast<float>(length)) continue;
        sag -= bar.displacement(n).y();
        ++count;
    }
    return density * gravity * length * length / (2.0 * kYoungsModulus) / (sag / count);
}

struct Hanging {
    const char* name;
    int edges_across;
    double poisson_ratio;
    double recorded;
};
class NeoHookeanHangingBar : public ::testing::TestWithParam<Hanging> {};
INSTANTIATE_TEST_SUITE_P(
    Recorded, NeoHookeanHangingBar,
    ::testing::Values(Hanging{"nu_0_edges_4", 4, 0.0, 1.0}, Hanging{"nu_25_edges_2", 2, 0.25, 1.018},
                      Hanging{"nu_25_edges_4", 4, 0.25, 1.013}, Hanging{"nu_25_edges_6", 6, 0.25, 1.011},
                      Hanging{"nu_45_edges_2", 2, 0.45, 1.078}, Hanging{"nu_45_edges_4", 4, 0.45, 1.055},
                      Hanging{"nu_45_edges_6", 6, 0.45, 1.047}),
    [](const auto& test) { return test.param.name; });

TEST_P(NeoHookeanHangingBar, AnswersAsRecorded) {
    EXPECT_NEAR(hang(GetParam().edges_across, GetParam().poisson_ratio), GetParam().recorded, 5e-3);
}

// Spheres at 60 steps a second are their own shape again after five seconds (the softest, which swing,
// twenty).
TEST(NeoHookeanRecoveryHeavy, SpheresRecoverFromAnyStart) {
    SphereShape shape;
    shape.radius = 0.2;
    shape.frequency = 4;
    const TetMesh mesh = tetrahedralise(make_sphere(shape), {}, "sphere");
    enum { random, plane, point };
    for (const double nu : {0.25, 0.4}) {
        for (const double modulus : {1e3, 1e6, 1e9}) {
            for (const int start : {random, plane, point}) {
                Body body = make_body(mesh, nu);
                body.material.youngs_modulus = modulus;
                body.material.damping = modulus < 1e4 ? 0.02 : 0.0;
                const auto rest = std::make_shared<const Model>(test::make_model(body, {0.0, -9.81, 0.0}));
                State state{rest->positions, rest->velocities, {}};
                std::mt19937 generator(1);
                std::uniform_real_distribution<float> unit(-0.2f, 0.2f);
                for (glm::vec4& p : state.positions) {
                    const float x = unit(generator), y = unit(generator), z = unit(generator);
                    if (start == random) p = glm::vec4(x, y, z, p.w);
                    if (start == plane) p.y = 0.0f;
                    if (start == point) p = glm::vec4(0.0f, 0.0f, 0.0f, p.w);
                }
                cpu::SystemSolver<float> solver(rest, {}, {20});
                solver.write_state(state);
                const int steps = modulus < 1e4 ? 1200 : 300;
                for (int s = 0; s < steps; ++s) solver.advance({1.0 / 60.0});
                double worst = 0.0;
                for (const glm::uvec2& edge : tet_edges(rest->tets)) {
                    const auto length = [&](const auto& positions) {
                        return glm::distance(glm::dvec3(positions[edge.x]), glm::dvec3(positions[edge.y]));
                    };
                    const double stretch = length(solver.nodes().positions) / length(rest->positions);
                    worst = std::max(worst, std::abs(stretch - 1.0));
                }
                // A random start has a spin, which stays, and stretches the softest by more than a hundredth.
                EXPECT_LT(worst, modulus < 1e4 ? 0.02 : 0.01)
                    << nu << ", " << modulus << " Pa, start " << start;
            }
        }
    }
}

}  // namespace
}  // namespace gelatin::neo_hookean_test
