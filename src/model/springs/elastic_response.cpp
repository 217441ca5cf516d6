#include "model/springs/elastic_response.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/progress.h"
#include "model/for_each_index.h"

namespace gelatin {
namespace {

constexpr int kMostIterations = 200;

// Displacements or forces of a node, a column for each stress.
using Six = Eigen::Matrix<double, 3, 6>;
using Field = std::vector<Six, Eigen::aligned_allocator<Six>>;
using Columns = Eigen::Array<double, 1, 6>;

Eigen::Matrix<double, 6, 1> voigt(const Eigen::Vector3d& n) {
    Eigen::Matrix<double, 6, 1> v;
    v << n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), n.y() * n.z(), n.z() * n.x(), n.x() * n.y();
    return v;
}

Eigen::Matrix3d unit_stress(int component) {
    constexpr int kRow[6] = {0, 1, 2, 1, 2, 0}, kColumn[6] = {0, 1, 2, 2, 0, 1};
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    stress(kRow[component], kColumn[component]) = stress(kColumn[component], kRow[component]) = 1.0;
    return stress;
}

Columns dot(const Field& a, const Field& b) {
    Columns sum = Columns::Zero();
    for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n].array() * b[n].array()).colwise().sum();
    return sum;
}

// a / b, and 0 once the residual is zero.
Columns ratio(const Columns& a, const Columns& b) {
    return (b > 0.0).select(a / b, Columns::Zero());
}

// Conjugate gradients for six right-hand sides at once, each node's 3 x 3 block as preconditioner.
class Search {
public:
    Search(const RestNet& net, const std::vector<double>& stiffness) : net_(net), stiffness_(stiffness) {
        inverse_blocks_.resize(net.node_count());
        for_each_index(net.node_count(), [&](std::size_t n) {
            Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
            for (std::uint32_t e = net.ends.starts[n]; e < net.ends.starts[n + 1]; ++e) {
                const std::uint32_t s = net.ends.entries[e] / 2;
                block += stiffness[s] * net.directions[s] * net.directions[s].transpose();
            }
            const double floor = 1e-9 * block.trace();  // springs in one plane do not resist forces across it
            block.diagonal().array() += floor;
            inverse_blocks_[n] = floor > 0.0 ? Eigen::Matrix3d(block.inverse()) : Eigen::Matrix3d::Zero();
        });
    }

    // Improves `displacements` until they are in equilibrium with `forces`.
    void run(const Field& forces, double tolerance, Field& displacements) const {
        Field residual(forces.size()), search(forces.size()), image(forces.size()), z(forces.size());
        apply(displacements, image);
        for_each_index(forces.size(), [&](std::size_t n) {
            residual[n] = forces[n] - image[n];
            search[n] = z[n] = inverse_blocks_[n] * residual[n];
        });
        const Columns enough = tolerance * dot(forces, displacements).abs();
        Columns left = dot(residual, z);
        for (int k = 0; k < kMostIterations && (left > enough).any(); ++k) {
            check_cancelled();
            apply(search, image);
            const Columns step = ratio(left, dot(search, image));
            for_each_index(forces.size(), [&](std::size_t n) {
                displacements[n].array() += search[n].array().rowwise() * step;
                residual[n].array() -= image[n].array().rowwise() * step;
                z[n] = inverse_blocks_[n] * residual[n];
            });
            const Columns now = dot(residual, z);
            const Columns keep = ratio(now, left);
            for_each_index(forces.size(), [&](std::size_t n) {
                search[n] = z[n].array() + search[n].array().rowwise() * keep;
            });
            left = now;
        }
    }

private:
    // The springs' forces for `displacements`, to first order.
    void apply(const Field& displacements, Field& forces) const {
        for_each_index(displacements.size(), [&](std::size_t n) {
            Six sum = Six::Zero();
            for (std::uint32_t e = net_.ends.starts[n]; e < net_.ends.starts[n + 1]; ++e) {
                const std::uint32_t s = net_.ends.entries[e] / 2;
                const std::uint32_t other = net_.ends.entries[e] % 2 == 0 ? net_.nodes[s].y : net_.nodes[s].x;
                const Eigen::Vector3d& d = net_.directions[s];
                const Eigen::Matrix<double, 1, 6> stretch =
                    d.transpose() * (displacements[n] - displacements[other]);
                sum += (stiffness_[s] * d) * stretch;
            }
            forces[n] = sum;
        });
    }

    const RestNet& net_;
    const std::vector<double>& stiffness_;
    std::vector<Eigen::Matrix3d> inverse_blocks_;
};

}  // namespace

double ElasticResponse::youngs_modulus(const Eigen::Vector3d& direction) const {
    const Eigen::Matrix<double, 6, 1> stress = voigt(direction);
    return 1.0 / stress.dot(compliance * stress);
}

std::pair<double, double> ElasticResponse::youngs_modulus_range() const {
    double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
    for (int x = 0; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const double modulus = youngs_modulus(Eigen::Vector3d(x, y, z).normalized());
                least = std::min(least, modulus);
                greatest = std::max(greatest, modulus);
            }
        }
    }
    return {least, greatest};
}

double ElasticResponse::poisson_ratio() const {
    const auto& c = compliance;
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) sum -= a == b ? 0.0 : c(b, a) / c(a, a);
    }
    return sum / 6.0;
}

ElasticResponse measure_response(const TetMesh& mesh, const RestNet& net,
                                 const std::vector<double>& stiffness, double start_modulus,
                                 double tolerance) {
    constexpr double kPoissonRatio = 0.25;
    std::array<Eigen::Matrix3d, 6> stresses, strains;
    for (int c = 0; c < 6; ++c) {
        const auto at = static_cast<std::size_t>(c);
        stresses[at] = unit_stress(c);
        strains[at] = ((1.0 + kPoissonRatio) * stresses[at] -
                       kPoissonRatio * stresses[at].trace() * Eigen::Matrix3d::Identity()) /
                      start_modulus;
    }
    const std::vector<Eigen::Vector3d> areas = boundary_areas(mesh);
    Field forces(areas.size()), displacements(areas.size());
    for (std::size_t n = 0; n < areas.size(); ++n) {
        const glm::dvec3 p = mesh.positions[n] - mesh.positions[0];
        for (int c = 0; c < 6; ++c) {
            forces[n].col(c) = stresses[static_cast<std::size_t>(c)] * areas[n];
            displacements[n].col(c) = strains[static_cast<std::size_t>(c)] * Eigen::Vector3d(p.x, p.y, p.z);
        }
    }
    Search(net, stiffness).run(forces, tolerance, displacements);

    // The work of stress a on strain b is V a . b.
    const std::vector<double> volumes = tet_volumes(mesh);
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    ElasticResponse response;
    for (std::size_t n = 0; n < forces.size(); ++n)
        response.compliance += forces[n].transpose() * displacements[n] / volume;
    return response;
}

}  // namespace gelatin
