#include "model/descent/coarse_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/coarse_motions.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

Model block_of(MaterialModel model, double poisson_ratio, bool is_held = false) {
    Body body = test::make_body(test::make_block({6, 3, 3}, {0.6, 0.3, 0.3}, 0.2));
    body.material = Material{};
    body.material.model = model;
    body.material.poisson_ratio = poisson_ratio;
    body.material.damping = 0.02;
    if (is_held) body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.05}};
    return test::make_model(body);
}

constexpr std::pair<MaterialModel, double> kMaterials[] = {
    {MaterialModel::mass_spring, 0.25}, {MaterialModel::mass_spring, 0.4}, {MaterialModel::neo_hookean, 0.4}};

// Of springs: k / 2 (n . (d_j - d_i))^2.
double spring_energy(const Model& model, const std::vector<glm::dvec3>& displacements) {
    double sum = 0.0;
    for (const Spring& s : model.springs) {
        const glm::dvec3 n =
            glm::normalize(glm::dvec3(model.positions[s.j]) - glm::dvec3(model.positions[s.i]));
        const double longer = glm::dot(n, displacements[s.j] - displacements[s.i]);
        sum += 0.5 * static_cast<double>(s.stiffness) * longer * longer;
    }
    return sum;
}

TEST(CoarseMatrices, HaveTheEnergyOfSprings) {
    const Model model = block_of(MaterialModel::mass_spring, 0.25);
    const CoarseBasis basis = make_coarse_basis(model);
    const CoarseMatrices matrices = make_coarse_matrices(model, basis)[0];
    for (const unsigned seed : {1u, 2u}) {
        const Eigen::VectorXd q = test::random_motions(basis.objects[0], 0.01, seed);
        const std::vector<glm::dvec3> displacements =
            test::coarse_displacements(model, basis, basis.objects[0], q);
        const double expected = spring_energy(model, displacements);
        EXPECT_NEAR(0.5 * q.dot(matrices.elastic * q), expected, 1e-9 * expected);
        EXPECT_NEAR(0.5 * q.dot(matrices.viscous * q), 0.02 * expected, 1e-7 * expected);
        double kinetic = 0.0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n)
            kinetic +=
                0.5 * static_cast<double>(model.masses[n]) * glm::dot(displacements[n], displacements[n]);
        EXPECT_NEAR(0.5 * q.dot(matrices.inertia * q), kinetic, 1e-9 * kinetic);
    }
}

// The small strain of a tet whose corners go `displacements`.
Eigen::Matrix3d strain_of(const Model& model, const glm::uvec4& tet,
                          const std::vector<glm::dvec3>& displacements) {
    Eigen::Matrix3d rest, moved;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 x = glm::dvec3(model.positions[tet[k + 1]]) - glm::dvec3(model.positions[tet[0]]);
        const glm::dvec3 d = displacements[tet[k + 1]] - displacements[tet[0]];
        rest.col(k) << x.x, x.y, x.z;
        moved.col(k) << d.x, d.y, d.z;
    }
    const Eigen::Matrix3d gradient = moved * rest.inverse();
    return 0.5 * (gradient + gradient.transpose());
}

// Springs lack lambda - mu of Hooke's law, here of every tet by itself; neo-Hookean tets and what they leave
// to the volume term have all of it.
TEST(CoarseMatrices, HaveTheEnergyOfTets) {
    for (const auto& [material, nu] : kMaterials) {
        const Model model = block_of(material, nu);
        const CoarseBasis basis = make_coarse_basis(model);
        const CoarseMatrices matrices = make_coarse_matrices(model, basis)[0];
        const Eigen::VectorXd q = test::random_motions(basis.objects[0], 0.01, 3);
        const std::vector<glm::dvec3> displacements =
            test::coarse_displacements(model, basis, basis.objects[0], q);
        const double youngs_modulus = Material{}.youngs_modulus;
        const double mu = youngs_modulus / (2.0 * (1.0 + nu));
        const double lambda = youngs_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        const bool has_springs = material == MaterialModel::mass_spring;
        double expected = has_springs ? spring_energy(model, displacements) : 0.0;
        for (std::size_t t = 0; t < model.tets.size(); ++t) {
            const Eigen::Matrix3d strain = strain_of(model, model.tets[t], displacements);
            const double trace = strain.trace(), volume = static_cast<double>(model.tet_rests[t].volume);
            expected += has_springs ? 0.5 * volume * (lambda - mu) * trace * trace
                                    : volume * (mu * strain.squaredNorm() + 0.5 * lambda * trace * trace);
        }
        EXPECT_NEAR(0.5 * q.dot(matrices.elastic * q), expected, 1e-4 * expected) << nu;
    }
}

TEST(CoarseMatrices, DoNotResistRigidMotions) {
    for (const auto& [material, nu] : kMaterials) {
        const Model model = block_of(material, nu);
        const CoarseBasis basis = make_coarse_basis(model);
        const CoarseMatrices matrices = make_coarse_matrices(model, basis)[0];
        const glm::dvec3 orientation(0.3, -0.2, 0.5), translation(1.0, 2.0, -1.0);
        Eigen::VectorXd q(matrices.elastic.rows());
        for (std::uint32_t k = 0; k < basis.cluster_count(); ++k) {
            const glm::dvec3 s = translation + glm::cross(orientation, basis.middles[k] - basis.middles[0]);
            q.segment(6 * static_cast<Eigen::Index>(k), 6) << s.x, s.y, s.z, orientation.x, orientation.y,
                orientation.z;
        }
        const double stiffness = matrices.elastic.diagonal().maxCoeff();
        EXPECT_LT((matrices.elastic * q).norm(), 1e-5 * stiffness) << nu;
        EXPECT_NEAR(q.dot(matrices.rigid * q), q.dot(matrices.inertia * q),
                    1e-9 * q.dot(matrices.inertia * q));
        // And are left to others: what accelerates the body as a whole moves clusters by far less than it
        // would.
        const double step = 1.0 / 60.0;
        const Eigen::VectorXd moved = matrices.inverse(step) * (matrices.inertia * q);
        EXPECT_LT(moved.norm(), 0.2 * step * step * q.norm());
    }
}

TEST(CoarseMatrices, HaveASymmetricPositiveInverse) {
    for (const bool is_held : {false, true}) {
        const Model model = block_of(MaterialModel::mass_spring, 0.4, is_held);
        const CoarseBasis basis = make_coarse_basis(model);
        const CoarseMatrices matrices = make_coarse_matrices(model, basis)[0];
        EXPECT_EQ(matrices.rigid.norm() > 0.0, !is_held);
        const Eigen::MatrixXd inverse = matrices.inverse(0.01);
        EXPECT_LT((inverse - inverse.transpose()).norm(), 1e-9 * inverse.norm());
        for (const unsigned seed : {1u, 2u, 3u}) {
            const Eigen::VectorXd q = test::random_motions(basis.objects[0], 1.0, seed);
            EXPECT_GT(q.dot(inverse * q), 0.0);
        }
    }
}

}  // namespace
}  // namespace gelatin
