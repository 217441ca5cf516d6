// The gas of a cavity as an element: its force and its stiffness against differences of its energy.
#include "cpu/implicit/cavity_elements.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gelatin/scene.h"
#include "model/assembly/build_model.h"
#include "support/random_maker.h"
#include "support/shells.h"

namespace gelatin::cpu {
namespace {

using Positions = std::vector<Vec4<double>>;
using Field = std::vector<Vec3<double>>;

// A thick sphere out of shape, far from the origin.
class CavityElementsTest : public testing::TestWithParam<GasLaw> {
protected:
    CavityElementsTest() {
        Scene scene;
        scene.materials.emplace_back().name = "rubber";
        ObjectDescription& ball = scene.objects.emplace_back();
        ball.name = "ball";
        ball.shape = MeshShape{test::sphere_shell(0.3, 0.4, 3, 2)};
        ball.material = "rubber";
        ball.position = {3.0, -2.0, 1.0};
        ball.cavities = {{.law = GetParam(), .pressure = 3e4}};
        model_ = std::make_shared<const Model>(build_model(scene));
        test::RandomMaker random(7);
        for (const glm::vec4& p : model_->positions)
            positions_.emplace_back(glm::dvec3(p) + random.point(0.03), 1.0);
        drives_ = {GetParam() == GasLaw::constant ? 3e4 : 1.4};
    }

    double energy(const Positions& positions) const {
        const Cavity& cavity = model_->cavities[0];
        return cavity.energy(drives_[0], enclosed_volume<Vec4<double>>(cavity.faces, positions));
    }
    Field forces(const Positions& positions) const {
        CavityElements<double> elements(model_);
        elements.linearise(positions, drives_);
        Field all(positions.size(), Vec3<double>(0.0));
        std::vector<SymmetricMatrix<double>> diagonal(positions.size());
        elements.add(all, diagonal);
        return all;
    }
    static Positions moved(Positions positions, const Field& by, double factor) {
        for (std::size_t n = 0; n < by.size(); ++n) positions[n] += Vec4<double>(factor * by[n], 0.0);
        return positions;
    }
    Field directions(unsigned seed) const {
        test::RandomMaker random(seed);
        Field all;
        for (std::size_t n = 0; n < positions_.size(); ++n) all.push_back(random.point(1.0));
        return all;
    }
    static double dot(const Field& a, const Field& b) {
        double sum = 0.0;
        for (std::size_t n = 0; n < a.size(); ++n) sum += glm::dot(a[n], b[n]);
        return sum;
    }
    Field product(const Field& d) const {
        CavityElements<double> elements(model_);
        elements.linearise(positions_, drives_);
        std::vector<Vec4<double>> displacements;
        for (const Vec3<double>& each : d) displacements.emplace_back(each, 0.0);
        // Elements that resist rotations by as much as gas does.
        const double volume = enclosed_volume<Vec4<double>>(model_->cavities[0].faces, positions_);
        elements.balance_rotations(model_->objects[0],
                                   6.0 * volume * model_->cavities[0].pressure(drives_[0], volume));
        elements.begin_product(model_->objects[0], displacements);
        Field all(d.size(), Vec3<double>(0.0));
        elements.multiply(model_->objects[0].nodes, displacements, all);
        return all;
    }

    std::shared_ptr<const Model> model_;
    Positions positions_;
    std::vector<double> drives_;
};

constexpr double kDifference = 1e-5;  // [m]; its square is the error of central differences

TEST_P(CavityElementsTest, ForcesAreMinusTheGradientOfTheEnergy) {
    const Field d = directions(1), f = forces(positions_);
    const double change =
        energy(moved(positions_, d, kDifference)) - energy(moved(positions_, d, -kDifference));
    EXPECT_NEAR(-change / (2.0 * kDifference), dot(f, d), 1e-7 * std::sqrt(dot(f, f) * dot(d, d)));
}

TEST_P(CavityElementsTest, ProductsAreMinusTheChangeOfForces) {
    const Field d = directions(2), k = product(d);
    const Field ahead = forces(moved(positions_, d, kDifference)),
                back = forces(moved(positions_, d, -kDifference));
    const double scale = std::sqrt(dot(k, k) / static_cast<double>(k.size()));
    for (std::size_t n = 0; n < k.size(); ++n)
        ASSERT_LT(glm::length((back[n] - ahead[n]) / (2.0 * kDifference) - k[n]), 1e-5 * scale) << n;
}

TEST_P(CavityElementsTest, ProductsAreSymmetric) {
    const Field a = directions(3), b = directions(4);
    const double ab = dot(a, product(b)), ba = dot(b, product(a));
    EXPECT_NEAR(ab, ba, 1e-12 * (std::abs(ab) + std::abs(ba)));
}

TEST_P(CavityElementsTest, NeitherPushesNorTurnsTheBody) {
    const Field f = forces(positions_);
    glm::dvec3 sum(0.0), moment(0.0);
    double all = 0.0;
    for (std::size_t n = 0; n < f.size(); ++n) {
        sum += f[n];
        moment += glm::cross(glm::dvec3(positions_[n]), f[n]);
        all += glm::length(f[n]);
    }
    EXPECT_GT(all, 1000.0);
    EXPECT_LT(glm::length(sum), 1e-13 * all);
    EXPECT_LT(glm::length(moment), 1e-12 * all);
}

// Of k g g^T: H has none.
TEST_P(CavityElementsTest, BlocksOfTheDiagonalAreThoseOfProducts) {
    CavityElements<double> elements(model_);
    elements.linearise(positions_, drives_);
    Field f(positions_.size(), Vec3<double>(0.0));
    std::vector<SymmetricMatrix<double>> diagonal(positions_.size());
    elements.add(f, diagonal);
    for (const std::uint32_t n : {model_->cavities[0].faces[0].x, model_->cavities[0].faces[7].y}) {
        Field d(positions_.size(), Vec3<double>(0.0));
        d[n] = {0.3, -0.5, 0.2};
        EXPECT_LT(glm::distance(product(d)[n], diagonal[n] * d[n]),
                  1e-10 * (1.0 + glm::length(product(d)[n])));
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, CavityElementsTest, testing::Values(GasLaw::sealed, GasLaw::constant));

}  // namespace
}  // namespace gelatin::cpu
