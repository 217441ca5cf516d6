#include "mesh/topology.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace gelatin {

namespace {

/// Values grouped by a node: those of node n are values[starts[n]] .. values[starts[n + 1]].
template <class Value>
struct Rows {
    std::vector<std::size_t> starts;
    std::vector<Value> values;

    std::size_t size() const { return starts.size() - 1; }
    std::span<Value> row(std::size_t n) { return {values.data() + starts[n], values.data() + starts[n + 1]}; }
};

/// Groups what `for_each(visit)` passes to visit(node, value), then sorts each row. It is a counting sort
/// followed by many tiny sorts: linear in practice, and the result does not depend on the order of visits.
template <class Value, class ForEach>
Rows<Value> group_by_node(std::size_t node_count, const ForEach& for_each) {
    Rows<Value> rows;
    rows.starts.assign(node_count + 1, 0);
    for_each([&](std::uint32_t node, const Value&) { ++rows.starts[node + 1]; });
    std::partial_sum(rows.starts.begin(), rows.starts.end(), rows.starts.begin());

    rows.values.resize(rows.starts.back());
    std::vector<std::size_t> next(rows.starts.begin(), rows.starts.end() - 1);
    for_each([&](std::uint32_t node, const Value& value) { rows.values[next[node]++] = value; });
    for (std::size_t n = 0; n < node_count; ++n) {
        const std::span<Value> row = rows.row(n);
        std::sort(row.begin(), row.end());
    }
    return rows;
}

/// Splits a sorted row into runs of values with the same `key`.
template <class Value, class Key, class Visit>
void for_each_run(std::span<Value> row, const Key& key, const Visit& visit) {
    for (std::size_t begin = 0; begin < row.size();) {
        std::size_t end = begin + 1;
        while (end < row.size() && key(row[end]) == key(row[begin])) ++end;
        visit(row.subspan(begin, end - begin));
        begin = end;
    }
}

/// One more than the largest node index.
template <class Element>
std::size_t node_bound(std::span<const Element> elements) {
    std::size_t bound = 0;
    for (const Element& element : elements) {
        for (int k = 0; k < Element::length(); ++k) bound = std::max(bound, std::size_t{element[k]} + 1);
    }
    return bound;
}

/// The face of a tet opposite to `corner`, counter-clockwise seen from outside.
glm::uvec3 face_of(const glm::uvec4& tet, std::uint32_t corner) {
    constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    const int(&face)[3] = kFaces[corner];
    return {tet[face[0]], tet[face[1]], tet[face[2]]};
}

/// A tet's face, in the row of its smallest node.
struct FaceOfTet {
    std::uint32_t middle, largest, tet, corner;

    std::pair<std::uint32_t, std::uint32_t> key() const { return {middle, largest}; }
    bool operator<(const FaceOfTet& other) const {
        return key() != other.key() ? key() < other.key() : tet < other.tet;
    }
};

Rows<FaceOfTet> group_faces(std::span<const glm::uvec4> tets) {
    return group_by_node<FaceOfTet>(node_bound(tets), [&](const auto& visit) {
        for (std::uint32_t t = 0; t < tets.size(); ++t) {
            for (std::uint32_t corner = 0; corner < 4; ++corner) {
                glm::uvec3 face = face_of(tets[t], corner);
                if (face[0] > face[1]) std::swap(face[0], face[1]);
                if (face[1] > face[2]) std::swap(face[1], face[2]);
                if (face[0] > face[1]) std::swap(face[0], face[1]);
                visit(face[0], FaceOfTet{face[1], face[2], t, corner});
            }
        }
    });
}

/// Calls visit(faces_of_tets) for each face with its one or two tets (in a broken mesh: more).
template <class Visit>
void for_each_face(std::span<const glm::uvec4> tets, const Visit& visit) {
    Rows<FaceOfTet> rows = group_faces(tets);
    for (std::size_t n = 0; n < rows.size(); ++n) {
        for_each_run(
            rows.row(n), [](const FaceOfTet& face) { return face.key(); }, visit);
    }
}

/// A face's edge, in the row of its smaller node.
struct EdgeOfFace {
    std::uint32_t larger, face, corner;

    bool operator<(const EdgeOfFace& other) const {
        return larger != other.larger ? larger < other.larger : face < other.face;
    }
};

}  // namespace

