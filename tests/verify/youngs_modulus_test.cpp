// Bodies have the requested Young's modulus, and Poisson's ratio 1/4. A bar pulled at its ends between smooth
// plates, with free sides, has uniform stress, E = (force / area) / (stretch / length). Measured on the
// packed model, at rest, to first order. The paper's springs are measured too, to show what the fit gains.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/explicit/stability.h"
#include "support/test_models.h"
#include "verify/support/statics.h"

namespace gelatin::youngs_modulus_test {
namespace {

constexpr double kYoungsModulus = 2e5;  // [Pa]
constexpr SpringKinds kStructural{true, false, false};

// Squares of an edge `size` / `across` on all sides, and tets to match.
TetMesh box_of_tets(const glm::dvec3& size, double edge) {
    BoxShape box;
    box.size = size;
    box.segments = glm::ivec3(glm::round(size / edge));
    MesherSettings mesher;
    mesher.quality = 1.5;
    mesher.max_volume = 0.2 * std::pow(edge, 3);
    return tetrahedralise(make_box(box), mesher, "box");
}

Model model_of(const TetMesh& mesh, const std::optional<SpringKinds>& springs, double poisson_ratio = 0.25) {
    Material material;
    material.youngs_modulus = kYoungsModulus;
    material.poisson_ratio = poisson_ratio;
    material.springs = springs;
    return test::make_model(test::make_body(mesh, material));
}

struct Answer {
    double modulus;  // over the one asked for
    double poisson_ratio;
};

// Pulls a box of this size apart along `axis`.
Answer pull_apart(const Model& model, const glm::dvec3& size, int axis) {
    constexpr double kStrain = 1e-3;
    test::Statics statics(model);
    std::vector<std::uint32_t> far_end;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double x = static_cast<double>(model.positions[n][axis]);
        if (std::abs(x + 0.5 * size[axis]) < 1e-5) statics.hold(n, axis, 0.0);
        if (std::abs(x - 0.5 * size[axis]) > 1e-5) continue;
        statics.hold(n, axis, kStrain * size[axis]);
        far_end.push_back(n);
    }
    statics.solve();
    double force = 0.0;
    for (const std::uint32_t n : far_end) force -= statics.elastic_force(n)[axis];
    const double area = size.x * size.y * size.z / size[axis];
    const Eigen::Matrix3d strain = statics.mean_strain();
    const double sideways = 0.5 * (strain.trace() - strain(axis, axis));
    return {force / area / kStrain / kYoungsModulus, -sideways / strain(axis, axis)};
}

struct Refinement {
    const char* name;
    int edges_across;
    double modulus_bound;  // of |E_out / E_in - 1|
    double poisson_bound;  // of |nu - 1/4|
    double structural;     // E_out / E_in with structural springs alone
};

class PulledBar : public ::testing::TestWithParam<Refinement> {
protected:
    void measure() const {
        const glm::dvec3 size(0.25, 1.0, 0.25);
        const TetMesh mesh = box_of_tets(size, size.x / GetParam().edges_across);
        const Answer fitted = pull_apart(model_of(mesh, std::nullopt), size, 1);
        const Answer structural = pull_apart(model_of(mesh, kStructural), size, 1);
        EXPECT_NEAR(fitted.modulus, 1.0, GetParam().modulus_bound);
        EXPECT_NEAR(fitted.poisson_ratio, 0.25, GetParam().poisson_bound);
        EXPECT_NEAR(structural.modulus, GetParam().structural, 0.02);
    }
};
class PulledBarLong : public PulledBar {};

INSTANTIATE_TEST_SUITE_P(Refined, PulledBar,
                         ::testing::Values(Refinement{"edges_2", 2, 0.03, 0.02, 0.664},
                                           Refinement{"edges_4", 4, 0.02, 0.02, 0.765},
                                           Refinement{"edges_6", 6, 0.02, 0.01, 0.839}),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Refined, PulledBarLong,
                         ::testing::Values(Refinement{"edges_12", 12, 0.01, 0.005, 0.886}),
                         [](const auto& test) { return test.param.name; });

TEST_P(PulledBar, AnswersWithTheModulusAskedFor) {
    measure();
}
TEST_P(PulledBarLong, AnswersWithTheModulusAskedFor) {
    measure();
}

// With the volume term, which is averaged over nodes.
TEST(PoissonsRatioHeavy, IsWhatWasAskedFor) {
    const glm::dvec3 size(0.25, 1.0, 0.25);
    for (const int edges_across : {4, 6}) {
        const TetMesh mesh = box_of_tets(size, size.x / edges_across);
        for (const double poisson_ratio : {0.0, 0.1, 0.4, 0.45, 0.49}) {
            SCOPED_TRACE(testing::Message() << edges_across << " edges across, " << poisson_ratio);
            const Answer answer = pull_apart(model_of(mesh, std::nullopt, poisson_ratio), size, 1);
            RecordProperty(fmt::format("across_{}_nu_{}", edges_across, poisson_ratio),
                           fmt::format("{:.3f} {:.3f}", answer.modulus, answer.poisson_ratio));
            // What a negative kappa takes away is felt at the surface of a coarse mesh.
            const double bound = poisson_ratio < 0.25 ? 0.3 / edges_across : 0.02;
            EXPECT_NEAR(answer.modulus, 1.0, bound + 0.01);
            EXPECT_NEAR(answer.poisson_ratio, poisson_ratio, bound);
        }
    }
}

TEST(YoungsModulus, IsTheSameInThreeDirections) {
    const glm::dvec3 size(1.0, 0.8, 0.6);
    const TetMesh irregular = box_of_tets(size, 0.1);
    TetMesh regular = test::make_block({10, 8, 6}, size);
    for (glm::dvec3& p : regular.positions) p -= 0.5 * size;
    for (const TetMesh* mesh : {&irregular, static_cast<const TetMesh*>(&regular)}) {
        SCOPED_TRACE(mesh == &regular ? "regular" : "irregular");
        const Model model = model_of(*mesh, std::nullopt);
        for (int axis = 0; axis < 3; ++axis) {
            const Answer answer = pull_apart(model, size, axis);
            EXPECT_NEAR(answer.modulus, 1.0, 0.02) << "axis " << axis;
            EXPECT_NEAR(answer.poisson_ratio, 0.25, 0.02) << "axis " << axis;
        }
    }
}

// Whatever its shape, a body under uniform stress at its boundary has uniform strain. Pulled along
// `direction`.
Answer pull_at_boundary(const Model& model, const Eigen::Vector3d& direction) {
    test::Statics statics(model);
    for (const Face& face : model.faces) {
        const auto corner = [&](std::uint32_t n) {
            const glm::dvec3 p(model.positions[n]);
            return Eigen::Vector3d(p.x, p.y, p.z);
        };
        const Eigen::Vector3d a = corner(face.a), b = corner(face.b), c = corner(face.c);
        const Eigen::Vector3d force = direction * direction.dot((b - a).cross(c - a)) / 6.0;
        for (const std::uint32_t n : {face.a, face.b, face.c}) statics.pull(n, kYoungsModulus * 1e-3 * force);
    }
    statics.solve();
    const Eigen::Matrix3d strain = statics.mean_strain();
    const double along = direction.dot(strain * direction);
    return {1e-3 / along, -0.5 * (strain.trace() - along) / along};
}

void expect_isotropic(const TetMesh& mesh, double modulus_bound, double poisson_bound) {
    const Model model = model_of(mesh, std::nullopt);
    for (const Eigen::Vector3d& along : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                                         Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 2, -2)}) {
        const Answer answer = pull_at_boundary(model, along.normalized());
        EXPECT_NEAR(answer.modulus, 1.0, modulus_bound) << along.transpose();
        EXPECT_NEAR(answer.poisson_ratio, 0.25, poisson_bound) << along.transpose();
    }
}

