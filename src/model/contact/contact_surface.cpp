#include "model/contact/contact_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <tuple>

#include "model/collision/surface_parts.h"
#include "model/corners.h"

namespace gelatin {
namespace {

constexpr double kThickness = 0.05;  // of the median edge
constexpr double kOfRigid = 0.005;   // at most, of a rigid body's size: its faces may be as large as it is

// One side of a surface edge: face 3 f + k, from corner k to k + 1.
struct HalfEdge {
    std::uint32_t low, high, index;
    bool same_edge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<HalfEdge> sorted_half_edges(const Model& model) {
    std::vector<HalfEdge> halves;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        const auto corners = corners_of(model.faces[f]);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % 3]);
            halves.push_back({low, high, 3 * f + k});
        }
    }
    std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::array{a.low, a.high, a.index} < std::array{b.low, b.high, b.index};
    });
    return halves;
}

std::uint32_t opposite_corner(const Model& model, std::uint32_t half) {
    return corners_of(model.faces[half / 3])[(half % 3 + 2) % 3];
}

void add_neighbors(const Model& model, ContactSurface& surface) {
    const std::vector<HalfEdge> halves = sorted_half_edges(model);
    surface.across.resize(3 * model.faces.size());
    for (std::size_t first = 0, end = 0; first < halves.size(); first = end) {
        for (end = first + 1; end < halves.size() && halves[end].same_edge(halves[first]);) ++end;
        if (end != first + 2) continue;
        const std::uint32_t a = halves[first].index, b = halves[first + 1].index;
        surface.across[a] = {b / 3, opposite_corner(model, b)};
        surface.across[b] = {a / 3, opposite_corner(model, a)};
    }
    for (const FaceEdge& edge : model.surface_parts.edges) {
        const auto before = [](const HalfEdge& half, const FaceEdge& e) {
            return std::array{half.low, half.high} < std::array{e.a, e.b};
        };
        glm::uvec2 beside(kNoNode);
        auto half = std::lower_bound(halves.begin(), halves.end(), edge, before);
        for (int k = 0; k < 2 && half != halves.end() && half->low == edge.a && half->high == edge.b;
             ++k, ++half)
            beside[k] = opposite_corner(model, half->index);
        surface.beside_edges.push_back(beside);
    }
}

// A spring's second derivative along itself is its stiffness, and none at right angles at rest.
void add_springs(const Model& model, std::vector<double>& traces) {
    for (const Spring& spring : model.springs) {
        traces[spring.i] += static_cast<double>(spring.stiffness);
        traces[spring.j] += static_cast<double>(spring.stiffness);
    }
}

// With g the gradient of the node's shape function, V (mu g^2 1 + (lambda + mu) g g^T) at small strains; of
// the volume term at most V kappa g g^T.
void add_tets(const Model& model, std::vector<double>& traces) {
    for (const NeoHookeanTet& tet : model.neo_hookean_tets) {
        const auto volume = static_cast<double>(tet.gradient_1.w), mu = static_cast<double>(tet.gradient_2.w),
                   lambda = static_cast<double>(tet.gradient_3.w);
        const double lame_mu = 0.75 * mu, lame_lambda = lambda - 5.0 / 6.0 * lame_mu;  // neo_hookean_moduli
        const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
        const glm::uvec4 nodes = nodes_of(tet);
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3& g = gradients[static_cast<std::size_t>(k)];
            traces[nodes[k]] += volume * (4.0 * lame_mu + lame_lambda) * glm::dot(g, g);
        }
    }
    if (model.volume_term.is_empty()) return;
    for (std::size_t t = 0; t < model.tets.size(); ++t) {
        const glm::uvec4& tet = model.tets[t];
        const auto volume = static_cast<double>(model.tet_rests[t].volume),
                   kappa = static_cast<double>(model.volume_term.tets[t]);
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3 a(model.positions[tet[(k + 1) % 4]]), b(model.positions[tet[(k + 2) % 4]]),
                c(model.positions[tet[(k + 3) % 4]]);
            const double gradient = glm::length(glm::cross(b - a, c - a)) / (6.0 * volume);
            traces[tet[k]] += volume * kappa * gradient * gradient;
        }
    }
}

// What a rigid body lies on bears what is on it, too. Sides have the stiffness of their area, however many
// nodes they have; a node by itself has enough to carry its body.
std::vector<float> find_bearing(const Model& model, const std::vector<std::uint32_t>& places) {
    constexpr double kOfShare = 128.0;  // with 8 a stack of twenty boxes sways for ten seconds
    constexpr double kLeast = 0.25;     // with more the edges of a ball of faces brake it
    std::vector<float> bearing(model.node_count());
    for (const ModelObject& object : model.bodies()) {
        if (!object.is_rigid) continue;
        double sum = 0.0;
        const auto for_surface = [&](const auto& visit) {
            for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
                if (places[n] != kNoNode) visit(n, static_cast<double>(model.masses[n]));
        };
        for_surface([&](std::uint32_t, double mass) { sum += mass; });
        for_surface([&](std::uint32_t n, double mass) {
            bearing[n] = static_cast<float>(std::max(kOfShare * mass / sum, kLeast) * object.mass);
        });
    }
    return bearing;
}

