#include "model/springs/elastic_response.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "mesh/topology.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kModulus = 2.5;

struct Sample {
    TetMesh mesh = test::make_block({2, 3, 2}, {1.0, 1.2, 0.7}, 0.2);
    RestNet net;
    std::vector<double> stiffness;

    Sample() {
        net = make_rest_net(mesh, edge_links(mesh, tet_volumes(mesh)));
        for (std::size_t s = 0; s < net.spring_count(); ++s) stiffness.push_back(0.2 + 0.1 * double(s % 7));
    }
};

// The same by a dense factorisation, stress by stress.
Eigen::Matrix<double, 6, 6> dense_compliance(const Sample& sample) {
    const auto size = 3 * static_cast<Eigen::Index>(sample.mesh.positions.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t s = 0; s < sample.net.spring_count(); ++s) {
        const Eigen::Vector3d n = sample.net.directions[s];
        const Eigen::Matrix3d block = sample.stiffness[s] * n * n.transpose();
        const Eigen::Index i = 3 * sample.net.nodes[s].x, j = 3 * sample.net.nodes[s].y;
        matrix.block<3, 3>(i, i) += block;
        matrix.block<3, 3>(j, j) += block;
        matrix.block<3, 3>(i, j) -= block;
        matrix.block<3, 3>(j, i) -= block;
    }
    const std::vector<Eigen::Vector3d> areas = boundary_areas(sample.mesh);
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(size, 6);
    for (std::size_t n = 0; n < areas.size(); ++n) {
        const auto row = 3 * static_cast<Eigen::Index>(n);
        const Eigen::Vector3d& g = areas[n];
        forces.block<3, 6>(row, 0) << g.x(), 0, 0, 0, g.z(), g.y(),  //
            0, g.y(), 0, g.z(), 0, g.x(),                            //
            0, 0, g.z(), g.y(), g.x(), 0;
    }
    const Eigen::MatrixXd moves = matrix.completeOrthogonalDecomposition().solve(forces);
    return forces.transpose() * moves / (1.0 * 1.2 * 0.7);
}

TEST(ElasticResponse, AgreesWithADenseSolution) {
    const Sample sample;
    const ElasticResponse response =
        measure_response(sample.mesh, sample.net, sample.stiffness, kModulus, 1e-20);
    const Eigen::Matrix<double, 6, 6> expected = dense_compliance(sample);
    EXPECT_LT((response.compliance - expected).norm(), 1e-8 * expected.norm());
}

TEST(ElasticResponse, StopsAsNearAsItWasTold) {
    const Sample sample;
    const Eigen::Matrix<double, 6, 6> expected = dense_compliance(sample);
    const ElasticResponse rough = measure_response(sample.mesh, sample.net, sample.stiffness, kModulus);
    EXPECT_LT((rough.compliance - expected).norm(), 5e-3 * expected.norm());
}

TEST(ElasticResponse, ReadsTheConstantsOfAnIsotropicBody) {
    ElasticResponse response;
    const double modulus = 7.0, ratio = 0.3;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) response.compliance(a, b) = (a == b ? 1.0 : -ratio) / modulus;
        response.compliance(3 + a, 3 + a) = 2.0 * (1.0 + ratio) / modulus;
    }
    EXPECT_NEAR(response.youngs_modulus(Eigen::Vector3d(1, -2, 3).normalized()), modulus, 1e-12);
    EXPECT_NEAR(response.poisson_ratio(), ratio, 1e-12);
    const auto [softest, stiffest] = response.youngs_modulus_range();
    EXPECT_NEAR(softest, modulus, 1e-12);
    EXPECT_NEAR(stiffest, modulus, 1e-12);
}

}  // namespace
}  // namespace gelatin
