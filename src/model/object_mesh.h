#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Makes the tets of objects, once for all that have the same shape and mesher.
class ObjectMesher {
public:
    /// The tets of an object where the scene puts it: its shape or file, through the mesher where it is a
    /// surface, then scaled, turned and moved. Repairs go to the log, one line each.
    /// @throws InvalidInput for files that cannot be read, surfaces that cannot be filled, flat or inverted
    /// results.
    TetMesh make(const ObjectDescription& object);

private:
    struct Known {
        Shape shape;
        MesherSettings mesher;
        TetMesh mesh;  // as the shape says, not placed yet
    };
    const TetMesh& local_mesh(const ObjectDescription& object);

    std::vector<Known> known_;
};

}  // namespace gelatin