std::vector<double> find_thicknesses(const Model& model) {
    std::vector<double> thicknesses;
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const ModelObject& object = model.objects[o];
        double usual = model.is_body(o) ? kThickness * median_edge(model, o, model.positions) : 0.0;
        if (object.is_rigid) usual = std::min(usual, kOfRigid * std::cbrt(object.rest_volume));
        thicknesses.push_back(object.surface.thickness.value_or(usual));
    }
    return thicknesses;
}

// In one piece, with all edges convex: no corner across an edge is above the plane of the face, but for
// rounding. That is enough for a closed surface that does not pass through itself.
bool is_convex(const Model& model, const ContactSurface& surface, const Range& faces) {
    if (faces.count == 0) return false;
    constexpr double kOfEdge = 1e-5, kOfPlace = 1e-6;
    const auto position = [&](std::uint32_t n) { return glm::dvec3(model.positions[n]); };
    std::vector<std::uint8_t> is_reached(faces.count);
    std::vector<std::uint32_t> reached = {faces.first};
    is_reached[0] = 1;
    for (std::size_t next = 0; next < reached.size(); ++next) {
        const std::uint32_t f = reached[next];
        const auto corners = corners_of(model.faces[f]);
        const glm::dvec3 a = position(corners[0]), ab = position(corners[1]) - a,
                         ac = position(corners[2]) - a;
        const glm::dvec3 normal = glm::cross(ab, ac);
        const glm::dvec3 size = glm::abs(a);
        const double most = kOfEdge * glm::length(ab) + kOfPlace * std::max({size.x, size.y, size.z});
        for (std::uint32_t k = 0; k < 3; ++k) {
            const CornerAcross& across = surface.across[3 * f + k];
            if (across.face == kNoNode) return false;
            const glm::dvec3 to = position(across.corner) - a;
            if (glm::dot(normal, to) > most * glm::length(normal)) return false;
            std::uint8_t& is_known = is_reached[across.face - faces.first];
            if (is_known == 0) reached.push_back(across.face);
            is_known = 1;
        }
    }
    return reached.size() == faces.count;
}

// What a kind has by itself.
struct Kind {
    std::string material;
    ContactSurface::Touch own;
    bool is_collider = false;
};

std::vector<Kind> find_kinds(const Model& model, const CollisionSettings& usual,
                             std::vector<std::uint32_t>& kinds) {
    std::vector<Kind> all;
    std::map<std::tuple<std::string, double, double, double>, std::uint32_t> known;
    for (std::size_t o = 0; o < model.body_count(); ++o) {
        const BodySurface& surface = model.objects[o].surface;
        const ContactSurface::Touch own{surface.friction.value_or(usual.friction), surface.contact_stiffness,
                                        surface.restitution.value_or(usual.restitution)};
        const auto [place, is_new] =
            known.try_emplace({surface.material, own.friction, own.stiffness, own.restitution},
                              static_cast<std::uint32_t>(all.size()));
        if (is_new) all.push_back({surface.material, own});
        kinds.push_back(place->second);
    }
    for (const RigidSurface& collider : model.surfaces) {
        kinds.push_back(static_cast<std::uint32_t>(all.size()));
        all.push_back({{}, {collider.friction, 1.0, collider.restitution}, true});
    }
    return all;
}

ContactSurface::Touch touch_of(const Kind& a, const Kind& b, const std::vector<MaterialPair>& pairs) {
    if (a.is_collider) return {a.own.friction, b.own.stiffness, a.own.restitution};
    if (b.is_collider) return {b.own.friction, a.own.stiffness, b.own.restitution};
    ContactSurface::Touch touch{std::sqrt(a.own.friction * b.own.friction),
                                std::sqrt(a.own.stiffness * b.own.stiffness),
                                std::sqrt(a.own.restitution * b.own.restitution)};
    for (const MaterialPair& pair : pairs) {
        if (std::minmax(pair.first, pair.second) != std::minmax(a.material, b.material)) continue;
        touch.friction = pair.friction.value_or(touch.friction);
        touch.stiffness = pair.contact_stiffness.value_or(touch.stiffness);
        touch.restitution = pair.restitution.value_or(touch.restitution);
    }
    return touch;
}

}  // namespace

std::vector<float> stiffnesses_at_rest(const Model& model) {
    std::vector<double> traces(model.node_count());
    add_springs(model, traces);
    add_tets(model, traces);
    std::vector<float> stiffnesses;
    for (const double trace : traces) stiffnesses.push_back(static_cast<float>(trace / 3.0));
    return stiffnesses;
}

ContactSurface make_contact_surface(const Model& model, const CollisionSettings& collision) {
    ContactSurface surface;
    surface.places = places_on_surface(model);
    add_neighbors(model, surface);
    surface.stiffness = stiffnesses_at_rest(model);
    surface.bearing = find_bearing(model, surface.places);
    surface.thicknesses = find_thicknesses(model);
    surface.is_convex.resize(model.objects.size());
    for (std::size_t o = 0; o < model.body_count(); ++o)
        surface.is_convex[o] = is_convex(model, surface, model.objects[o].faces) ? 1 : 0;
    const std::vector<Kind> kinds = find_kinds(model, collision, surface.kinds);
    surface.kind_count = static_cast<std::uint32_t>(kinds.size());
    for (const Kind& a : kinds)
        for (const Kind& b : kinds) surface.touches.push_back(touch_of(a, b, collision.pairs));
    return surface;
}

}  // namespace gelatin
