#include "mesh/tet_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/merge_points.h"
#include "mesh/tet_check.h"
#include "mesh/tet_formats.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

double longest_edge(const TetMesh& mesh, const glm::uvec4& tet) {
    double longest = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            longest = std::max(longest, distance(mesh.positions[tet[i]], mesh.positions[tet[j]]));
        }
    }
    return longest;
}

// Flips inverted tets; flat ones have no orientation.
void orient_tets(const fs::path& file, TetMesh& mesh, Notes& notes) {
    constexpr double kFlat = 1e-12;  // of the longest edge cubed
    std::size_t flipped = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        glm::uvec4& tet = mesh.tets[t];
        const double volume = tet_volume(mesh, tet);
        const double longest = longest_edge(mesh, tet);
        if (!(std::abs(volume) > kFlat * longest * longest * longest)) {
            throw InvalidInput({file.string(),
                                0,
                                fmt::format("tet {}", t + 1),
                                {},
                                fmt::format("is flat: its volume is {:.3g} m^3, its longest edge {:.3g} m",
                                            volume, longest)});
        }
        if (volume > 0.0) continue;
        std::swap(tet[2], tet[3]);
        ++flipped;
    }
    if (flipped > 0) notes.push_back(fmt::format("flipped inverted tets: {}", flipped));
}

// Gmsh writes a tet with several physical groups once for each of them.
void drop_repeated_tets(TetMesh& mesh, Notes& notes) {
    struct Key {
        std::array<std::uint32_t, 4> nodes;
        std::size_t tet;
    };
    std::vector<Key> keys;
    keys.reserve(mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const glm::uvec4& tet = mesh.tets[t];
        keys.push_back({{tet[0], tet[1], tet[2], tet[3]}, t});
        std::sort(keys.back().nodes.begin(), keys.back().nodes.end());
    }
    std::sort(keys.begin(), keys.end(),
              [](const Key& a, const Key& b) { return std::tie(a.nodes, a.tet) < std::tie(b.nodes, b.tet); });
    std::vector<bool> keep(mesh.tets.size(), true);
    for (std::size_t k = 1; k < keys.size(); ++k) keep[keys[k].tet] = keys[k].nodes != keys[k - 1].nodes;
    const std::size_t dropped = keep_tets(mesh, keep);
    if (dropped > 0) notes.push_back(fmt::format("discarded duplicate tets: {}", dropped));
}

// Discards nodes without tets. Returns how many.
std::size_t drop_unused_nodes(TetMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec4& tet : mesh.tets) {
        for (int corner = 0; corner < 4; ++corner) used[tet[corner]] = true;
    }
    std::vector<std::uint32_t> new_index(mesh.positions.size());
    std::uint32_t kept = 0;
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (!used[n]) continue;
        mesh.positions[kept] = mesh.positions[n];
        new_index[n] = kept++;
    }
    const std::size_t dropped = mesh.positions.size() - kept;
    mesh.positions.resize(kept);
    for (glm::uvec4& tet : mesh.tets) {
        tet = {new_index[tet[0]], new_index[tet[1]], new_index[tet[2]], new_index[tet[3]]};
    }
    return dropped;
}

// Tets without common nodes would fall apart. Some programs write each tet with its own nodes.
void merge_nodes(TetMesh& mesh, Notes& notes) {
    constexpr double kTolerance = 1e-12;  // of the diagonal
    const MergedPoints merged = merge_points(mesh.positions, kTolerance);
    if (merged.count == 0) return;
    for (glm::uvec4& tet : mesh.tets) {
        for (int corner = 0; corner < 4; ++corner) tet[corner] = merged.into[tet[corner]];
    }
    drop_unused_nodes(mesh);
    notes.push_back(fmt::format("merged nodes that coincide: {}", merged.count));
}

// The files appear together, as far as renaming allows: all are written completely first.
void write_files(const std::vector<std::pair<fs::path, std::string>>& files) {
    std::vector<fs::path> written;
    try {
        for (const auto& [file, content] : files) {
            if (is_stream(file)) continue;
            const fs::path partial = partial_name(link_target(file));
            write_file(partial, content);
            written.push_back(partial);
        }
        for (const auto& [file, content] : files) {
            if (is_stream(file)) {
                write_file(file, content);
            } else {
                fs::rename(partial_name(link_target(file)), link_target(file));
            }
        }
    } catch (const fs::filesystem_error& error) {
        for (const fs::path& partial : written) fs::remove(partial);
        throw SystemError(files.front().first.string() + ": cannot be written: " + error.code().message());
    } catch (const SystemError&) {
        for (const fs::path& partial : written) fs::remove(partial);
        throw;
    }
}

}  // namespace

bool is_tet_file(const fs::path& file) {
    const std::string ending = lower_case_ending(file);
    return ending == ".node" || ending == ".ele" || ending == ".mesh" || ending == ".msh" ||
           ending == ".vtk" || ending == ".vtu";
}

TetMesh read_tets(const fs::path& file, Notes& notes) {
    const std::string ending = lower_case_ending(file);
    if (!is_tet_file(file)) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, "a tet file must end in .node, .ele, .mesh, .msh, .vtk or .vtu"});
    }
    TetMesh mesh = ending == ".mesh"  ? read_medit(file, notes)
                   : ending == ".msh" ? read_gmsh(file, notes)
                   : ending == ".vtk" ? read_vtk(file, notes)
                   : ending == ".vtu" ? read_vtu(file, notes)
                                      : read_tetgen(file, notes);
    if (mesh.tets.empty()) {
        const std::string but = notes.empty() ? "" : fmt::format(" ({})", fmt::join(notes, "; "));
        throw InvalidInput({file.string(), 0, {}, {}, "has no tets" + but});
    }
    const auto is_zero = [](int attribute) { return attribute == 0; };
    if (std::all_of(mesh.attributes.begin(), mesh.attributes.end(), is_zero)) mesh.attributes.clear();
    if (const std::size_t dropped = drop_unused_nodes(mesh); dropped > 0)
        notes.push_back(fmt::format("discarded nodes without tets: {}", dropped));
    merge_nodes(mesh, notes);
    orient_tets(file, mesh, notes);
    drop_repeated_tets(mesh, notes);
    check_tets(mesh, notes);
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

void write_tets(const fs::path& file, const TetMesh& mesh) {
    const std::string ending = lower_case_ending(file);
    const auto beside = [&](const char* other) { return fs::path(file).replace_extension(other); };
    if (ending == ".mesh") return write_file(file, format_medit(mesh));
    if (ending == ".msh") return write_file(file, format_gmsh(mesh));
    if (ending == ".vtu") return write_file(file, format_vtu(mesh));
    if (ending == ".node") {
        return write_files({{beside(".ele"), format_tetgen_tets(mesh)},
                            {beside(".face"), format_tetgen_faces(mesh)},
                            {file, format_tetgen_nodes(mesh)}});
    }
    throw InvalidInput({file.string(), 0, {}, {}, "tets can be written as .node, .mesh, .msh or .vtu"});
}

}  // namespace gelatin
