#include "model/descent_rows.h"

#include "model/node_colors.h"

namespace gelatin {

DescentRows make_descent_rows(const Model& model) {
    DescentRows rows;
    const NodeColors colors = color_nodes(model);
    for (std::uint32_t c = 0; c < colors.count(); ++c) {
        const auto first = static_cast<std::uint32_t>(rows.nodes.size());
        rows.nodes.insert(rows.nodes.end(), colors.of(c).begin(), colors.of(c).end());
        while (rows.nodes.size() % HalfSprings::kSlice != 0) rows.nodes.push_back(kNoNode);
        rows.colors.push_back({first, static_cast<std::uint32_t>(rows.nodes.size()) - first});
    }
    rows.springs = pack_half_springs(rows.nodes, model.springs);
    return rows;
}

}  // namespace gelatin
