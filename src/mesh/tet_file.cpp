#include "mesh/tet_file.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/tet_formats.h"
#include "mesh/tet_repair.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

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
        const std::string ignored = notes.empty() ? "" : " (" + joined(notes) + ")";
        throw InvalidInput({file.string(), 0, {}, {}, "has no tets" + ignored});
    }
    repair_tets(mesh, file.string(), notes);
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
