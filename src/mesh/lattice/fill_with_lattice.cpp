#include "mesh/lattice/fill_with_lattice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/progress.h"
#include "gelatin/error.h"
#include "mesh/lattice/cut_lattice.h"
#include "mesh/lattice/enclosed_space.h"
#include "mesh/lattice/improve_tets.h"
#include "mesh/lattice/lattice.h"
#include "mesh/lattice/lost_parts.h"
#include "mesh/lattice/separate_touching.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

using namespace lattice;

/// The surface is moved and scaled into the unit cube, and the tets back.
struct Frame {
    glm::dvec3 origin;
    double scale;
};

class LatticeFill {
public:
    LatticeFill(const SurfaceMesh& surface, std::string name, Notes& notes)
        : name_(std::move(name)), notes_(notes), frame_(frame_of(surface)), space_(in_frame(surface)) {}

    TetMesh fill(const LatticeSize& size) {
        if (size.cell_size)
            make({*size.cell_size / frame_.scale});
        else if (size.max_volume)
            find_size_for_volume(*size.max_volume / std::pow(frame_.scale, 3.0));
        else
            find_size_for_nodes(size.nodes.value_or(kUsualNodes));
        if (mesh_.tets.empty()) refuse_thinness(size);
        if (!size.max_volume) improve_tets(mesh_, space_.tree());
        report_losses(size);
        for (glm::dvec3& p : mesh_.positions) p = frame_.origin + frame_.scale * p;
        return std::move(mesh_);
    }

private:
    [[noreturn]] void refuse(const std::string& problem) const {
        throw InvalidInput({name_, 0, {}, {}, problem});
    }

