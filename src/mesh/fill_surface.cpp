#include "mesh/fill_surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/content_hash.h"
#include "gelatin/error.h"
#include "mesh/cavity_points.h"
#include "mesh/lattice/enclosed_space.h"
#include "mesh/lattice/fill_with_lattice.h"
#include "mesh/surface_repair.h"
#include "mesh/tet_cache.h"
#include "mesh/tet_tree.h"
#include "mesh/tetrahedralise.h"
#include "mesh/tetrahedralise_to_nodes.h"

namespace gelatin {
namespace {

constexpr const char* kTooManyTets = "mesher.max_volume";
constexpr double kAllowed = 0.2;      // deviation from the wanted number of nodes
constexpr double kFarTooMany = 10.0;  // times as many: TetGen is not worth the minutes that it takes

// The first sentence of an error about a surface: what there is to do about it does not matter any more.
std::string reason_of(const std::string& problem) {
    return problem.substr(0, problem.find(';'));
}

bool is_too_many(std::size_t nodes, int wanted) {
    return static_cast<double>(nodes) > (1.0 + kAllowed) * wanted;
}

bool is_about(std::size_t nodes, int wanted) {
    return !is_too_many(nodes, wanted) && static_cast<double>(nodes) >= (1.0 - kAllowed) * wanted;
}

/// About how many nodes TetGen needs where a body is a sheet of the surface's mean thickness: its tets are as
/// wide as that. Four times as many as it needs for rods and grains.
double thin_nodes(const SurfaceMesh& surface) {
    if (!measure_openness(surface).is_closed()) return 0.0;
    double area = 0.0;
    for (const glm::uvec3& f : surface.faces) {
        const glm::dvec3& a = surface.positions[f[0]];
        area += 0.5 * glm::length(glm::cross(surface.positions[f[1]] - a, surface.positions[f[2]] - a));
    }
    const double thickness = 2.0 * std::abs(signed_volume(surface)) / area;
    return thickness > 0.0 ? 0.5 * area / (thickness * thickness) : 0.0;
}

/// A hash of everything that the lattice's tets depend on.
std::string lattice_key(const SurfaceMesh& surface, const LatticeSize& size) {
    constexpr double kNone = -1.0;
    ContentHash hash;
    hash.add(fmt::format("gelatin lattice {}", kLatticeVersion));
    hash.add(std::vector<double>{size.nodes ? static_cast<double>(*size.nodes) : kNone,
                                 size.cell_size.value_or(kNone), size.max_volume.value_or(kNone)});
    hash.add(surface.positions);
    hash.add(surface.faces);
    return hash.hex();
}

class SurfaceFill {
public:
    SurfaceFill(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name,
                Notes& notes)
        : surface_(surface), settings_(settings), name_(name), notes_(notes) {}

    // From the cache if it is there, with its notes.
    TetMesh by_lattice() {
        const LatticeSize size{settings_.nodes, settings_.cell_size, settings_.max_volume};
        const TetCache cache;
        const std::string key = lattice_key(surface_, size);
        std::optional<CachedTets> tets = cache.find(key);
        if (!tets) {
            tets.emplace();
            tets->mesh = fill_with_lattice(surface_, size, name_, tets->notes);
            cache.store(key, *tets);
        }
        notes_.insert(notes_.end(), tets->notes.begin(), tets->notes.end());
        warn_of_filled_cavities(tets->mesh);
        return std::move(tets->mesh);
    }

    TetMesh by_tetgen() {
        TetMesh mesh = run_tetgen();
        if (settings_.nodes && !is_about(mesh.positions.size(), *settings_.nodes)) {
            notes_.push_back(
                fmt::format("TetGen makes {} nodes of this surface, which has {} vertices; {} were "
                            "wanted",
                            mesh.positions.size(), surface_.positions.size(), *settings_.nodes));
        }
        return mesh;
    }

    TetMesh by_either() {
        std::string reason;  // for the lattice
        if (std::optional<TetMesh> mesh = try_tetgen(reason)) return std::move(*mesh);
        notes_.push_back("filled by the lattice mesher, because " + reason);
        return by_lattice();
    }

private:
    // The lattice reports what it loses of bodies, but not of the space in them.
    void warn_of_filled_cavities(const TetMesh& mesh) {
        const std::vector<glm::dvec3> points = find_cavity_points(surface_);
        if (points.empty()) return;
        const TetTree tets(mesh);
        const lattice::EnclosedSpace space(surface_);
        const auto filled = std::count_if(points.begin(), points.end(), [&](const glm::dvec3& p) {
            return tets.find(p) && !space.contains(p);
        });
        if (filled == 0) return;
        notes_.push_back(warning(
            fmt::format("cavities that are too small for the lattice's cells are filled: {}; a smaller "
                        "mesher.cell_size, or more mesher.nodes, would keep them",
                        filled)));
    }

    TetMesh run_tetgen() const {
        return settings_.nodes ? tetrahedralise_to_nodes(surface_, settings_, *settings_.nodes, name_)
                               : tetrahedralise(surface_, settings_, name_);
    }

    std::optional<TetMesh> try_tetgen(std::string& reason) {
        const std::size_t vertices = surface_.positions.size();
        if (settings_.cell_size) {
            reason = "mesher.cell_size is a size of its cells";
            return {};
        }
        if (settings_.nodes && is_too_many(vertices, *settings_.nodes)) {
            reason = fmt::format("the surface alone has {} vertices, and {} nodes are wanted", vertices,
                                 *settings_.nodes);
            return {};
        }
        if (const double nodes = thin_nodes(surface_);
            settings_.nodes && nodes > kFarTooMany * *settings_.nodes) {
            reason =
                fmt::format("TetGen would make about {:.0f} nodes of this thin surface, and {} are wanted",
                            nodes, *settings_.nodes);
            return {};
        }
        try {
            TetMesh mesh = run_tetgen();
            if (!settings_.nodes) return mesh;
            const std::size_t nodes = mesh.positions.size();
            if (is_about(nodes, *settings_.nodes)) {
                notes_.push_back(fmt::format(
                    "filled by TetGen with {} nodes: the surface is closed and no finer than wanted", nodes));
                return mesh;
            }
            reason = fmt::format("TetGen makes {} nodes of this surface, and {} are wanted", nodes,
                                 *settings_.nodes);
        } catch (const InvalidInput& error) {
            const bool is_about_surface = error.problem().field != kTooManyTets;
            if (!is_about_surface || surface_.faces.empty()) throw;
            reason = reason_of(error.problem().problem);
        } catch (const SystemError& error) {
            reason = "of " + reason_of(error.what());
        }
        return {};
    }

    const SurfaceMesh& surface_;
    const MesherSettings& settings_;
    const std::string& name_;
    Notes& notes_;
};

}  // namespace

TetMesh fill_surface(const SurfaceMesh& surface, const MesherSettings& settings, const std::string& name,
                     Notes& notes) {
    SurfaceFill fill(surface, settings, name, notes);
    switch (settings.kind) {
        case MesherKind::lattice:
            return fill.by_lattice();
        case MesherKind::tetgen:
            return fill.by_tetgen();
        default:
            return fill.by_either();
    }
}

MesherSettings sized(MesherSettings settings) {
    if (!settings.has_size()) settings.nodes = kUsualNodes;
    return settings;
}

}  // namespace gelatin
