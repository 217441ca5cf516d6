#include "model/assembly/pack_skin.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/assembly/draw_surface.h"

namespace gelatin {
namespace {

std::uint32_t size_of(const auto& array) {
    return static_cast<std::uint32_t>(array.size());
}

void append_faces(Skin& skin, const Range& points, std::uint32_t object, auto&& faces) {
    const std::uint32_t first = size_of(skin.faces);
    for (const glm::uvec3& f : faces)
        skin.faces.push_back({f.x + points.first, f.y + points.first, f.z + points.first, object});
    skin.objects.push_back({points, {first, size_of(skin.faces) - first}});
}

// Copies share theirs.
std::uint32_t place_of(const SurfaceMaterial& material, std::vector<SurfaceMaterial>& materials) {
    const auto same = std::find_if(materials.begin(), materials.end(), [&](const SurfaceMaterial& m) {
        return m.name == material.name && m.color == material.color && m.image == material.image;
    });
    if (same != materials.end()) return static_cast<std::uint32_t>(same - materials.begin());
    materials.push_back(material);
    return size_of(materials) - 1;
}

// Before the faces, whose places in the list are still free.
void append_look(Skin& skin, const SurfaceLook& from, bool has_materials) {
    SurfaceLook& look = skin.look;
    if (has_materials && !from.face_materials.empty()) {
        look.face_materials.resize(skin.faces.size(), SurfaceLook::kNone);
        for (const std::uint32_t m : from.face_materials)
            look.face_materials.push_back(
                m == SurfaceLook::kNone ? m : place_of(from.materials[m], look.materials));
    }
    if (!from.corner_uvs.empty()) {
        look.corner_uvs.resize(skin.faces.size());
        look.corner_uvs.insert(look.corner_uvs.end(), from.corner_uvs.begin(), from.corner_uvs.end());
    }
}

// Those without a material first, then material by material.
void sort_triangles(const SurfaceLook& look, DrawSurface& surface) {
    std::vector<std::uint32_t> order(surface.triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto rank = [&](std::uint32_t face) { return look.face_materials[face] + 1; };  // kNone + 1 is 0
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    std::vector<glm::uvec3> sorted;
    for (const std::uint32_t face : order) {
        const std::uint32_t material = look.face_materials[face];
        const bool is_same = !surface.materials.empty() && surface.materials.back().material == material;
        if (!is_same && material != SurfaceLook::kNone)
            surface.materials.push_back({{size_of(sorted), 0}, material});
        if (material != SurfaceLook::kNone) ++surface.materials.back().triangles.count;
        sorted.push_back(surface.triangles[face]);
    }
    surface.triangles = std::move(sorted);
}

}  // namespace

void append_skin(const ShapeSkin& shape, double scale, std::span<const std::uint32_t> new_index,
                 Model& model) {
    Skin& skin = model.skin;
    const std::uint32_t first = model.objects.back().nodes.first;
    const Range points{size_of(skin.points), size_of(shape.vertices)};
    for (const CarriedVertex& v : shape.vertices) {
        const auto node = [&](int k) { return first + new_index[v.nodes[k]]; };
        skin.points.push_back({node(0), node(1), node(2), node(3), glm::vec4(v.weights)});
    }
    append_look(skin, shape.look, model.objects.back().color.r < 0.0f);
    append_faces(skin, points, size_of(model.objects) - 1, shape.faces);
    skin.objects.back().distance = scale * shape.distance;
}

void append_hull(const Model& model, std::size_t o, Skin& skin) {
    const ModelObject& object = model.objects[o];
    const auto own = std::span(model.faces).subspan(object.faces.first, object.faces.count);
    std::vector<std::uint32_t> nodes;
    for (const Face& face : own) nodes.insert(nodes.end(), {face.a, face.b, face.c});
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());

    const Range points{size_of(skin.points), size_of(nodes)};
    for (const std::uint32_t n : nodes)
        skin.points.push_back({n, n, n, n, glm::vec4(1.0f, 0.0f, 0.0f, 0.0f)});
    const auto place = [&](std::uint32_t node) {
        return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    std::vector<glm::uvec3> faces;
    for (const Face& face : own) faces.emplace_back(place(face.a), place(face.b), place(face.c));
    append_faces(skin, points, static_cast<std::uint32_t>(o), faces);
}

void finish_skin(const Model& model, Skin& skin) {
    SurfaceLook& look = skin.look;
    if (!look.corner_uvs.empty()) look.corner_uvs.resize(skin.faces.size());
    if (!look.face_materials.empty()) look.face_materials.resize(skin.faces.size(), SurfaceLook::kNone);
    // Materials without an image need coordinates, too: of a texture of one colour.
    const std::vector<std::array<glm::vec2, 3>> none(look.is_empty() ? 0 : skin.faces.size());
    const auto& uvs = look.is_empty() || look.corner_uvs.empty() ? none : look.corner_uvs;
    const std::vector<glm::vec4> at_rest = carry_skin(skin.points, std::span(model.positions));
    for (const SkinObject& object : skin.objects)
        append_draw_surface(at_rest, skin.faces, object.faces, kCreaseAngle, skin.surface, uvs);
    if (!look.is_empty()) sort_triangles(look, skin.surface);
}

Skin make_hulls(const Model& model) {
    Skin skin;
    for (std::size_t o = 0; o < model.objects.size(); ++o) append_hull(model, o, skin);
    return skin;
}

}  // namespace gelatin
