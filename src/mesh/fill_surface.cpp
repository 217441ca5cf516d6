#include "mesh/fill_surface.h"

#include "gelatin/error.h"
#include "mesh/lattice/fill_with_lattice.h"
#include "mesh/tetrahedralise.h"

namespace gelatin {
namespace {

constexpr const char* kTooManyTets = "mesher.max_volume";

// The first sentence of an error about a surface: what there is to do about it does not matter any more.
std::string reason_of(const std::string& problem) {
    return problem.substr(0, problem.find(';'));
}

}  // namespace

TetMesh fill_surface(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name,
                     Notes& notes) {
    const auto by_lattice = [&] {
        return fill_with_lattice(surface, {settings.nodes, settings.cell_size, settings.max_volume}, name,
                                 notes);
    };
    if (settings.kind == MesherKind::lattice) return by_lattice();
    try {
        return tetrahedralise(surface, settings, name);
    } catch (const InvalidInput& error) {
        const bool is_about_surface = error.problem().field != kTooManyTets;
        if (settings.kind == MesherKind::tetgen || !is_about_surface || surface.faces.empty()) throw;
        notes.push_back("filled by the lattice mesher, because " + reason_of(error.problem().problem));
    } catch (const SystemError& error) {
        if (settings.kind == MesherKind::tetgen) throw;
        notes.push_back(std::string("filled by the lattice mesher, because of ") + reason_of(error.what()));
    }
    return by_lattice();
}

}  // namespace gelatin
