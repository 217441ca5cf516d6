#include "cpu/implicit/elastic_system.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "cpu/elasticity/elastic_energy.h"
#include "support/converted.h"
#include "support/elastic_cases.h"
#include "support/instruction_sets.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kInverseStep = 240.0;  // [1/s]

using test::elastic_cases;
using test::ElasticCase;
using test::make_elastic_block;
using test::random_field;
using test::shake_nodes;

template <class Real>
using Field = std::vector<cpu::Vec3<Real>>;

template <class Real, class Other>
double inner_product(const Field<Real>& a, const Field<Other>& b) {
    double sum = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) sum += glm::dot(glm::dvec3(a[n]), glm::dvec3(b[n]));
    return sum;
}

template <class Real>
double norm_of(const Field<Real>& a) {
    return std::sqrt(inner_product(a, a));
}

template <class Real, class Other>
double distance_of(const Field<Real>& a, const Field<Other>& b) {
    Field<double> difference;
    for (std::size_t n = 0; n < a.size(); ++n) difference.push_back(glm::dvec3(a[n]) - glm::dvec3(b[n]));
    return norm_of(difference);
}

template <class Real>
cpu::ElasticSystem<Real> linearised(const Model& model) {
    cpu::ElasticSystem<Real> system(std::make_shared<const Model>(model));
    system.linearise(test::converted<Real>(model.positions), test::converted<Real>(model.velocities),
                     static_cast<Real>(kInverseStep));
    return system;
}

template <class Real>
Field<Real> product(const Model& model, cpu::ElasticSystem<Real>& system, const Field<Real>& d) {
    Field<Real> result(d.size(), cpu::Vec3<Real>(std::numeric_limits<Real>::quiet_NaN()));
    for (std::size_t n = 0; n < d.size(); ++n) system.displacements[n] = cpu::Vec4<Real>(d[n], 0);
    for (const ModelObject& body : model.bodies()) system.begin_product(body);
    const auto count = static_cast<std::uint32_t>(d.size()), part = count / 3;  // it begins within a group
    system.multiply({0, part}, result);
    system.multiply({part, count - part}, result);
    return result;
}

template <class Real>
class ElasticSystemTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ElasticSystemTest, Scalars);

TYPED_TEST(ElasticSystemTest, IsSymmetricAndNotNegative) {
    using Real = TypeParam;
    const double tolerance = 20.0 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    for (ElasticCase& at : elastic_cases()) {
        SCOPED_TRACE(at.name);
        shake_nodes(at.model, 0.03f);
        cpu::ElasticSystem<Real> system = linearised<Real>(at.model);
        for (unsigned seed = 0; seed < 5; ++seed) {
            const auto a = random_field<Real>(at.model.node_count(), 2 * seed),
                       b = random_field<Real>(at.model.node_count(), 2 * seed + 1);
            const Field<Real> ka = product(at.model, system, a), kb = product(at.model, system, b);
            EXPECT_NEAR(inner_product(a, kb), inner_product(b, ka), tolerance * norm_of(a) * norm_of(kb));
            EXPECT_GT(inner_product(a, ka), 0.0);
        }
    }
}

TYPED_TEST(ElasticSystemTest, ResistsNoRigidMotionAtRest) {
    using Real = TypeParam;
    for (const ElasticCase& at : elastic_cases()) {
        if (at.name.starts_with("both")) continue;  // they are not at rest
        SCOPED_TRACE(at.name);
        cpu::ElasticSystem<Real> system = linearised<Real>(at.model);
        const auto any = random_field<Real>(at.model.node_count(), 1);
        const double scale = norm_of(product(at.model, system, any)) / norm_of(any);
        const Field<Real> shift(any.size(), cpu::Vec3<Real>(1, -2, 3));
        Field<Real> turn;
        for (const glm::vec4& p : at.model.positions)
            turn.push_back(glm::cross(cpu::Vec3<Real>(3, 1, -2), cpu::Vec3<Real>(p)));
        // The model's own numbers are in single precision.
        EXPECT_LT(norm_of(product(at.model, system, shift)), 1e-6 * scale * norm_of(shift));
        EXPECT_LT(norm_of(product(at.model, system, turn)), 1e-6 * scale * norm_of(turn));
        EXPECT_LT(norm_of(system.forces()), 1e-6 * scale * norm_of(turn));
    }
}

TEST(ElasticSystem, HasForcesOfTheEnergy) {
    for (ElasticCase& at : elastic_cases()) {
        SCOPED_TRACE(at.name);
        shake_nodes(at.model, 0.02f);
        const cpu::ElasticSystem<double> system = linearised<double>(at.model);
        const auto d = random_field<double>(at.model.node_count(), 1);
        const auto energy = [&](double factor) {
            auto positions = test::converted<double>(at.model.positions);
            for (std::size_t n = 0; n < d.size(); ++n) positions[n] += glm::dvec4(factor * d[n], 0.0);
            double sum = 0.0;
            for (const ModelObject& body : at.model.bodies())
                sum += cpu::body_energy<double>(at.model, body, positions);
            return sum;
        };
        constexpr double kSmall = 1e-6;  // [m]
        EXPECT_NEAR(inner_product(system.forces(), d), (energy(-kSmall) - energy(kSmall)) / (2.0 * kSmall),
                    1e-6 * norm_of(system.forces()) * norm_of(d) / std::sqrt(static_cast<double>(d.size())));
    }
}

