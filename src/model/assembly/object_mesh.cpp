#include "model/assembly/object_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/log.h"
#include "mesh/fill_surface.h"
#include "mesh/mesh_in_memory.h"
#include "mesh/shapes.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "model/springs/spring_cache.h"
#include "model/transform.h"

namespace gelatin {
namespace {

struct SurfaceMaker {
    Notes& notes;
    SurfaceMesh operator()(const SphereShape& shape) const { return make_sphere(shape); }
    SurfaceMesh operator()(const BoxShape& shape) const { return make_box(shape); }
    SurfaceMesh operator()(const CapsuleShape& shape) const { return make_capsule(shape); }
    SurfaceMesh operator()(const TextShape& shape) const { return make_text(shape); }
    SurfaceMesh operator()(const FileShape& shape) const {
        if (!is_tet_file(shape.file)) return read_surface(shape.file, notes);
        const TetMesh tets = read_tets(shape.file, notes);
        return {tets.positions, tets.faces};
    }
    SurfaceMesh operator()(const MeshShape& shape) const {
        const std::string name = "a mesh in memory";
        if (shape.mesh->tets.empty()) return surface_in_memory(*shape.mesh, name, notes);
        const TetMesh tets = tets_in_memory(*shape.mesh, name, notes);
        return {tets.positions, tets.faces};
    }
};

std::string name_of(const ObjectDescription& object) {
    return "object '" + object.name + "'";
}

// Of a shape that has tets already.
std::optional<TetMesh> tets_of(const ObjectDescription& object, Notes& notes) {
    if (const auto* file = std::get_if<FileShape>(&object.shape); file && is_tet_file(file->file))
        return read_tets(file->file, notes);
    if (const auto* mesh = std::get_if<MeshShape>(&object.shape); mesh && !mesh->mesh->tets.empty())
        return tets_in_memory(*mesh->mesh, name_of(object), notes);
    return {};
}

TetMesh fill(const SurfaceMesh& surface, const ObjectDescription& object, Notes& notes) {
    // Triangles of others were not made for a simulation.
    if (const auto* file = std::get_if<FileShape>(&object.shape))
        return fill_surface(surface, sized(object.mesher), file->file.string(), notes);
    const bool is_others = std::holds_alternative<MeshShape>(object.shape);
    return fill_surface(surface, is_others ? sized(object.mesher) : object.mesher, name_of(object), notes);
}

double extent_of(const SurfaceMesh& surface) {
    glm::dvec3 low = surface.positions.front(), high = low;
    for (const glm::dvec3& p : surface.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::distance(low, high);
}

double longest_edge(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& faces) {
    double longest = 0.0;
    for (const glm::uvec3& face : faces) {
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, glm::distance(positions[face[k]], positions[face[(k + 1) % 3]]));
    }
    return longest;
}

void note_skin(const ObjectDescription& object, const SurfaceMesh& surface, const TetMesh& mesh,
               double distance) {
    constexpr double kMuchLonger = 2.0;
    log_note(fmt::format(
        "object '{}': {} faces are drawn; it collides with a hull of {} faces, at most {:.2g} m away",
        object.name, surface.faces.size(), mesh.faces.size(), object.scale * distance));
    const double drawn = longest_edge(surface.positions, surface.faces);
    const double hull = longest_edge(mesh.positions, mesh.faces);
    if (drawn <= kMuchLonger * hull) return;
    log_note(fmt::format(
        "object '{}': faces that are drawn are up to {:.2g} m long, and stay flat where the hull bends, "
        "whose faces are up to {:.2g} m long; skin = false draws the hull",
        object.name, object.scale * drawn, object.scale * hull));
}

// Null where the boundary of the tets is the same surface; TetGen only divides its faces.
std::shared_ptr<const ShapeSkin> make_skin(const ObjectDescription& object, const SurfaceMesh& surface,
                                           const TetMesh& mesh) {
    constexpr double kSame = 1e-6;  // of the extent
    CarriedSurface carried = carry_surface(surface, mesh);
    const double distance = std::max(carried.skin_to_hull, carried.hull_to_skin);
    const bool is_plain = surface.look.is_empty() && surface.look.corner_uvs.empty();
    if (is_plain && distance <= kSame * extent_of(surface)) return nullptr;
    note_skin(object, surface, mesh, distance);
    return std::make_shared<const ShapeSkin>(
        ShapeSkin{surface.faces, std::move(carried.vertices), distance, surface.look});
}

// The first one of which that holds; null: there is none.
template <class Predicate>
std::shared_ptr<const ShapeMesh> find_mesh(const SceneMeshes* made, const Predicate& holds) {
    if (made == nullptr) return nullptr;
    const auto found =
        std::find_if(made->all.begin(), made->all.end(), [&](const auto& mesh) { return holds(*mesh); });
    return found != made->all.end() ? *found : nullptr;
}

bool is_body(const ShapeMesh& mesh) {
    return !mesh.tets.tets.empty();
}

ShapeMesh make_mesh(const ObjectDescription& object, const SceneMeshes* made, Notes& notes) {
    ShapeMesh mesh{object.shape, object.mesher, {}, {}};
    const auto is_like = [&](const ShapeMesh& each) { return is_body(each) && each.shape == object.shape; };
    if (const auto like = find_mesh(made, is_like)) {  // by another mesher
        mesh.surface = like->surface;
        if (like->surface.faces.empty()) mesh.tets = like->tets;
    } else if (std::optional<TetMesh> tets = tets_of(object, notes)) {
        mesh.tets = std::move(*tets);
    } else {
        mesh.surface = std::visit(SurfaceMaker{notes}, object.shape);
    }
    if (mesh.tets.tets.empty()) mesh.tets = fill(mesh.surface, object, notes);
    return mesh;
}

void log_notes(const std::string& name, const Notes& notes) {
    for (const Note& note : notes)
        (note.is_warning ? log_warning : log_note)(fmt::format("{}: {}", name, note.text));
}

void warn_of_a_poor_fit(const FittedSprings& springs, const std::string& name) {
    constexpr double kMuchSofter = 0.2;
    if (springs.softest > 1.0 - kMuchSofter && springs.stiffest < 1.0 + kMuchSofter) return;
    log_warning(fmt::format(
        "object '{}': on its mesh springs give {:.2f} to {:.2f} of youngs_modulus, depending on direction; "
        "more nodes across it, or tets of more even shape (mesher.max_volume, mesher.quality), help",
        name, springs.softest, springs.stiffest));
}

}  // namespace

TetMesh ObjectMesher::make(const ObjectDescription& object) {
    TetMesh mesh = local(object).made->tets;
    const glm::dquat rotation = orientation_of(object, up_);
    for (glm::dvec3& p : mesh.positions) p = rotation * (object.scale * p) + object.position;
    return mesh;
}

std::shared_ptr<const ShapeSkin> ObjectMesher::skin(const ObjectDescription& object) {
    Known& known = local(object);
    if (!object.skin || known.made->surface.faces.empty()) return nullptr;
    if (!known.skin) known.skin = make_skin(object, known.made->surface, known.made->tets);
    return *known.skin;
}

std::shared_ptr<const FittedSprings> ObjectMesher::fit(const ObjectDescription& object) {
    Known& known = local(object);
    if (!known.springs) {
        known.springs = std::make_shared<const FittedSprings>(SpringCache().fit(known.made->tets));
        warn_of_a_poor_fit(*known.springs, object.name);
    }
    return known.springs;
}

const SurfaceMesh& ObjectMesher::surface(const Shape& shape, const std::string& name) {
    const auto is_same = [&](const auto& known) { return known->shape == shape; };
    const auto same = std::find_if(surfaces_.rbegin(), surfaces_.rend(), is_same);
    if (same != surfaces_.rend()) return (*same)->surface;
    const auto fits = [&](const ShapeMesh& mesh) { return !is_body(mesh) && mesh.shape == shape; };
    if (std::shared_ptr<const ShapeMesh> made = find_mesh(made_.get(), fits))
        return surfaces_.emplace_back(std::move(made))->surface;
    Notes notes;
    ShapeMesh made{shape, {}, std::visit(SurfaceMaker{notes}, shape), {}};
    log_notes(name, notes);
    return surfaces_.emplace_back(std::make_shared<const ShapeMesh>(std::move(made)))->surface;
}

SceneMeshes ObjectMesher::meshes() const {
    SceneMeshes result{surfaces_};
    for (const Known& known : known_) result.all.push_back(known.made);
    return result;
}

// Searched from the last one, because copies are consecutive.
ObjectMesher::Known& ObjectMesher::local(const ObjectDescription& object) {
    const auto fits = [&](const ShapeMesh& mesh) {
        return is_body(mesh) && mesh.shape == object.shape && mesh.mesher == object.mesher;
    };
    const auto same =
        std::find_if(known_.rbegin(), known_.rend(), [&](const Known& known) { return fits(*known.made); });
    if (same != known_.rend()) return *same;
    std::shared_ptr<const ShapeMesh> made = find_mesh(made_.get(), fits);
    if (made == nullptr) {
        Notes notes;
        made = std::make_shared<const ShapeMesh>(make_mesh(object, made_.get(), notes));
        log_notes(name_of(object), notes);
    }
    return known_.emplace_back(Known{std::move(made), {}, nullptr});
}

}  // namespace gelatin
