#include "model/springs/moment_fit.h"

#include <algorithm>
#include <cmath>

#include "model/for_each_index.h"

namespace gelatin {
namespace {

constexpr double kLeastFactor = 0.05;
constexpr double kStayNearOne = 0.01;  // of a spring's k l^2
constexpr int kSteps = 40;

// Symmetric tensors of third and of fourth order, with one entry for each set of equal components, times the
// square root of their number. The scalar product of two such vectors is that of the tensors. That of n n n
// with m m m is (n . m)^3.
using Third = Eigen::Matrix<double, 10, 1>;
using Fourth = Eigen::Matrix<double, 15, 1>;
const double kRoot3 = std::sqrt(3.0), kRoot6 = std::sqrt(6.0), kRoot12 = std::sqrt(12.0);

Third third_power(const Eigen::Vector3d& n) {
    const double x = n.x(), y = n.y(), z = n.z();
    Third m;
    m << x * x * x, y * y * y, z * z * z, kRoot3 * x * x * y, kRoot3 * x * x * z, kRoot3 * y * y * x,
        kRoot3 * y * y * z, kRoot3 * z * z * x, kRoot3 * z * z * y, kRoot6 * x * y * z;
    return m;
}

Fourth fourth_power(const Eigen::Vector3d& n) {
    const double x = n.x(), y = n.y(), z = n.z();
    const double xx = x * x, yy = y * y, zz = z * z;
    Fourth m;
    m << xx * xx, yy * yy, zz * zz, 2 * xx * x * y, 2 * xx * x * z, 2 * yy * y * x, 2 * yy * y * z,
        2 * zz * z * x, 2 * zz * z * y, kRoot6 * xx * yy, kRoot6 * xx * zz, kRoot6 * yy * zz,
        kRoot12 * xx * y * z, kRoot12 * yy * x * z, kRoot12 * zz * x * y;
    return m;
}

// d_bc g_a + d_ac g_b + d_ab g_c
Third isotropic_third(const Eigen::Vector3d& g) {
    Third m;
    m << 3 * g.x(), 3 * g.y(), 3 * g.z(), kRoot3 * g.y(), kRoot3 * g.z(), kRoot3 * g.x(), kRoot3 * g.z(),
        kRoot3 * g.x(), kRoot3 * g.y(), 0.0;
    return m;
}

// d_ab d_cd + d_ac d_bd + d_ad d_bc
Fourth isotropic_fourth() {
    Fourth m = Fourth::Zero();
    m.head<3>().setConstant(3.0);
    m.segment<3>(9).setConstant(kRoot6);
    return m;
}

// A node's two sets of equations, or their residuals.
struct Moments {
    Third force;
    Fourth energy;
};

// Minimises 1/2 |A s - b|^2 + 1/2 kStayNearOne sum k l^2 (s - 1)^2, with two sets of rows for each node. Rows
// are divided by the root of a stiffness, so that their squares are energies.
class Problem {
public:
    Problem(const RestNet& net, const std::vector<double>& stiffness, const MomentTargets& targets)
        : net_(net),
          targets_(targets),
          force_weights_(net.node_count(), 0.0),
          energy_weights_(net.node_count(), 0.0),
          missed_(net.node_count()),
          force_(net.spring_count()),
          energy_(net.spring_count()),
          pull_(static_cast<Eigen::Index>(net.spring_count())) {
        for (std::size_t s = 0; s < net.spring_count(); ++s) {
            force_[s] = stiffness[s] * net.lengths[s];
            energy_[s] = 0.5 * force_[s] * net.lengths[s];
            pull_[static_cast<Eigen::Index>(s)] = kStayNearOne * 2.0 * energy_[s];
            for (int end = 0; end < 2; ++end) force_weights_[net.nodes[s][end]] += stiffness[s];
        }
        for (std::size_t n = 0; n < net.node_count(); ++n) {
            if (force_weights_[n] == 0.0) continue;  // a node without tets
            force_weights_[n] = 1.0 / force_weights_[n];
            energy_weights_[n] = 1.0 / (3.0 * targets.node_volumes[n]);
        }
    }

    // A^T (A s - b) + kStayNearOne k l^2 (s - 1)
    void gradient(const Eigen::VectorXd& s, Eigen::VectorXd& result) {
        for_each_index(net_.node_count(), [&](std::size_t n) { missed_[n] = weighted_miss(n, s); });
        for_each_index(net_.spring_count(), [&](std::size_t k) {
            const auto at = static_cast<Eigen::Index>(k);
            const Moments& first = missed_[net_.nodes[k].x];
            const Moments& second = missed_[net_.nodes[k].y];
            const Eigen::Vector3d& n = net_.directions[k];
            result[at] = force_[k] * third_power(n).dot(second.force - first.force) +
                         energy_[k] * fourth_power(n).dot(first.energy + second.energy) +
                         pull_[at] * (s[at] - 1.0);
        });
    }