// Where a body is stretched evenly, no part of the second derivative is left out.
TEST(ElasticSystem, IsTheDerivativeOfForces) {
    for (const auto& [kind, poisson_ratio] :
         {std::pair(MaterialModel::mass_spring, 0.25), std::pair(MaterialModel::neo_hookean, 0.3)}) {
        Model model = make_elastic_block(kind, poisson_ratio);
        const auto d = random_field<double>(model.node_count(), 1);
        auto positions = test::converted<double>(model.positions);
        for (cpu::Vec4<double>& p : positions) p = {1.05 * glm::dvec3(p), p.w};
        const auto velocities = test::converted<double>(model.velocities);
        const auto moved_by = [&](double factor) {
            auto result = positions;
            for (std::size_t n = 0; n < d.size(); ++n) result[n] += glm::dvec4(factor * d[n], 0.0);
            return result;
        };
        constexpr double kSmall = 1e-6;  // [m]
        cpu::ElasticSystem<double> system(std::make_shared<const Model>(model));
        system.linearise(moved_by(kSmall), velocities, kInverseStep);
        Field<double> change = system.forces();
        system.linearise(moved_by(-kSmall), velocities, kInverseStep);
        for (std::size_t n = 0; n < d.size(); ++n)
            change[n] = (system.forces()[n] - change[n]) / (2.0 * kSmall);
        system.linearise(positions, velocities, kInverseStep);
        EXPECT_LT(distance_of(product(model, system, d), change), 1e-6 * norm_of(change));
    }
}

TEST(ElasticSystem, IsInFloatAsInDouble) {
    for (ElasticCase& at : elastic_cases()) {
        SCOPED_TRACE(at.name);
        shake_nodes(at.model, 0.02f);
        cpu::ElasticSystem<double> exact = linearised<double>(at.model);
        const auto d = random_field<double>(at.model.node_count(), 1);
        const Field<double> expected = product(at.model, exact, d);
        Field<double> blocks;
        for (const auto& block : exact.diagonal()) {
            blocks.push_back(block.diagonal);
            blocks.push_back(block.beside);
        }
        test::with_each_instruction_set([&] {
            cpu::ElasticSystem<float> system = linearised<float>(at.model);
            EXPECT_LT(distance_of(product(at.model, system, random_field<float>(d.size(), 1)), expected),
                      1e-6 * norm_of(expected));
            EXPECT_LT(distance_of(system.forces(), exact.forces()), 1e-5 * norm_of(exact.forces()));
            Field<float> own;
            for (const auto& block : system.diagonal()) {
                own.push_back(block.diagonal);
                own.push_back(block.beside);
            }
            EXPECT_LT(distance_of(own, blocks), 1e-6 * norm_of(blocks));
        });
    }
}

// Fewer tets are flat then, and none at last.
TEST(ElasticSystem, ForgetsWhereItWasBefore) {
    for (const ElasticCase& at : elastic_cases()) {
        SCOPED_TRACE(at.name);
        const auto d = random_field<float>(at.model.node_count(), 1);
        const auto shaken_by = [&](float extent) {
            Model model = at.model;
            shake_nodes(model, extent);
            return model;
        };
        cpu::ElasticSystem<float> system = linearised<float>(shaken_by(0.06f));
        for (const float extent : {0.03f, 0.0f}) {
            const Model model = shaken_by(extent);
            cpu::ElasticSystem<float> expected = linearised<float>(model);
            EXPECT_NE(product(model, system, d), product(model, expected, d));
            system.linearise(model.positions, model.velocities, static_cast<float>(kInverseStep));
            EXPECT_EQ(product(model, system, d), product(model, expected, d));
            EXPECT_EQ(system.forces(), expected.forces());
        }
    }
}

TYPED_TEST(ElasticSystemTest, IsTheSameWithAnyNumberOfThreads) {
    using Real = TypeParam;
    for (ElasticCase& at : elastic_cases()) {
        SCOPED_TRACE(at.name);
        shake_nodes(at.model, 0.02f);
        const auto d = random_field<Real>(at.model.node_count(), 1);
        std::vector<Field<Real>> products, forces;
        for (const std::size_t threads : {1, 2}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            cpu::ElasticSystem<Real> system = linearised<Real>(at.model);
            products.push_back(product(at.model, system, d));
            forces.push_back(system.forces());
        }
        EXPECT_EQ(products[0], products[1]);
        EXPECT_EQ(forces[0], forces[1]);
    }
}

// A net of springs without tets, and nothing at all.
TEST(ElasticSystem, NeedsNoTets) {
    const auto model =
        std::make_shared<const Model>(test::make_model(test::make_oscillator(100.0, 1.0, 0.5)));
    cpu::ElasticSystem<float> system(model);
    system.linearise(model->positions, model->velocities, static_cast<float>(kInverseStep));
    EXPECT_NEAR(system.forces()[0].x, 50.0f, 1e-4f);
    const Field<float> k = product(*model, system, {{1.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f}});
    EXPECT_NEAR(k[0].x, 100.0f, 1e-4f);
    EXPECT_NEAR(k[0].y, 100.0f / 3.0f, 1e-4f);
    EXPECT_EQ(k[1], -k[0]);

    cpu::ElasticSystem<float> empty(std::make_shared<const Model>());
    empty.linearise({}, {}, static_cast<float>(kInverseStep));
    empty.multiply({0, 0}, {});
    EXPECT_TRUE(empty.forces().empty());
}

}  // namespace
}  // namespace gelatin
