#include "mesh/carry_surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "mesh/lattice/face_tree.h"
#include "mesh/tet_tree.h"

namespace gelatin {
namespace {

constexpr std::size_t kGrain = 256;

template <class Visit>
void for_each_in_parallel(std::size_t count, const Visit& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) visit(k);
    });
}

lattice::NearestPoint nearest_on(const lattice::FaceTree& tree, const glm::dvec3& p) {
    return *tree.find_nearest(p, std::numeric_limits<double>::infinity());
}

double largest(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// The tets at each node, ascending.
class NodeTets {
public:
    explicit NodeTets(const TetMesh& mesh) : starts_(mesh.positions.size() + 1) {
        for_each_corner(mesh, [&](std::uint32_t node, std::uint32_t) { ++starts_[node + 1]; });
        for (std::size_t n = 1; n < starts_.size(); ++n) starts_[n] += starts_[n - 1];
        tets_.resize(starts_.back());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for_each_corner(mesh, [&](std::uint32_t node, std::uint32_t tet) { tets_[next[node]++] = tet; });
    }

    std::span<const std::uint32_t> of(std::uint32_t node) const {
        return std::span(tets_).subspan(starts_[node], starts_[node + 1] - starts_[node]);
    }

private:
    template <class Visit>
    static void for_each_corner(const TetMesh& mesh, const Visit& visit) {
        for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
            for (int corner = 0; corner < 4; ++corner) visit(mesh.tets[t][corner], t);
        }
    }

    std::vector<std::uint32_t> starts_, tets_;
};

class Binding {
public:
    explicit Binding(const TetMesh& body)
        : body_(body), tets_(body), node_tets_(body), hull_({body.positions, body.faces}) {}

    // Sets the distance from the hull, too.
    CarriedVertex bind(const glm::dvec3& p, double& distance) const {
        const lattice::NearestPoint nearest = nearest_on(hull_, p);
        distance = glm::distance(p, nearest.point);
        const std::optional<TetPoint> inside = tets_.find(p);
        const TetPoint found = inside ? *inside : beyond(body_.faces[hull_.sources()[nearest.face]], p);
        return {body_.tets[found.tet], found.weights};
    }

private:
    // Of the tets at the face, the one whose weights are smallest: that of the face itself, unless it is so
    // flat that its slightest deformation would throw the vertex about.
    TetPoint beyond(const glm::uvec3& face, const glm::dvec3& p) const {
        TetPoint best{0, glm::dvec4(0.0)};
        double least = std::numeric_limits<double>::infinity();
        for (int corner = 0; corner < 3; ++corner) {
            for (const std::uint32_t tet : node_tets_.of(face[corner])) {
                const glm::dvec4 weights = barycentric(body_, body_.tets[tet], p);
                const double size = glm::dot(glm::abs(weights), glm::dvec4(1.0));
                if (!(size < least || (size == least && tet < best.tet))) continue;
                least = size;
                best = {tet, weights};
            }
        }
        return best;
    }

    const TetMesh& body_;
    TetTree tets_;
    NodeTets node_tets_;
    lattice::FaceTree hull_;
};

double hull_to_skin(const TetMesh& body, const SurfaceMesh& skin) {
    if (skin.faces.empty()) return 0.0;
    const lattice::FaceTree tree(skin);
    std::vector<bool> is_outside(body.positions.size(), false);
    for (const glm::uvec3& face : body.faces) {
        for (int corner = 0; corner < 3; ++corner) is_outside[face[corner]] = true;
    }
    std::vector<double> distances(body.positions.size(), 0.0);
    for_each_in_parallel(body.positions.size(), [&](std::size_t n) {
        const glm::dvec3& p = body.positions[n];
        if (is_outside[n]) distances[n] = glm::distance(p, nearest_on(tree, p).point);
    });
    return largest(distances);
}

}  // namespace

CarriedSurface carry_surface(const SurfaceMesh& skin, const TetMesh& body) {
    const Binding binding(body);
    CarriedSurface carried;
    carried.vertices.resize(skin.positions.size());
    std::vector<double> distances(skin.positions.size());
    for_each_in_parallel(skin.positions.size(), [&](std::size_t v) {
        carried.vertices[v] = binding.bind(skin.positions[v], distances[v]);
    });
    carried.skin_to_hull = largest(distances);
    carried.hull_to_skin = hull_to_skin(body, skin);
    return carried;
}

}  // namespace gelatin
