#pragma once

#include <memory>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// What was made of a shape, before it is placed.
struct ShapeMesh {
    Shape shape;
    MesherSettings mesher;  ///< of a body
    SurfaceMesh surface;    ///< as the shape defines it; empty for a body whose shape has tets
    TetMesh tets;           ///< of a body; empty for a collider
};

/// All that a scene's shapes were made into. Models of the scene are made from it without the files, fonts
/// and meshers that the shapes name.
struct SceneMeshes {
    std::vector<std::shared_ptr<const ShapeMesh>> all;
};

}  // namespace gelatin