bool Graph::connects(std::uint32_t a, std::uint32_t b) const {
    const std::span<const std::uint32_t> neighbours = row(a);
    return std::binary_search(neighbours.begin(), neighbours.end(), b);
}

double tet_volume(const TetMesh& mesh, const glm::uvec4& tet) {
    const glm::dvec3 a = mesh.positions[tet[0]];
    const glm::dvec3 ab = mesh.positions[tet[1]] - a;
    const glm::dvec3 ac = mesh.positions[tet[2]] - a;
    const glm::dvec3 ad = mesh.positions[tet[3]] - a;
    return glm::dot(glm::cross(ab, ac), ad) / 6.0;
}

double total_volume(const TetMesh& mesh) {
    double volume = 0.0;
    for (const glm::uvec4& tet : mesh.tets) volume += tet_volume(mesh, tet);
    return volume;
}

std::size_t keep_tets(TetMesh& mesh, const std::vector<bool>& keep) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < keep.size(); ++t) {
        if (!keep[t]) continue;
        if (!mesh.attributes.empty()) mesh.attributes[kept] = mesh.attributes[t];
        mesh.tets[kept++] = mesh.tets[t];
    }
    mesh.tets.resize(kept);
    if (!mesh.attributes.empty()) mesh.attributes.resize(kept);
    return keep.size() - kept;
}

std::vector<glm::uvec2> tet_edges(std::span<const glm::uvec4> tets) {
    auto rows = group_by_node<std::uint32_t>(node_bound(tets), [&](const auto& visit) {
        for (const glm::uvec4& tet : tets) {
            for (int i = 0; i < 3; ++i) {
                for (int j = i + 1; j < 4; ++j) visit(std::min(tet[i], tet[j]), std::max(tet[i], tet[j]));
            }
        }
    });
    std::vector<glm::uvec2> edges;
    for (std::uint32_t n = 0; n < rows.size(); ++n) {
        const std::span<std::uint32_t> row = rows.row(n);
        const auto end = std::unique(row.begin(), row.end());
        for (auto other = row.begin(); other != end; ++other) edges.emplace_back(n, *other);
    }
    return edges;
}

Graph make_graph(std::size_t node_count, std::span<const glm::uvec2> edges) {
    auto rows = group_by_node<std::uint32_t>(node_count, [&](const auto& visit) {
        for (const glm::uvec2& edge : edges) {
            visit(edge[0], edge[1]);
            visit(edge[1], edge[0]);
        }
    });
    return {{rows.starts.begin(), rows.starts.end()}, std::move(rows.values)};
}

std::vector<glm::uvec3> boundary_faces(std::span<const glm::uvec4> tets) {
    std::vector<glm::uvec3> faces;
    for_each_face(tets, [&](std::span<const FaceOfTet> sides) {
        if (sides.size() == 1) faces.push_back(face_of(tets[sides[0].tet], sides[0].corner));
    });
    return faces;
}

std::vector<InnerFace> inner_faces(std::span<const glm::uvec4> tets) {
    std::vector<InnerFace> faces;
    for_each_face(tets, [&](std::span<const FaceOfTet> sides) {
        if (sides.size() != 2) return;
        const auto opposite = [&](const FaceOfTet& side) {
            return tets[side.tet][static_cast<int>(side.corner)];
        };
        faces.push_back({{sides[0].tet, sides[1].tet}, {opposite(sides[0]), opposite(sides[1])}});
    });
    return faces;
}

std::vector<SurfaceEdge> surface_edges(std::span<const glm::uvec3> faces) {
    auto rows = group_by_node<EdgeOfFace>(node_bound(faces), [&](const auto& visit) {
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = faces[f][(k + 1) % 3], b = faces[f][(k + 2) % 3];
                visit(std::min(a, b), EdgeOfFace{std::max(a, b), f, faces[f][k]});
            }
        }
    });
    std::vector<SurfaceEdge> edges;
    for (std::uint32_t n = 0; n < rows.size(); ++n) {
        const auto key = [](const EdgeOfFace& edge) { return edge.larger; };
        for_each_run(rows.row(n), key, [&](std::span<const EdgeOfFace> sides) {
            if (sides.size() != 2) return;
            edges.push_back(
                {{n, sides[0].larger}, {sides[0].face, sides[1].face}, {sides[0].corner, sides[1].corner}});
        });
    }
    return edges;
}

}  // namespace gelatin
