#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "gelatin/simulator.h"
#include "model/model.h"

namespace gelatin {

/// The part of exported frames that does not change: which nodes are on the surface, and the connectivity.
struct ExportTopology {
    struct Object {
        std::string name;
        Range vertices, faces;
    };
    std::vector<Object> objects;
    std::vector<std::uint32_t> vertex_nodes;  ///< the node of each surface vertex, ascending
    std::vector<glm::uvec3> faces;            ///< indices into vertex_nodes
    std::size_t node_count = 0, tet_count = 0;
    std::string vtu_cells;  ///< the <Cells> and <CellData> elements
};
ExportTopology make_export_topology(const Model& model);

/// Wavefront text: for each object one `o NAME`, its vertices, then its faces.
std::string obj_text(const ExportTopology& topology, const HostFrame& frame);

/// Binary little-endian PLY: vertices with velocities, triangles with the index of their object.
std::string ply_bytes(const ExportTopology& topology, const HostFrame& frame);

/// VTK's XML unstructured grid: every node and tet, velocity by node, the object's index by tet.
std::string vtu_text(const ExportTopology& topology, const HostFrame& frame);

}  // namespace gelatin
