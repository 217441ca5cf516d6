#include "model/build/object_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/log.h"
#include "mesh/fill_surface.h"
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
};

TetMesh make_local_mesh(const ObjectDescription& object, Notes& notes) {
    const auto* file = std::get_if<FileShape>(&object.shape);
    if (file != nullptr && is_tet_file(file->file)) return read_tets(file->file, notes);
    const SurfaceMesh surface = make_surface(object.shape, notes);
    return file != nullptr ? fill_surface(surface, sized(object.mesher), file->file.string(), notes)
                           : fill_surface(surface, object.mesher, "object '" + object.name + "'", notes);
}

void warn_of_a_poor_fit(const FittedSprings& springs, const std::string& name) {
    constexpr double kMuch = 0.2;
    if (springs.softest > 1.0 - kMuch && springs.stiffest < 1.0 + kMuch) return;
    log_warning(fmt::format(
        "object '{}': on its mesh springs give {:.2f} to {:.2f} of youngs_modulus, depending on direction; "
        "more nodes across it, or tets of more even shape (mesher.max_volume, mesher.quality), help",
        name, springs.softest, springs.stiffest));
}

}  // namespace

SurfaceMesh make_surface(const Shape& shape, Notes& notes) {
    return std::visit(SurfaceMaker{notes}, shape);
}

TetMesh ObjectMesher::make(const ObjectDescription& object) {
    TetMesh mesh = local(object).mesh;
    const glm::dquat rotation = rotation_from_degrees(object.rotation);
    for (glm::dvec3& p : mesh.positions) p = rotation * (object.scale * p) + object.position;
    return mesh;
}

std::shared_ptr<const FittedSprings> ObjectMesher::fit(const ObjectDescription& object) {
    Known& known = local(object);
    if (!known.springs) {
        known.springs = std::make_shared<const FittedSprings>(SpringCache().fit(known.mesh));
        warn_of_a_poor_fit(*known.springs, object.name);
    }
    return known.springs;
}

// Searched from the last one, because copies are consecutive.
ObjectMesher::Known& ObjectMesher::local(const ObjectDescription& object) {
    const auto same = std::find_if(known_.rbegin(), known_.rend(), [&](const Known& known) {
        return known.shape == object.shape && known.mesher == object.mesher;
    });
    if (same != known_.rend()) return *same;
    Notes notes;
    TetMesh mesh = make_local_mesh(object, notes);
    for (const std::string& note : notes) log_note(fmt::format("object '{}': {}", object.name, note));
    return known_.emplace_back(Known{object.shape, object.mesher, std::move(mesh), nullptr});
}

}  // namespace gelatin
