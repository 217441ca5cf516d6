#include "sim/export_formats.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>

namespace gelatin {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY and VTU are written in memory order");

constexpr std::uint8_t kVtkTetra = 10;

std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t triple = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            triple = triple << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[triple >> shift & 63];
    }
    for (std::size_t k = bytes.size() % 3; k > 0 && k < 3; ++k) text[text.size() - (3 - k)] = '=';
    return text;
}

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

// VTK's inline binary: the size in bytes, then the values, in one base64 run.
template <class T>
std::string data_array(const char* type, const std::string& attributes, std::span<const T> values) {
    std::string bytes;
    const std::uint64_t size = values.size_bytes();
    append(bytes, &size, 1);
    append(bytes, values.data(), values.size());
    return fmt::format("<DataArray type=\"{}\" {} format=\"binary\">{}</DataArray>\n", type, attributes,
                       base64(bytes));
}

std::string vtu_cells(const Model& model) {
    std::vector<std::int64_t> connectivity, offsets;
    std::vector<std::int32_t> object_of_tet;
    connectivity.reserve(4 * model.tets.size());
    for (const glm::uvec4& tet : model.tets) {
        for (int corner = 0; corner < 4; ++corner) connectivity.push_back(tet[corner]);
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        object_of_tet.insert(object_of_tet.end(), model.objects[o].tets.count, static_cast<std::int32_t>(o));
    }
    const std::vector<std::uint8_t> types(model.tets.size(), kVtkTetra);
    return "<Cells>\n" + data_array<std::int64_t>("Int64", "Name=\"connectivity\"", connectivity) +
           data_array<std::int64_t>("Int64", "Name=\"offsets\"", offsets) +
           data_array<std::uint8_t>("UInt8", "Name=\"types\"", types) +
           "</Cells>\n<CellData Scalars=\"object\">\n" +
           data_array<std::int32_t>("Int32", "Name=\"object\"", object_of_tet) + "</CellData>\n";
}

}  // namespace

ExportTopology make_export_topology(const Model& model) {
    constexpr std::uint32_t kInside = std::numeric_limits<std::uint32_t>::max();
    ExportTopology topology;
    topology.node_count = model.body_node_count();
    topology.tet_count = model.tets.size();
    std::vector<std::uint32_t> vertex_of_node(model.node_count(), kInside);
    for (const Face& face : model.faces) {
        for (const std::uint32_t node : {face.a, face.b, face.c}) vertex_of_node[node] = 0;
    }
    for (const ModelObject& object : model.objects) {
        const auto first = static_cast<std::uint32_t>(topology.vertex_nodes.size());
        for (std::uint32_t node = object.nodes.first; node < object.nodes.end(); ++node) {
            if (vertex_of_node[node] == kInside) continue;
            vertex_of_node[node] = static_cast<std::uint32_t>(topology.vertex_nodes.size());
            topology.vertex_nodes.push_back(node);
        }
        const auto count = static_cast<std::uint32_t>(topology.vertex_nodes.size()) - first;
        topology.objects.push_back({object.name, {first, count}, object.faces});
    }
    for (const Face& face : model.faces) {
        topology.faces.emplace_back(vertex_of_node[face.a], vertex_of_node[face.b], vertex_of_node[face.c]);
    }
    topology.vtu_cells = vtu_cells(model);
    return topology;
}

std::string obj_text(const ExportTopology& topology, const HostFrame& frame) {
    std::string text = fmt::format("# frame {}, {} s\n", frame.frame, frame.time);
    auto out = std::back_inserter(text);
    for (const ExportTopology::Object& object : topology.objects) {
        fmt::format_to(out, "o {}\n", object.name);
        for (std::uint32_t v = object.vertices.first; v < object.vertices.end(); ++v) {
            const float* p = &frame.positions[3 * std::size_t{topology.vertex_nodes[v]}];
            fmt::format_to(out, "v {} {} {}\n", p[0], p[1], p[2]);
        }
        for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f) {
            const glm::uvec3 face = topology.faces[f] + 1u;  // OBJ counts from 1
            fmt::format_to(out, "f {} {} {}\n", face.x, face.y, face.z);
        }
    }
    return text;
}

std::string ply_bytes(const ExportTopology& topology, const HostFrame& frame) {
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment frame {}, {} s\nelement vertex {}\n",
                    frame.frame, frame.time, topology.vertex_nodes.size());
    for (const char* name : {"x", "y", "z", "vx", "vy", "vz"})
        bytes += fmt::format("property float {}\n", name);
    bytes += fmt::format(
        "element face {}\nproperty list uchar uint vertex_indices\nproperty uint object\nend_header\n",
        topology.faces.size());
    for (const std::uint32_t node : topology.vertex_nodes) {
        append(bytes, &frame.positions[3 * std::size_t{node}], 3);
        append(bytes, &frame.velocities[3 * std::size_t{node}], 3);
    }
    for (std::uint32_t o = 0; o < topology.objects.size(); ++o) {
        const Range faces = topology.objects[o].faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
            bytes += '\3';
            append(bytes, &topology.faces[f].x, 3);
            append(bytes, &o, 1);
        }
    }
    return bytes;
}

std::string vtu_text(const ExportTopology& topology, const HostFrame& frame) {
    // Without those of colliders, which come last.
    const auto of_nodes = [&](const std::vector<float>& vectors) {
        return std::span<const float>(vectors).first(3 * topology.node_count);
    };
    const auto force_array = [&](const char* name, const std::vector<float>& forces) {
        if (forces.empty()) return std::string();
        return data_array<float>("Float32", fmt::format("Name=\"{}\" NumberOfComponents=\"3\"", name),
                                 of_nodes(forces));
    };
    return fmt::format(
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
               "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
               "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
               topology.node_count, topology.tet_count) +
           data_array<float>("Float32", "Name=\"Points\" NumberOfComponents=\"3\"",
                             of_nodes(frame.positions)) +
           "</Points>\n<PointData Vectors=\"velocity\">\n" +
           data_array<float>("Float32", "Name=\"velocity\" NumberOfComponents=\"3\"",
                             of_nodes(frame.velocities)) +
           force_array("contact_force", frame.contact_forces) +
           force_array("contact_friction", frame.contact_friction) +
           force_array("holding_force", frame.holding_forces) + "</PointData>\n" + topology.vtu_cells +
           "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace gelatin
