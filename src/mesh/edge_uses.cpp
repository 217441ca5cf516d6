#include "mesh/edge_uses.h"

#include <algorithm>
#include <tuple>

namespace gelatin {

std::vector<EdgeUse> sorted_edge_uses(std::span<const glm::uvec3> faces) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = faces[f][corner], to = faces[f][(corner + 1) % 3];
            uses.push_back({std::min(from, to), std::max(from, to), f, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    return uses;
}

}  // namespace gelatin
