#include "model/springs/spring_moduli.h"

#include <algorithm>
#include <functional>

#include "mesh/topology.h"
#include "model/springs/links.h"

namespace gelatin {
namespace {

// A pair of nodes, with sums over the tets that a spring between them represents.
struct Known {
    glm::uvec2 nodes;
    double modulus;  // [Pa]
};

bool by_nodes(const Known& a, const Known& b) {
    return a.nodes.x != b.nodes.x ? a.nodes.x < b.nodes.x : a.nodes.y < b.nodes.y;
}

const Known* find(const std::vector<Known>& sorted, const glm::uvec2& nodes) {
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), Known{nodes, 0.0}, by_nodes);
    return found != sorted.end() && found->nodes == nodes ? &*found : nullptr;
}

template <class Combine>
std::vector<double> combined(const std::vector<double>& a, const std::vector<double>& b,
                             const Combine& combine) {
    std::vector<double> result(a.size());
    std::transform(a.begin(), a.end(), b.begin(), result.begin(), combine);
    return result;
}

// Quotients of the values that two lists have for the same pairs.
std::vector<Known> quotients(const std::vector<Link>& a, const std::vector<Link>& b) {
    std::vector<Known> result;
    for (std::size_t k = 0; k < a.size(); ++k) result.push_back({a[k].nodes, a[k].volume / b[k].volume});
    return result;
}

// The tets around a surface edge are those between the corners across it.
std::vector<Known> across_surface(const TetMesh& mesh, const std::vector<Known>& fans) {
    std::vector<Known> result;
    for (const SurfaceEdge& edge : surface_edges(mesh.faces)) {
        const auto [low, high] = std::minmax(edge.corners[0], edge.corners[1]);
        const glm::uvec2 nodes(std::min(edge.nodes.x, edge.nodes.y), std::max(edge.nodes.x, edge.nodes.y));
        if (const Known* fan = find(fans, nodes)) result.push_back({{low, high}, fan->modulus});
    }
    std::stable_sort(result.begin(), result.end(), by_nodes);
    return result;
}

// Sums over the tets around each node.
std::vector<double> sums_at_nodes(const TetMesh& mesh, const std::vector<double>& tet_values) {
    std::vector<double> sums(mesh.positions.size(), 0.0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (int k = 0; k < 4; ++k) sums[mesh.tets[t][k]] += tet_values[t];
    }
    return sums;
}

}  // namespace

std::vector<double> spring_moduli(const TetMesh& mesh, const std::vector<double>& tet_moduli,
                                  const std::vector<glm::uvec2>& springs) {
    const std::vector<double> volumes = tet_volumes(mesh);
    const std::vector<double> stiff = combined(volumes, tet_moduli, std::multiplies<>());
    const std::vector<double> soft = combined(volumes, tet_moduli, std::divides<>());
    const std::vector<Link> edge_volumes = edge_links(mesh, volumes);
    const std::vector<Known> edges = quotients(edge_links(mesh, stiff), edge_volumes);
    const std::vector<Known> faces = quotients(face_links(mesh, volumes), face_links(mesh, soft));
    const std::vector<Known> across = across_surface(mesh, quotients(edge_volumes, edge_links(mesh, soft)));
    const std::vector<double> at_nodes = sums_at_nodes(mesh, volumes),
                              soft_at_nodes = sums_at_nodes(mesh, soft);

    std::vector<double> moduli;
    for (const glm::uvec2& spring : springs) {
        const Known* known = nullptr;
        for (const std::vector<Known>* list : {&edges, &faces, &across}) {
            if (known == nullptr) known = find(*list, spring);
        }
        moduli.push_back(known != nullptr ? known->modulus
                                          : (at_nodes[spring.x] + at_nodes[spring.y]) /
                                                (soft_at_nodes[spring.x] + soft_at_nodes[spring.y]));
    }
    return moduli;
}

}  // namespace gelatin
