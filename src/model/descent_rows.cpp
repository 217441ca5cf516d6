#include "model/descent_rows.h"

#include <algorithm>
#include <span>

#include "model/node_colors.h"

namespace gelatin {
namespace {

// Rows of like length in a slice waste little of it; windows keep neighbours near each other.
constexpr std::size_t kWindow = 512;

void sort_by_degree(std::span<std::uint32_t> nodes, const SpringIncidence& incidence) {
    const auto degree = [&](std::uint32_t n) { return incidence.starts[n + 1] - incidence.starts[n]; };
    for (std::size_t first = 0; first < nodes.size(); first += kWindow) {
        const auto window = nodes.subspan(first, std::min(kWindow, nodes.size() - first));
        std::stable_sort(window.begin(), window.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return degree(a) > degree(b); });
    }
}

}  // namespace

DescentRows make_descent_rows(const Model& model) {
    DescentRows rows;
    const NodeColors colors = color_nodes(model);
    for (std::uint32_t c = 0; c < colors.count(); ++c) {
        const auto first = static_cast<std::uint32_t>(rows.nodes.size());
        rows.nodes.insert(rows.nodes.end(), colors.of(c).begin(), colors.of(c).end());
        sort_by_degree(std::span(rows.nodes).subspan(first), model.incidence);
        while (rows.nodes.size() % HalfSprings::kSlice != 0) rows.nodes.push_back(kNoNode);
        rows.colors.push_back({first, static_cast<std::uint32_t>(rows.nodes.size()) - first});
    }
    rows.springs = pack_half_springs(rows.nodes, model.springs);
    return rows;
}

std::vector<std::uint32_t> objects_of_nodes(const Model& model) {
    std::vector<std::uint32_t> objects(model.node_count(), 0);
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const Range& nodes = model.objects[o].nodes;
        std::fill_n(objects.begin() + nodes.first, nodes.count, o);
    }
    return objects;
}

}  // namespace gelatin
