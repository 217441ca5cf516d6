#include "sim/export_formats.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <span>

#include "model/assembly/pack_skin.h"

namespace gelatin {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY and VTU are written in memory order");

constexpr std::uint8_t kVtkTriangle = 5, kVtkTetra = 10;

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

// VTK's inline binary, compressed: how many blocks, of what size, the last one's, what they have become; then
// these blocks.
template <class T>
std::string data_array(const char* type, const std::string& attributes, std::span<const T> values) {
    constexpr std::size_t kBlock = 1 << 18;
    constexpr int kLevel = 1;  // others take several times as long for a tenth less
    const std::size_t size = values.size_bytes(), blocks = (size + kBlock - 1) / kBlock;
    std::vector<std::uint64_t> head{blocks, kBlock, size % kBlock};
    std::string bytes, block(compressBound(kBlock), '\0');
    for (std::size_t b = 0; b < blocks; ++b) {
        uLongf length = block.size();
        compress2(reinterpret_cast<Bytef*>(block.data()), &length,
                  reinterpret_cast<const Bytef*>(values.data()) + b * kBlock,
                  std::min(kBlock, size - b * kBlock), kLevel);
        head.push_back(length);
        bytes.append(block.data(), length);
    }
    std::string head_bytes;
    append(head_bytes, head.data(), head.size());
    return fmt::format("<DataArray type=\"{}\" {} format=\"binary\">{}{}</DataArray>\n", type, attributes,
                       base64(head_bytes), base64(bytes));
}

std::string vtu_cells(const Model& model, std::span<const Face> bare_faces) {
    std::vector<std::int64_t> connectivity, offsets;
    std::vector<std::int32_t> objects;
    connectivity.reserve(4 * model.tets.size());
    for (const glm::uvec4& tet : model.tets) {
        for (int corner = 0; corner < 4; ++corner) connectivity.push_back(tet[corner]);
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        objects.insert(objects.end(), model.objects[o].tets.count, static_cast<std::int32_t>(o));
    }
    std::vector<std::uint8_t> types(model.tets.size(), kVtkTetra);
    for (const Face& face : bare_faces) {
        connectivity.insert(connectivity.end(), {face.a, face.b, face.c});
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        objects.push_back(static_cast<std::int32_t>(face.object));
        types.push_back(kVtkTriangle);
    }
    return "<Cells>\n" + data_array<std::int64_t>("Int64", "Name=\"connectivity\"", connectivity) +
           data_array<std::int64_t>("Int64", "Name=\"offsets\"", offsets) +
           data_array<std::uint8_t>("UInt8", "Name=\"types\"", types) +
           "</Cells>\n<CellData Scalars=\"object\">\n" +
           data_array<std::int32_t>("Int32", "Name=\"object\"", objects);
}

// Of rigid bodies and colliders.
std::vector<Face> faces_without_tets(const Model& model) {
    std::vector<Face> faces;
    std::copy_if(model.faces.begin(), model.faces.end(), std::back_inserter(faces),
                 [&](const Face& face) { return model.objects[face.object].tets.count == 0; });
    return faces;
}

std::string ply_faces(std::span<const Face> faces) {
    std::string bytes;
    for (const Face& face : faces) {
        bytes += '\3';
        for (const std::uint32_t number : {face.a, face.b, face.c, face.object}) append(bytes, &number, 1);
    }
    return bytes;
}

std::string vtp_polys(std::span<const Face> faces) {
    std::vector<std::int64_t> connectivity, offsets;
    std::vector<std::int32_t> objects;
    for (const Face& face : faces) {
        connectivity.insert(connectivity.end(), {face.a, face.b, face.c});
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        objects.push_back(static_cast<std::int32_t>(face.object));
    }
    return "<Polys>\n" + data_array<std::int64_t>("Int64", "Name=\"connectivity\"", connectivity) +
           data_array<std::int64_t>("Int64", "Name=\"offsets\"", offsets) +
           "</Polys>\n<CellData Scalars=\"object\">\n" +
           data_array<std::int32_t>("Int32", "Name=\"object\"", objects) + "</CellData>\n";
}

std::string head_of_vtk(const char* kind) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{0}>\n",
        kind);
}

std::string tail_of_vtk(const char* kind) {
    return fmt::format("</Piece>\n</{0}>\n</VTKFile>\n", kind);
}

// The <Points> element, and the start of <PointData>.
std::string vtk_points(std::span<const float> positions, std::span<const float> velocities) {
    return "<Points>\n" +
           data_array<float>("Float32", "Name=\"Points\" NumberOfComponents=\"3\"", positions) +
           "</Points>\n<PointData Vectors=\"velocity\">\n" +
           data_array<float>("Float32", "Name=\"velocity\" NumberOfComponents=\"3\"", velocities);
}

}  // namespace

