#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "cpu/contact/contact_pair.h"
#include "cpu/contact/tuning.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Decides which pairs press where surfaces are near each other, so that no place of a surface counts twice:
/// a pair presses where the line between its nearest points leaves both surfaces within their feasible
/// regions (Chen et al. 2025, "Offset Geometric Contact").
template <class Real>
class FeasibleRegion {
public:
    FeasibleRegion(const Model& model, const ContactSurface& surface, std::span<const Vec4<Real>> positions)
        : model_(model), surface_(surface), positions_(positions) {}

    /// @param apart from the first side's nearest point to the second's [m] @param weights of the nodes
    /// @return from 0 to 1: how much of the pair's stiffness it has
    Real weight(const ContactPair& pair, const Vec3<Real>& apart, const Vec4<Real>& weights) const {
        return pair.is_edges() ? weight_of_edges(pair, apart, weights)
                               : Real(presses_face(pair, apart, weights) ? 1 : 0);
    }

    /// A node presses edges and corners of faces where no edge from it leads much towards them. Those that
    /// slide over a flat surface are ahead of its nodes before they are above them, and a step that goes on
    /// along that line would stop them.
    /// @return from 0 to 1
    Real weight_of_node(std::uint32_t node, const Vec3<Real>& apart) const {
        const NodeFaces& around = model_.node_faces;
        const Real distance = glm::length(apart);
        Real weight = 1;
        for (std::uint32_t p = around.starts[node]; p < around.starts[node + 1]; ++p) {
            const Face& face = model_.faces[around.faces[p]];
            for (const std::uint32_t n : {face.a, face.b, face.c}) {
                const Vec3<Real> edge = at(n) - at(node);
                if (n != node)
                    weight = std::min(
                        weight, Real(2) - glm::dot(apart, edge) / (kSoftened * distance * glm::length(edge)));
            }
        }
        return std::max(weight, Real(0));
    }

    /// How nearly the line is along the normal of the pair's face: from 0 to 1.
    Real weight_along_normal(const ContactPair& pair, const Vec3<Real>& apart) const {
        const Vec3<Real> a = at(pair.nodes[1]);
        const Vec3<Real> normal = glm::cross(at(pair.nodes[2]) - a, at(pair.nodes[3]) - a);
        const Real sine = glm::length(glm::cross(normal, apart)) / (glm::length(normal) * glm::length(apart));
        return std::clamp(Real(2) - sine / kSoftened, Real(0), Real(1));
    }

private:
    static constexpr Real kSoftened = static_cast<Real>(tuning::kSoftened);
    static constexpr Real kOnEdge = static_cast<Real>(tuning::kHardly);

    Vec3<Real> at(std::uint32_t node) const { return Vec3<Real>(positions_[node]); }

    // Nearest points at ends belong to nodes and faces. An edge presses away from both its faces. The weight
    // falls gradually, because a hard limit would leave edges that are nearly flat without any force.
    Real weight_of_edges(const ContactPair& pair, const Vec3<Real>& apart, const Vec4<Real>& weights) const {
        for (int k = 0; k < 4; ++k)
            if (!(weights[k] > Real(0))) return Real(0);
        Real weight = 1;
        const Real distance = glm::length(apart);
        for (std::size_t side = 0; side < 2; ++side) {
            const glm::uvec2& beside = surface_.beside_edges[side == 0 ? pair.first : pair.second];
            const Vec3<Real> a = at(pair.nodes[2 * side]), edge = at(pair.nodes[2 * side + 1]) - a;
            for (int k = 0; k < 2; ++k) {
                if (beside[k] == kNoNode) continue;
                Vec3<Real> inwards = at(beside[k]) - a;
                inwards -= glm::dot(inwards, edge) / glm::dot(edge, edge) * edge;
                const Real size = distance * glm::length(inwards);
                if (!(size > Real(0))) return Real(0);
                const Real cosine = glm::dot(side == 0 ? apart : -apart, inwards) / size;
                weight = std::min(weight, Real(0.5f) - cosine / (2 * kSoftened));
            }
        }
        return std::max(weight, Real(0));
    }

    // Within the face, always. At one of its edges or corners, by the lowest of the faces there alone, and
    // only where no face there is nearer.
    bool presses_face(const ContactPair& pair, const Vec3<Real>& apart, const Vec4<Real>& weights) const {
        const std::array<Vec3<Real>, 3> corners{at(pair.nodes[1]), at(pair.nodes[2]), at(pair.nodes[3])};
        const Vec3<Real> normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const Real size = glm::length(normal), least = kOnEdge * glm::length(apart);
        std::array<bool, 3> is_off{};
        for (std::size_t k = 0; k < 3; ++k) {
            const Real edge = glm::distance(corners[(k + 1) % 3], corners[(k + 2) % 3]);
            is_off[k] = weights[static_cast<int>(k) + 1] * size <= least * edge;
        }
        const auto count = std::count(is_off.begin(), is_off.end(), true);
        if (count == 0) return true;
        if (count == 1) return presses_edge(pair, apart, is_off[2] ? 0u : is_off[0] ? 1u : 2u);
        return presses_corner(pair, apart, is_off[0] ? (is_off[1] ? 2u : 1u) : 0u);
    }

    // @param k the edge of the face from corner k to k + 1
    bool presses_edge(const ContactPair& pair, const Vec3<Real>& apart, std::uint32_t k) const {
        const CornerAcross& across = surface_.across[3 * pair.second + k];
        if (across.face == kNoNode) return true;
        return across.face > pair.second && leads_away(apart, at(across.corner) - at(pair.nodes[1 + k]));
    }

    bool presses_corner(const ContactPair& pair, const Vec3<Real>& apart, std::uint32_t k) const {
        const std::uint32_t corner = pair.nodes[1 + k];
        const NodeFaces& around = model_.node_faces;
        if (around.faces[around.starts[corner]] != pair.second) return false;
        for (std::uint32_t p = around.starts[corner]; p < around.starts[corner + 1]; ++p) {
            const Face& face = model_.faces[around.faces[p]];
            for (const std::uint32_t n : {face.a, face.b, face.c})
                if (n != corner && !leads_away(apart, at(n) - at(corner))) return false;
        }
        return true;
    }

    // Whether what is that way from the nearest point is not nearer.
    static bool leads_away(const Vec3<Real>& apart, const Vec3<Real>& way) {
        return glm::dot(apart, way) >= -kOnEdge * glm::length(apart) * glm::length(way);
    }

    const Model& model_;
    const ContactSurface& surface_;
    std::span<const Vec4<Real>> positions_;
};

}  // namespace gelatin::cpu
