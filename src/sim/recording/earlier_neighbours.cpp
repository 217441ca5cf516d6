#include "sim/recording/earlier_neighbours.h"

#include <algorithm>

#include "model/spring_packing.h"

namespace gelatin {

EarlierNeighbours earlier_neighbours(const Model& model) {
    EarlierNeighbours neighbours(model.node_count());
    for (auto& own : neighbours) own.fill(kNoNode);
    const auto join = [&](std::uint32_t node, std::uint32_t other) {
        if (other >= node) return;
        auto& own = neighbours[node];
        if (std::find(own.begin(), own.end(), other) != own.end()) return;
        const auto free = std::find(own.begin(), own.end(), kNoNode);
        if (free != own.end()) *free = other;
    };
    const auto join_all = [&](const auto& corners) {
        for (const std::uint32_t a : corners)
            for (const std::uint32_t b : corners) join(a, b);
    };
    for (const auto& tet : model.tets) join_all(std::array{tet.x, tet.y, tet.z, tet.w});
    for (const Face& face : model.faces) join_all(std::array{face.a, face.b, face.c});
    return neighbours;
}

}  // namespace gelatin
