#include "mesh/lattice/improve_tets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "mesh/tet_quality.h"

namespace gelatin::lattice {
namespace {

constexpr double kGoodSine = 0.42262;  // of 25 degrees

// The tets of each node.
struct TetsOfNodes {
    explicit TetsOfNodes(const TetMesh& mesh)
        : starts(mesh.positions.size() + 1, 0), tets(4 * mesh.tets.size()) {
        for (const glm::uvec4& tet : mesh.tets) {
            for (int k = 0; k < 4; ++k) ++starts[tet[k] + 1];
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
        for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
            for (int k = 0; k < 4; ++k) tets[next[mesh.tets[t][k]]++] = t;
        }
    }
    std::span<const std::uint32_t> of(std::uint32_t node) const {
        return {tets.data() + starts[node], tets.data() + starts[node + 1]};
    }

    std::vector<std::uint32_t> starts, tets;
};

// Nodes of the boundary that are on no face, as in a hole of the surface, stay near where they were.
enum class Freedom : std::uint8_t { free, on_surface, near_start };
constexpr double kLeash = 0.3;  // of the shortest edge

class Improvement {
public:
    Improvement(TetMesh& mesh, const FaceTree& tree)
        : mesh_(mesh),
          tree_(tree),
          tets_(mesh),
          starts_(mesh.positions),
          freedom_(mesh.positions.size(), Freedom::free) {
        for (const glm::uvec3& face : mesh.faces) {
            for (int k = 0; k < 3; ++k) freedom_[face[k]] = Freedom::on_surface;
        }
        for (std::uint32_t n = 0; n < freedom_.size(); ++n) {
            if (freedom_[n] == Freedom::on_surface &&
                !tree.find_nearest(mesh.positions[n], 1e-6 * shortest_edge(n)))
                freedom_[n] = Freedom::near_start;
        }
    }

    void run() {
        constexpr int kSweeps = 20;
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            check_cancelled();
            bool has_moved = false;
            for (const std::uint32_t node : nodes_of_poor_tets()) has_moved |= improve(node);
            if (!has_moved) return;
        }
    }

private:
    double quality(std::uint32_t t) const {
        const glm::uvec4& tet = mesh_.tets[t];
        return worst_sine(mesh_.positions[tet[0]], mesh_.positions[tet[1]], mesh_.positions[tet[2]],
                          mesh_.positions[tet[3]]);
    }

    double shortest_edge(std::uint32_t node) const {
        double shortest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t t : tets_.of(node)) {
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t other = mesh_.tets[t][k];
                if (other != node)
                    shortest =
                        std::min(shortest, glm::distance(mesh_.positions[node], mesh_.positions[other]));
            }
        }
        return shortest;
    }

    std::vector<std::uint32_t> nodes_of_poor_tets() const {
        std::vector<std::uint32_t> nodes;
        for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
            if (quality(t) >= kGoodSine) continue;
            for (int k = 0; k < 4; ++k) nodes.push_back(mesh_.tets[t][k]);
        }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
    }

    // The worst quality of the node's tets, or something below `enough` if it is less than that.
    double worst_around(std::uint32_t node, double enough) const {
        double worst = 1.0;
        for (const std::uint32_t t : tets_.of(node)) {
            worst = std::min(worst, quality(t));
            if (worst <= enough) break;
        }
        return worst;
    }

    // Searches along fixed directions, with steps that become shorter.
    bool improve(std::uint32_t node) {
        double worst = worst_around(node, -1.0);
        if (worst >= kGoodSine) return false;
        const double start = worst, least_gain = 1e-3;
        const double length = shortest_edge(node);
        for (double step = 0.3 * length; step > 0.02 * length;) {
            if (!try_steps(node, step, length, worst)) step *= 0.5;
        }
        return worst > start + least_gain;
    }

    bool try_steps(std::uint32_t node, double step, double shortest, double& worst) {
        for (int d = 0; d < 27; ++d) {
            const glm::dvec3 direction(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
            if (d == 13) continue;
            const glm::dvec3 old = mesh_.positions[node];
            glm::dvec3 moved = old + step / glm::length(direction) * direction;
            if (freedom_[node] == Freedom::on_surface) {
                const auto nearest = tree_.find_nearest(moved, step);
                if (!nearest) continue;
                moved = nearest->point;
            } else if (freedom_[node] == Freedom::near_start &&
                       glm::distance(moved, starts_[node]) > kLeash * shortest) {
                continue;
            }
            mesh_.positions[node] = moved;
            const double now = worst_around(node, worst + 1e-4);
            if (now > worst + 1e-4) {
                worst = now;
                return true;
            }
            mesh_.positions[node] = old;
        }
        return false;
    }

    TetMesh& mesh_;
    const FaceTree& tree_;
    const TetsOfNodes tets_;
    const std::vector<glm::dvec3> starts_;
    std::vector<Freedom> freedom_;
};

}  // namespace

void improve_tets(TetMesh& mesh, const FaceTree& tree) {
    Improvement(mesh, tree).run();
}

}  // namespace gelatin::lattice
