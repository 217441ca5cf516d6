#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <iterator>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/surface_file.h"

namespace gelatin {
namespace {

static_assert(std::endian::native == std::endian::little,
              "binary files are written as the numbers lie in memory");

template <class T>
void append_bytes(std::string& out, const T& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string format_obj(const SurfaceMesh& mesh) {
    std::string out;
    for (const glm::dvec3& p : mesh.positions)
        fmt::format_to(std::back_inserter(out), "v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::uvec3& f : mesh.faces) {
        fmt::format_to(std::back_inserter(out), "f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    }
    return out;
}

std::string format_off(const SurfaceMesh& mesh) {
    std::string out = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.faces.size());
    for (const glm::dvec3& p : mesh.positions)
        fmt::format_to(std::back_inserter(out), "{} {} {}\n", p.x, p.y, p.z);
    for (const glm::uvec3& f : mesh.faces) {
        fmt::format_to(std::back_inserter(out), "3 {} {} {}\n", f[0], f[1], f[2]);
    }
    return out;
}

std::string format_ply(const SurfaceMesh& mesh) {
    std::string out = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
        "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.size(), mesh.faces.size());
    out.reserve(out.size() + 24 * mesh.positions.size() + 13 * mesh.faces.size());
    for (const glm::dvec3& p : mesh.positions) append_bytes(out, p);
    for (const glm::uvec3& f : mesh.faces) {
        out.push_back(3);
        append_bytes(out, f);
    }
    return out;
}

std::string format_stl(const SurfaceMesh& mesh) {
    std::string out(80, ' ');  // must not begin with 'solid', which marks text
    out.reserve(84 + 50 * mesh.faces.size());
    append_bytes(out, static_cast<std::uint32_t>(mesh.faces.size()));
    for (const glm::uvec3& f : mesh.faces) {
        const glm::dvec3 &a = mesh.positions[f[0]], &b = mesh.positions[f[1]], &c = mesh.positions[f[2]];
        const glm::dvec3 area = cross(b - a, c - a);
        const double size = length(area);
        append_bytes(out, glm::vec3(size > 0.0 ? area / size : glm::dvec3(0.0)));
        for (const glm::dvec3& p : {a, b, c}) append_bytes(out, glm::vec3(p));
        append_bytes(out, std::uint16_t{0});
    }
    return out;
}

}  // namespace

void write_surface(const std::filesystem::path& file, const SurfaceMesh& mesh) {
    struct Format {
        std::string_view ending;
        std::string (*format)(const SurfaceMesh&);
    };
    constexpr std::array<Format, 4> kFormats = {
        {{".obj", format_obj}, {".stl", format_stl}, {".ply", format_ply}, {".off", format_off}}};
    const std::string ending = lower_case_ending(file);
    for (const Format& format : kFormats) {
        if (ending == format.ending) return write_file(file, format.format(mesh));
    }
    throw InvalidInput({file.string(), 0, {}, {}, "a surface can be written as .obj, .stl, .ply or .off"});
}

}  // namespace gelatin
