#include "model/object_mesh.h"

#include <algorithm>
#include <utility>

#include "core/log.h"
#include "mesh/shapes.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"
#include "mesh/tetrahedralise.h"
#include "model/transform.h"

namespace gelatin {
namespace {

struct SurfaceMaker {
    Notes& notes;
    SurfaceMesh operator()(const SphereShape& shape) const { return make_sphere(shape); }
    SurfaceMesh operator()(const BoxShape& shape) const { return make_box(shape); }
    SurfaceMesh operator()(const CapsuleShape& shape) const { return make_capsule(shape); }
    SurfaceMesh operator()(const TextShape& shape) const { return make_text(shape); }
    SurfaceMesh operator()(const FileShape& shape) const { return read_surface(shape.file, notes); }
};

TetMesh make_local_mesh(const ObjectDescription& object, Notes& notes) {
    const auto* file = std::get_if<FileShape>(&object.shape);
    if (file != nullptr && is_tet_file(file->file)) return read_tets(file->file, notes);
    const SurfaceMesh surface = std::visit(SurfaceMaker{notes}, object.shape);
    return tetrahedralise(surface, object.mesher,
                          file != nullptr ? file->file.string() : "object '" + object.name + "'");
}

}  // namespace

TetMesh ObjectMesher::make(const ObjectDescription& object) {
    TetMesh mesh = local_mesh(object);
    const glm::dquat rotation = rotation_from_degrees(object.rotation);
    for (glm::dvec3& p : mesh.positions) p = rotation * (object.scale * p) + object.position;
    return mesh;
}

// Searched from the last one on: copies follow one another.
const TetMesh& ObjectMesher::local_mesh(const ObjectDescription& object) {
    const auto same = std::find_if(known_.rbegin(), known_.rend(), [&](const Known& known) {
        return known.shape == object.shape && known.mesher == object.mesher;
    });
    if (same != known_.rend()) return same->mesh;
    Notes notes;
    TetMesh mesh = make_local_mesh(object, notes);
    for (const std::string& note : notes) spdlog::warn("object '{}': {}", object.name, note);
    return known_.emplace_back(Known{object.shape, object.mesher, std::move(mesh)}).mesh;
}

}  // namespace gelatin