    Frame frame_of(const SurfaceMesh& surface) const {
        if (surface.faces.empty()) refuse("the surface has no faces, so there is nothing to fill");
        constexpr double kFar = std::numeric_limits<double>::infinity();
        glm::dvec3 min(kFar), max(-kFar);
        for (const glm::uvec3& face : surface.faces) {
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3& p = surface.positions[face[k]];
                if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                    refuse(
                        fmt::format("vertex {} has a coordinate that is not a finite number", face[k] + 1));
                min = glm::min(min, p);
                max = glm::max(max, p);
            }
        }
        const glm::dvec3 extent = max - min;
        const double scale = std::max({extent.x, extent.y, extent.z});
        if (!std::isfinite(scale)) refuse("its extent is too large for a double-precision number");
        if (!(scale > 1e-100)) refuse("its vertices are all in one place, so it encloses no volume");
        return {min, scale};
    }

    SurfaceMesh in_frame(SurfaceMesh surface) const {
        for (glm::dvec3& p : surface.positions) p = (p - frame_.origin) / frame_.scale;
        return surface;
    }

    // Makes the tets of one size, if there are not too many cells. Those of the last call stay.
    bool try_to_make(const CellSizes& sizes) {
        check_cancelled();
        sizes_ = sizes;
        mesh_ = {};
        try {
            mesh_ = cut_lattice(make_lattice(space_, thin_, sizes), space_);
        } catch (const TooManyCells&) {
            return false;
        }
        separate_touching(mesh_);
        fragments_ = remove_fragments(space_, 0.5 * sizes.boundary, mesh_);
        return true;
    }

    void make(const CellSizes& sizes) {
        if (try_to_make(sizes)) return;
        refuse(fmt::format(
            "with cells of {:.3g} m there would be more than {} of them, the most that are allowed",
            frame_.scale * sizes.boundary, sizes.most_cells));
    }

    static constexpr double kMostLost = 0.5;                 // of the surface
    static constexpr std::size_t kMostTriedCells = 400'000;  // some seconds

    // The count grows with a power of 1 / size that is about 2 for thin bodies and 3 for thick ones.
    void find_size_for_nodes(int wanted) {
        constexpr int kTries = 8, kEmptyTries = 2;
        constexpr double kClose = 0.08, kAllowed = 0.2;
        const std::size_t most_cells = std::min(kMostCells, 10'000 + 30 * static_cast<std::size_t>(wanted));
        const auto error_of = [&](double count) { return std::abs(count / wanted - 1.0); };
        double size = 1.0 / 16.0, power = 2.3, last_size = 0.0, last_count = 0.0;
        bool has_any = false, was_empty = false;
        double too_small = 0.0, too_large = std::numeric_limits<double>::infinity();
        for (int k = 0; k < kTries; ++k) {
            const bool is_too_fine =
                !try_to_make({size, 2, 2, most_cells, 2 * static_cast<std::size_t>(wanted)});
            const auto count = is_too_fine ? 4.0 * wanted : static_cast<double>(mesh_.positions.size());
            if (error_of(count) < kClose) return;
            (count > wanted ? too_small : too_large) = size;
            if (count > 0.0 && last_count > 0.0 && count != last_count)
                power = std::clamp(std::log(count / last_count) / std::log(last_size / size), 1.5, 4.0);
            last_size = size;
            last_count = is_too_fine ? 0.0 : count;
            if (is_too_fine && was_empty && !has_any) break;
            if (count == 0.0) {  // nothing is inside, or it is too thin
                was_empty = true;
                const double fitting = find_lost_parts(space_, thin_, sizes_, mesh_).cell_size;
                if (fitting == 0.0 && k >= kEmptyTries) break;
                if (fitting > 0.0) size = std::clamp(2.0 * fitting, 0.25 * size, size);
            }
            has_any = has_any || (!is_too_fine && count > 0.0);
            const double next = count > 0.0 ? size * std::pow(count / wanted, 1.0 / power) : 0.5 * size;
            const bool is_between = next > too_small && next < too_large;
            size = is_between || too_small == 0.0
                       ? next
                       : std::sqrt(too_small * std::min(too_large, 4.0 * too_small));
        }
        const auto count = static_cast<double>(mesh_.positions.size());
        if (mesh_.tets.empty() || error_of(count) <= kAllowed) return;
        notes_.push_back(
            fmt::format("the lattice has {} nodes; {} were wanted", mesh_.positions.size(), wanted));
    }

    void find_size_for_volume(double wanted) {
        constexpr int kTries = 6;
        double size = std::cbrt(12.0 * wanted);  // a tet of the lattice has a twelfth of its cell
        for (int k = 0; k < kTries; ++k) {
            make({size, 2, 0});
            if (mesh_.tets.empty()) return;
            improve_tets(mesh_, space_.tree());
            double largest = 0.0;
            for (const glm::uvec4& tet : mesh_.tets) largest = std::max(largest, tet_volume(mesh_, tet));
            if (largest <= wanted) return;
            size *= std::min(0.98, std::cbrt(0.98 * wanted / largest));
        }
    }

    // Finds cells that fill the body, by making it of them: about of the size that its thin parts need. What
    // is advised is what was tried, as it is printed.
    struct Fitting {
        double cell_size = 0.0;  // [m]; 0: none
        std::size_t nodes = 0;
    };
    Fitting find_fitting_size(double needed) {
        constexpr double kMostLostThen = 0.1;
        for (const double part : {2.0, 1.4, 1.0, 0.7, 0.5}) {
            const double size = part * needed;
            const double printed = std::stod(fmt::format("{:.2g}", frame_.scale * size));
            if (!try_to_make({printed / frame_.scale, 2, 2, kMostTriedCells})) return {};
            if (mesh_.tets.empty()) continue;
            if (find_lost_parts(space_, thin_, sizes_, mesh_).area_fraction <= kMostLostThen)
                return {printed, mesh_.positions.size()};
        }
        return {};
    }

    [[noreturn]] void refuse_thinness(const LatticeSize& size) {
        const LostParts lost = find_lost_parts(space_, thin_, sizes_, mesh_);
        if (mesh_.tets.empty() && lost.cell_size == 0.0) {
            refuse(
                "the surface encloses no volume that could be filled with tets, as a flat sheet does not; "
                "close "
                "it, or "
                "give it a thickness");
        }
        const double needed = frame_.scale * lost.cell_size;
        const std::string wanted = size.nodes || !(size.cell_size || size.max_volume)
                                       ? fmt::format("{} nodes", size.nodes.value_or(kUsualNodes))
                                       : fmt::format("cells of {:.3g} m", frame_.scale * sizes_.boundary);
        const Fitting fitting = find_fitting_size(lost.cell_size);
        if (fitting.nodes == 0) {
            refuse(
                fmt::format("most of it is too thin for {}: it needs cells of {:.2g} m, and more than {} "
                            "of them; make it thicker",
                            wanted, needed, kMostTriedCells));
        }
        refuse(fmt::format("most of it is too thin for {}; mesher.cell_size = {:.2g} fills it, with {} nodes",
                           wanted, fitting.cell_size, fitting.nodes));
    }

    // What to do about thin parts that are lost, if anything helps.
    std::string advice_on(const LostParts& lost) const {
        const double size = lost.cell_size > 0.0 ? lost.cell_size : 0.5 * sizes_.boundary;
        const double least_cells = lost.area / (size * size);
        if (least_cells > static_cast<double>(sizes_.most_cells)) return "they are too thin for any cells";
        return fmt::format("cells of about {:.2g} m instead of {:.2g} keep most of them (mesher.cell_size)",
                           frame_.scale * size, frame_.scale * sizes_.boundary);
    }

    void report_losses(const LatticeSize& size) {
        if (fragments_.removed > 0)
            notes_.push_back(fmt::format("discarded fragments of thin parts: {}", fragments_.removed));
        constexpr double kWorthReporting = 1e-3;  // of the surface; tips of horns are always lost
        const LostParts lost = find_lost_parts(space_, thin_, sizes_, mesh_);
        if (lost.area_fraction > kMostLost) refuse_thinness(size);
        if (fragments_.divided > 0) {
            notes_.push_back(
                fmt::format("connected pieces of the surface that fall apart because they are thin: {}; {}",
                            fragments_.divided, advice_on(lost)));
        }
        if (lost.pieces > 0) {
            notes_.push_back(
                fmt::format("pieces of the surface that are smaller than the cells are missing: {}; {}",
                            lost.pieces, advice_on(lost)));
        } else if (lost.area_fraction > kWorthReporting) {
            report_thin_parts(lost);
        }
    }

    void report_thin_parts(const LostParts& lost) {
        const glm::dvec3 where = frame_.origin + frame_.scale * lost.where;
        notes_.push_back(fmt::format(
            "parts that are thinner than the cells are missing, {:.2g}% of the surface, for instance near "
            "({:.3g}, {:.3g}, "
            "{:.3g}); {}",
            100.0 * lost.area_fraction, where.x, where.y, where.z, advice_on(lost)));
    }

    const std::string name_;
    Notes& notes_;
    const Frame frame_;
    const EnclosedSpace space_;
    ThinParts thin_{space_};
    CellSizes sizes_{};
    Fragments fragments_;
    TetMesh mesh_;
};

}  // namespace

TetMesh fill_with_lattice(const SurfaceMesh& surface, const LatticeSize& size, const std::string& name,
                          Notes& notes) {
    return LatticeFill(surface, name, notes).fill(size);
}

}  // namespace gelatin
