#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/carry_surface.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"
#include "model/assembly/scene_meshes.h"
#include "model/springs/fit_springs.h"

namespace gelatin {

/// A shape's own surface, and how its tets carry it. No position, rotation or scale changes that.
struct ShapeSkin {
    std::vector<glm::uvec3> faces;        ///< between vertices, in the order of the file
    std::vector<CarriedVertex> vertices;  ///< by the indices of the tets' nodes
    double distance;                      ///< at most, between it and the boundary of the tets [m]
    SurfaceLook look = {};                ///< of the faces
};

/// Makes the tets of objects, their skins, and the springs fitted to them, once for all objects with the same
/// shape and mesher.
class ObjectMesher {
public:
    /// @param made for some of the shapes already; null: for none
    /// @param up the scene's up axis
    explicit ObjectMesher(std::shared_ptr<const SceneMeshes> made = {}, Axis up = Axis::y)
        : made_(std::move(made)), up_(up) {}

    /// The tets of an object in the scene: its shape or file, filled by the mesher if it is a surface, then
    /// scaled, rotated and moved to its position. Repairs go to the log, one line each.
    /// @throws InvalidInput for files that cannot be read, surfaces that cannot be filled, flat or inverted
    ///   results.
    TetMesh make(const ObjectDescription& object);

    /// The object's own surface. Null where the boundary of the tets is the same and the surface has no
    /// texture coordinates or materials; where the object does not want it; and for shapes with tets. The log
    /// says how far the two are apart.
    /// @throws as make
    std::shared_ptr<const ShapeSkin> skin(const ObjectDescription& object);

    /// The springs fitted to the object's tets before scaling, from the cache on disk if they are there. If
    /// the mesh allows no good fit, the log says so.
    /// @throws as make
    std::shared_ptr<const FittedSprings> fit(const ObjectDescription& object);

    /// The surface of a collider, not placed yet; of tets, their boundary. Repairs go to the log.
    /// @throws InvalidInput for files that cannot be read
    const SurfaceMesh& surface(const Shape& shape, const std::string& name);

    /// All that was asked for.
    SceneMeshes meshes() const;

private:
    struct Known {
        std::shared_ptr<const ShapeMesh> made;
        std::optional<std::shared_ptr<const ShapeSkin>> skin;  // empty until it is requested
        std::shared_ptr<const FittedSprings> springs;          // empty until they are requested
    };
    Known& local(const ObjectDescription& object);

    std::shared_ptr<const SceneMeshes> made_;
    Axis up_;
    std::vector<Known> known_;  // of bodies
    std::vector<std::shared_ptr<const ShapeMesh>> surfaces_;
};

}  // namespace gelatin
