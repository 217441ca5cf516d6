#pragma once

#include <memory>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"
#include "model/springs/fit_springs.h"

namespace gelatin {

/// The surface of a shape, as it is before it is placed; of a file with tets, that of the tets.
/// @throws InvalidInput for files that cannot be read
SurfaceMesh make_surface(const Shape& shape, Notes& notes);

/// Makes the tets of objects and fits springs to them, once for all objects with the same shape and mesher.
class ObjectMesher {
public:
    /// The tets of an object in the scene: its shape or file, filled by the mesher if it is a surface, then
    /// scaled, rotated and moved to its position. Repairs go to the log, one line each.
    /// @throws InvalidInput for files that cannot be read, surfaces that cannot be filled, flat or inverted
    ///   results.
    TetMesh make(const ObjectDescription& object);

    /// The springs fitted to the object's tets before scaling, from the cache on disk if they are there. If
    /// the mesh allows no good fit, the log says so.
    /// @throws as make
    std::shared_ptr<const FittedSprings> fit(const ObjectDescription& object);

private:
    struct Known {
        Shape shape;
        MesherSettings mesher;
        TetMesh mesh;                                  // as the shape defines it, not placed yet
        std::shared_ptr<const FittedSprings> springs;  // empty until they are requested
    };
    Known& local(const ObjectDescription& object);

    std::vector<Known> known_;
};

}  // namespace gelatin