ExportTopology make_export_topology(const Model& model) {
    const bool has_skin = !model.skin.is_empty();
    const Skin hulls = has_skin ? Skin() : make_hulls(model);
    const Skin& drawn = has_skin ? model.skin : hulls;
    ExportTopology topology;
    topology.vertices = drawn.points;
    topology.face_count = drawn.faces.size();
    topology.node_count = model.node_count();
    const std::vector<Face> bare_faces = faces_without_tets(model);
    topology.cell_count = model.tets.size() + bare_faces.size();
    ObjLook look(drawn.look);
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const SkinObject& object = drawn.objects[o];
        const auto faces = std::span(drawn.faces).subspan(object.faces.first, object.faces.count);
        topology.objects.push_back(
            {model.objects[o].name, object.points, look.face_lines(faces, object.faces.first)});
    }
    topology.obj_library = look.library();
    topology.obj_images = look.images();
    topology.ply_faces = ply_faces(drawn.faces);
    topology.vtu_cells = vtu_cells(model, bare_faces);
    for (std::size_t n = 0; n < topology.node_count; ++n)
        for (int k = 0; k < 3; ++k) topology.start.push_back(model.positions[n][k]);
    topology.tets.emplace(model);
    if (has_skin) topology.vtp_polys = vtp_polys(drawn.faces);
    return topology;
}

std::string obj_text(const ExportTopology& topology, const HostFrame& frame) {
    const std::vector<float> positions = carry_skin(topology.vertices, std::span(frame.positions));
    std::string text = fmt::format("# frame {}, {} s\n", frame.frame, frame.time);
    if (!topology.obj_library.empty()) text += fmt::format("mtllib {}\n", kObjLibrary);
    auto out = std::back_inserter(text);
    for (const ExportTopology::Object& object : topology.objects) {
        fmt::format_to(out, "o {}\n", object.name);
        for (std::uint32_t v = object.vertices.first; v < object.vertices.end(); ++v) {
            const float* p = &positions[3 * std::size_t{v}];
            fmt::format_to(out, "v {} {} {}\n", p[0], p[1], p[2]);
        }
        text += object.obj_faces;
    }
    return text;
}

std::string ply_bytes(const ExportTopology& topology, const HostFrame& frame) {
    const std::vector<float> positions = carry_skin(topology.vertices, std::span(frame.positions));
    const std::vector<float> velocities = carry_skin(topology.vertices, std::span(frame.velocities));
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment frame {}, {} s\nelement vertex {}\n",
                    frame.frame, frame.time, topology.vertices.size());
    for (const char* name : {"x", "y", "z", "vx", "vy", "vz"})
        bytes += fmt::format("property float {}\n", name);
    bytes += fmt::format(
        "element face {}\nproperty list uchar uint vertex_indices\nproperty uint object\nend_header\n",
        topology.face_count);
    for (std::size_t v = 0; v < topology.vertices.size(); ++v) {
        append(bytes, &positions[3 * v], 3);
        append(bytes, &velocities[3 * v], 3);
    }
    return bytes + topology.ply_faces;
}

std::string vtp_text(const ExportTopology& topology, const HostFrame& frame) {
    return head_of_vtk("PolyData") +
           fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n", topology.vertices.size(),
                       topology.face_count) +
           vtk_points(carry_skin(topology.vertices, std::span(frame.positions)),
                      carry_skin(topology.vertices, std::span(frame.velocities))) +
           "</PointData>\n" + topology.vtp_polys + tail_of_vtk("PolyData");
}

std::string vtu_text(const ExportTopology& topology, const HostFrame& frame) {
    const auto force_array = [&](const char* name, const std::vector<float>& forces) {
        if (forces.empty()) return std::string();
        return data_array<float>("Float32", fmt::format("Name=\"{}\" NumberOfComponents=\"3\"", name),
                                 forces);
    };
    std::vector<float> displacements(topology.start.size());
    for (std::size_t k = 0; k < displacements.size(); ++k)
        displacements[k] = frame.positions[k] - topology.start[k];
    TetStrains::Values tets = topology.tets->find(frame.positions);
    tets.strains.resize(9 * topology.cell_count);  // faces have none
    tets.stresses.resize(topology.cell_count);
    return head_of_vtk("UnstructuredGrid") +
           fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", topology.node_count,
                       topology.cell_count) +
           vtk_points(frame.positions, frame.velocities) +
           data_array<float>("Float32", "Name=\"displacement\" NumberOfComponents=\"3\"", displacements) +
           force_array("contact_force", frame.contact_forces) +
           force_array("contact_friction", frame.contact_friction) +
           force_array("holding_force", frame.holding_forces) + "</PointData>\n" + topology.vtu_cells +
           data_array<float>("Float32", "Name=\"strain\" NumberOfComponents=\"9\"", tets.strains) +
           data_array<float>("Float32", "Name=\"stress\"", tets.stresses) + "</CellData>\n" +
           tail_of_vtk("UnstructuredGrid");
}

}  // namespace gelatin