TEST(YoungsModulus, HoldsForSpheres) {
    SphereShape sphere;
    sphere.frequency = 12;
    expect_isotropic(tetrahedralise(make_sphere(sphere), {}, "sphere"), 0.02, 0.02);
}

TEST(YoungsModulus, HoldsForText) {
    TextShape text;
    text.text = "J";
    text.size = 8;
    text.depth = 2.5;
    MesherSettings mesher;
    mesher.quality = 1.8;
    mesher.max_volume = 0.02;
    expect_isotropic(tetrahedralise(make_text(text), mesher, "text"), 0.06, 0.04);
}

// What springs miss to balance each other under a uniform strain is what makes a body soft.
TEST(YoungsModulus, UniformStrainIsNearerToEquilibriumThanWithStructuralSprings) {
    const TetMesh mesh = box_of_tets({0.5, 0.5, 0.5}, 0.1);
    const auto unbalance = [&](const std::optional<SpringKinds>& kinds) {
        const Model model = model_of(mesh, kinds);
        std::vector<glm::dvec3> force(model.node_count(), glm::dvec3(0.0));
        std::vector<bool> inside(model.node_count(), true);
        for (const Face& f : model.faces) inside[f.a] = inside[f.b] = inside[f.c] = false;
        for (const Spring& s : model.springs) {
            const glm::dvec3 d = glm::dvec3(model.positions[s.j]) - glm::dvec3(model.positions[s.i]);
            const glm::dvec3 pull =
                static_cast<double>(s.stiffness) * d.x * d.x / glm::dot(d, d) * d;  // strain xx
            force[s.i] += pull;
            force[s.j] -= pull;
        }
        double sum = 0.0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n)
            sum += inside[n] ? glm::dot(force[n], force[n]) : 0.0;
        return std::sqrt(sum);
    };
    EXPECT_LT(unbalance(std::nullopt), 0.45 * unbalance(kStructural));
}

TEST(YoungsModulus, FittedSpringsAllowLongerStepsThanStructuralOnes) {
    const TetMesh mesh = box_of_tets({0.5, 0.5, 0.5}, 0.1);
    const auto step = [&](const std::optional<SpringKinds>& kinds) {
        return largest_stable_step(SolverKind::semi_implicit_euler, model_of(mesh, kinds));
    };
    EXPECT_GT(step(std::nullopt), 1.05 * step(kStructural));
}

}  // namespace
}  // namespace gelatin::youngs_modulus_test