    // A diagonal matrix C such that C - A^T A - kStayNearOne k l^2 is positive semi-definite: steps with its
    // inverse never overshoot. With H_st the coupling of springs s and t in a node's equations, and d_s =
    // H_ss, |H_st x_s x_t| <= |H_st| (x_s^2 (d_s / d_t)^1/2 + x_t^2 (d_t / d_s)^1/2) / 2.
    Eigen::VectorXd curvature_bound() const {
        Eigen::VectorXd bound = pull_;
        for_each_index(net_.spring_count(), [&](std::size_t s) {
            for (int end = 0; end < 2; ++end) bound[static_cast<Eigen::Index>(s)] += curvature_at(s, end);
        });
        return bound;
    }

private:
    // sum over t of |H_st| (d_s / d_t)^1/2, in the equations of one of the ends of spring s.
    double curvature_at(std::size_t s, int end) const {
        const std::uint32_t node = net_.nodes[s][end];
        const Eigen::Vector3d out = (end == 0 ? 1.0 : -1.0) * net_.directions[s];
        double sum = 0.0;
        for (std::uint32_t e = net_.ends.starts[node]; e < net_.ends.starts[node + 1]; ++e) {
            const std::uint32_t t = net_.ends.entries[e] / 2;
            const double cosine = (net_.ends.entries[e] % 2 == 0 ? 1.0 : -1.0) * out.dot(net_.directions[t]);
            const double product = force_weights_[node] * force_[s] * force_[t] +
                                   energy_weights_[node] * energy_[s] * energy_[t] * cosine;
            sum += std::abs(product * cosine * cosine * cosine) / std::sqrt(column_square(t, node));
        }
        return sum * std::sqrt(column_square(s, node));
    }

    // H_ss in the equations of a node.
    double column_square(std::size_t s, std::uint32_t node) const {
        return force_weights_[node] * force_[s] * force_[s] + energy_weights_[node] * energy_[s] * energy_[s];
    }

    // The residual of the springs of node n, times the squares of the rows' weights.
    Moments weighted_miss(std::size_t n, const Eigen::VectorXd& s) const {
        static const Fourth isotropic = isotropic_fourth();
        Moments sum{-isotropic_third(targets_.boundary_areas[n]), -targets_.node_volumes[n] * isotropic};
        for (std::uint32_t e = net_.ends.starts[n]; e < net_.ends.starts[n + 1]; ++e) {
            const std::uint32_t spring = net_.ends.entries[e] / 2;
            const double outwards = net_.ends.entries[e] % 2 == 0 ? 1.0 : -1.0;
            const Eigen::Vector3d& direction = net_.directions[spring];
            const double factor = s[spring];
            sum.force -= outwards * factor * force_[spring] * third_power(direction);
            sum.energy += factor * energy_[spring] * fourth_power(direction);
        }
        sum.force *= force_weights_[n];
        sum.energy *= energy_weights_[n];
        return sum;
    }

    const RestNet& net_;
    const MomentTargets& targets_;
    std::vector<double> force_weights_, energy_weights_;  // squares of the rows' weights [1/m, 1/m^3]
    std::vector<Moments> missed_;
    std::vector<double> force_, energy_;  // k l and k l^2 / 2 of each spring
    Eigen::VectorXd pull_;                // kStayNearOne k l^2
};

}  // namespace

// Accelerated projected gradient (Beck, Teboulle, "A fast iterative shrinkage-thresholding algorithm for
// linear inverse problems", SIAM J. Imaging Sciences 2(1), 2009), with a separate step size for each spring.
std::vector<double> fit_to_moments(const RestNet& net, const std::vector<double>& stiffness,
                                   const MomentTargets& targets) {
    Problem problem(net, stiffness, targets);
    const Eigen::VectorXd step = problem.curvature_bound().cwiseInverse();
    Eigen::VectorXd s = Eigen::VectorXd::Ones(step.size()), ahead = s, next, gradient(step.size());
    double momentum = 1.0;
    for (int k = 0; k < kSteps; ++k) {
        problem.gradient(ahead, gradient);
        next = (ahead - step.cwiseProduct(gradient)).cwiseMax(kLeastFactor);
        const double next_momentum = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
        ahead = next + (momentum - 1.0) / next_momentum * (next - s);
        s = next;
        momentum = next_momentum;
    }
    return {s.begin(), s.end()};
}

}  // namespace gelatin
