#include "model/springs/moment_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/topology.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

struct FitSample {
    TetMesh mesh = test::make_block({4, 4, 4}, {1, 1, 1}, 0.25);
    RestNet net;
    std::vector<double> stiffness;
    MomentTargets targets;

    FitSample() {
        const std::vector<double> volumes = tet_volumes(mesh);
        std::vector<Link> links = edge_links(mesh, volumes);
        const std::vector<Link> across = without(face_links(mesh, volumes), links);
        links.insert(links.end(), across.begin(), across.end());
        net = make_rest_net(mesh, links);
        double sum = 0.0;
        for (const Link& link : links) sum += link.volume;
        for (std::size_t s = 0; s < links.size(); ++s)
            stiffness.push_back(15.0 * links[s].volume / sum / (net.lengths[s] * net.lengths[s]));
        targets.boundary_areas = boundary_areas(mesh);
        targets.node_volumes.assign(mesh.positions.size(), 0.0);
        for (std::size_t t = 0; t < volumes.size(); ++t) {
            for (int k = 0; k < 4; ++k) targets.node_volumes[mesh.tets[t][k]] += 0.25 * volumes[t];
        }
    }

    // The function that is to become small, by its definition: all 27 and all 81 entries of each node's
    // tensors.
    double miss(const std::vector<double>& s) const {
        const auto d = [](int a, int b) { return a == b ? 1.0 : 0.0; };
        double sum = 0.0;
        for (std::uint32_t node = 0; node < net.node_count(); ++node) {
            const Eigen::Vector3d& g = targets.boundary_areas[node];
            double force[3][3][3], energy[3][3][3][3], weight = 0.0;
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                    for (int c = 0; c < 3; ++c) {
                        force[a][b][c] = -(d(b, c) * g[a] + d(a, c) * g[b] + d(a, b) * g[c]);
                        for (int e = 0; e < 3; ++e)
                            energy[a][b][c][e] = -targets.node_volumes[node] *
                                                 (d(a, b) * d(c, e) + d(a, c) * d(b, e) + d(a, e) * d(b, c));
                    }
            for (std::uint32_t k = net.ends.starts[node]; k < net.ends.starts[node + 1]; ++k) {
                const std::uint32_t spring = net.ends.entries[k] / 2;
                const Eigen::Vector3d n =
                    (net.ends.entries[k] % 2 == 0 ? 1.0 : -1.0) * net.directions[spring];
                const double kl = s[spring] * stiffness[spring] * net.lengths[spring];
                weight += stiffness[spring];
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b)
                        for (int c = 0; c < 3; ++c) {
                            force[a][b][c] -= kl * n[a] * n[b] * n[c];
                            for (int e = 0; e < 3; ++e)
                                energy[a][b][c][e] +=
                                    0.5 * kl * net.lengths[spring] * n[a] * n[b] * n[c] * n[e];
                        }
            }
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                    for (int c = 0; c < 3; ++c) {
                        sum += force[a][b][c] * force[a][b][c] / weight;
                        for (int e = 0; e < 3; ++e)
                            sum +=
                                energy[a][b][c][e] * energy[a][b][c][e] / (3.0 * targets.node_volumes[node]);
                    }
        }
        for (std::size_t k = 0; k < s.size(); ++k)
            sum += 0.01 * stiffness[k] * net.lengths[k] * net.lengths[k] * (s[k] - 1.0) * (s[k] - 1.0);
        return 0.5 * sum;
    }
};

TEST(MomentFit, ComesNearToTheLeastSquares) {
    const FitSample sample;
    const std::vector<double> s = fit_to_moments(sample.net, sample.stiffness, sample.targets);
    const double least = sample.miss(s);
    EXPECT_LT(least, 0.25 * sample.miss(std::vector<double>(s.size(), 1.0)));
    for (const double factor : s) EXPECT_GE(factor, 0.05);

    // Nothing is to be gained by moving any one of the springs; at its bound, by moving it up.
    for (std::size_t k = 0; k < s.size(); k += 37) {
        for (const double move : {-0.05, 0.05}) {
            std::vector<double> moved = s;
            moved[k] += move;
            if (moved[k] < 0.05) continue;
            EXPECT_GT(sample.miss(moved), least * (1.0 - 1e-4)) << k << " by " << move;
        }
    }
}

}  // namespace
}  // namespace gelatin
