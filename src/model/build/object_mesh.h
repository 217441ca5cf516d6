#pragma once

#include <memory>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"
#include "model/springs/fit_springs.h"

namespace gelatin {

/// Makes the tets of objects and fits springs to them, once for all that have the same shape and mesher.
class ObjectMesher {
public:
    /// The tets of an object where the scene puts it: its shape or file, through the mesher where it is a
    /// surface, then scaled, turned and moved. Repairs go to the log, one line each.
    /// @throws InvalidInput for files that cannot be read, surfaces that cannot be filled, flat or inverted
    /// results.
    TetMesh make(const ObjectDescription& object);

    /// The springs fitted to the object's tets before it is scaled; from the cache on disk where they are
    /// there. Where the mesh lets no fit be good, that goes to the log.
    /// @throws as make
    std::shared_ptr<const FittedSprings> fit(const ObjectDescription& object);

private:
    struct Known {
        Shape shape;
        MesherSettings mesher;
        TetMesh mesh;                                  // as the shape says, not placed yet
        std::shared_ptr<const FittedSprings> springs;  // empty until somebody asks
    };
    Known& local(const ObjectDescription& object);

    std::vector<Known> known_;
};

}  // namespace gelatin
