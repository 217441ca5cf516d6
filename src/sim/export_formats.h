#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/export_look.h"
#include "sim/tet_strains.h"

namespace gelatin {

/// The file of the materials of OBJ files, beside them.
constexpr const char* kObjLibrary = "scene.mtl";

/// The part of exported frames that does not change: how nodes carry the vertices of surfaces, and the
/// connectivity, as files have it.
struct ExportTopology {
    struct Object {
        std::string name;
        Range vertices;
        std::string obj_faces;  ///< lines, with texture coordinates and materials
    };
    std::vector<Object> objects;
    std::vector<SkinPoint> vertices;  ///< of the skins; of the boundaries of the tets where there are none
    std::size_t face_count = 0, node_count = 0;
    std::size_t cell_count = 0;  ///< tets, and faces of rigid bodies and colliders
    std::string obj_library;     ///< the text of kObjLibrary; empty: no materials
    std::vector<ObjLook::Image> obj_images;
    std::string ply_faces;
    std::string vtu_cells;           ///< the <Cells> element, and the beginning of <CellData>
    std::vector<float> start;        ///< x, y, z of each body's nodes [m]
    std::optional<TetStrains> tets;  ///< of all
    std::string vtp_polys;  ///< the <Polys> and <CellData> elements; empty where no object has a skin
};
ExportTopology make_export_topology(const Model& model);

/// Wavefront text: for each object one `o NAME`, its vertices, then its faces.
std::string obj_text(const ExportTopology& topology, const HostFrame& frame);

/// Binary little-endian PLY: vertices with velocities, triangles with the index of their object.
std::string ply_bytes(const ExportTopology& topology, const HostFrame& frame);

/// VTK's XML polygons: the vertices of skins, velocity by vertex, the object's index by face.
/// @pre the topology has `vtp_polys`
std::string vtp_text(const ExportTopology& topology, const HostFrame& frame);

/// VTK's XML unstructured grid: every node, tet, and face of a rigid body; by node velocity, displacement
/// since the start and forces, by tet or face the object's index, strain and stress.
std::string vtu_text(const ExportTopology& topology, const HostFrame& frame);

}  // namespace gelatin
