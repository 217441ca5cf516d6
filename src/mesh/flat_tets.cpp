#include "mesh/flat_tets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/topology.h"

namespace gelatin {

bool is_flat(const TetMesh& mesh, const glm::uvec4& tet) {
    constexpr double kFlat = 1e-12;
    double longest = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
            longest = std::max(longest, glm::distance(mesh.positions[tet[i]], mesh.positions[tet[j]]));
        }
    }
    return !(std::abs(tet_volume(mesh, tet)) > kFlat * longest * longest * longest);
}

std::size_t drop_flat_skin(TetMesh& mesh) {
    for (;;) {
        std::vector<bool> drop(mesh.tets.size());
        std::transform(mesh.tets.begin(), mesh.tets.end(), drop.begin(),
                       [&](const glm::uvec4& tet) { return is_flat(mesh, tet); });
        const auto flat_count = static_cast<std::size_t>(std::count(drop.begin(), drop.end(), true));
        if (flat_count == 0) return 0;

        const std::vector<InnerFace> inner = inner_faces(mesh.tets);
        std::vector<int> neighbours(mesh.tets.size(), 0);
        for (const InnerFace& face : inner) {
            for (const std::uint32_t tet : face.tets) ++neighbours[tet];
        }
        for (std::size_t t = 0; t < drop.size(); ++t)
            drop[t] = drop[t] && (neighbours[t] == 2 || neighbours[t] == 3);
        // Of two neighbours, the second may no longer be on the boundary in the same position once the first
        // is removed.
        for (const InnerFace& face : inner) {
            if (drop[face.tets[0]] && drop[face.tets[1]]) drop[face.tets[1]] = false;
        }

        drop.flip();
        if (keep_tets(mesh, drop) == 0) return flat_count;
    }
}

}  // namespace gelatin
