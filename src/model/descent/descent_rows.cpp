#include "model/descent/descent_rows.h"

#include <algorithm>
#include <span>

#include "model/descent/node_colors.h"

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

std::vector<DescentBatch> make_batches(const Model& model, std::uint32_t nodes_a_batch) {
    std::vector<DescentBatch> batches;
    for (std::uint32_t o = 0; o < model.body_count(); ++o) {
        const ModelObject& object = model.objects[o];
        if (batches.empty() || object.nodes.end() - batches.back().nodes.first > nodes_a_batch)
            batches.push_back({{o, 0}, {object.nodes.first, 0}, {object.tets.first, 0}, {}});
        DescentBatch& batch = batches.back();
        ++batch.objects.count;
        batch.nodes.count += object.nodes.count;
        batch.tets.count += object.tets.count;
    }
    return batches;
}

// Those of ascending nodes that are in the range.
std::span<const std::uint32_t> within(const Range& range, std::span<const std::uint32_t> nodes) {
    const auto first = std::lower_bound(nodes.begin(), nodes.end(), range.first);
    return {first, std::lower_bound(first, nodes.end(), range.end())};
}

}  // namespace

DescentRows make_descent_rows(const Model& model, std::uint32_t nodes_a_batch) {
    DescentRows rows;
    const NodeColors colors = color_nodes(model);
    rows.batches = make_batches(model, nodes_a_batch);
    for (DescentBatch& batch : rows.batches) {
        for (std::uint32_t c = 0; c < colors.count(); ++c) {
            const std::span<const std::uint32_t> nodes = within(batch.nodes, colors.of(c));
            if (nodes.empty()) continue;
            const auto first = static_cast<std::uint32_t>(rows.nodes.size());
            rows.nodes.insert(rows.nodes.end(), nodes.begin(), nodes.end());
            sort_by_degree(std::span(rows.nodes).subspan(first), model.incidence);
            while (rows.nodes.size() % HalfSprings::kSlice != 0) rows.nodes.push_back(kNoNode);
            batch.colors.push_back({first, static_cast<std::uint32_t>(rows.nodes.size()) - first});
        }
    }
    rows.springs = pack_half_springs(rows.nodes, model.springs);
    return rows;
}

}  // namespace gelatin
