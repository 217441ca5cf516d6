#include "mesh/tetrahedralise_to_nodes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/surface_repair.h"
#include "mesh/tetrahedralise.h"

namespace gelatin {

TetMesh tetrahedralise_to_nodes(const SurfaceMesh& surface, MesherSettings settings, int nodes,
                                const std::string& name) {
    constexpr int kTries = 8;
    constexpr double kClose = 0.05;
    const auto count_of = [](const TetMesh& mesh) { return static_cast<double>(mesh.positions.size()); };
    const double wanted = nodes;
    const auto is_nearer = [&](const TetMesh& a, const TetMesh& b) {
        return std::abs(count_of(a) - wanted) < std::abs(count_of(b) - wanted);
    };

    settings.max_volume.reset();
    TetMesh best = tetrahedralise(surface, settings, name);
    const double least = count_of(best);
    if (least >= (1.0 - kClose) * wanted) return best;

    // There are about five tets for each node, and half of the largest volume is usual for a tet. The number
    // of nodes that the limit adds is then nearly inverse to it; but it may jump, where TetGen begins to
    // divide the surface.
    struct Try {
        double max_volume, added;
    };
    std::optional<Try> coarse, fine;
    Try next{0.4 * std::abs(signed_volume(surface)) / wanted, wanted - least};
    for (int k = 0; k < kTries; ++k) {
        settings.max_volume = next.max_volume;
        TetMesh mesh = tetrahedralise(surface, settings, name);
        next.added = std::max(count_of(mesh) - least, 1.0);
        if (is_nearer(mesh, best)) best = std::move(mesh);
        if (std::abs(count_of(best) / wanted - 1.0) <= kClose) break;
        (next.added < wanted - least ? coarse : fine) = next;
        if (coarse && fine) {  // by their logarithms, but not too near to either
            const double share =
                std::log((wanted - least) / coarse->added) / std::log(fine->added / coarse->added);
            next.max_volume = coarse->max_volume *
                              std::pow(fine->max_volume / coarse->max_volume, std::clamp(share, 0.2, 0.8));
        } else {
            next.max_volume *= std::clamp(next.added / (wanted - least), 0.05, 20.0);
        }
    }
    return best;
}

}  // namespace gelatin
