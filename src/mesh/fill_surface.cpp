#include "mesh/fill_surface.h"

#include "mesh/lattice/fill_with_lattice.h"
#include "mesh/tetrahedralise.h"

namespace gelatin {

TetMesh fill_surface(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name,
                     Notes& notes) {
    if (settings.kind != MesherKind::lattice) return tetrahedralise(surface, settings, name);
    return fill_with_lattice(surface, {settings.nodes, settings.cell_size, settings.max_volume}, name, notes);
}

}  // namespace gelatin
