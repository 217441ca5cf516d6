#include "mesh/cavity_points.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/closed_pieces.h"
#include "mesh/lattice/face_tree.h"

namespace gelatin {
namespace {

class CavityPoints {
public:
    explicit CavityPoints(const SurfaceMesh& surface) : surface_(surface) {
        for (std::vector<std::uint32_t>& piece : find_closed_pieces(surface.faces)) {
            if (is_inward(piece)) cavities_.push_back(std::move(piece));
        }
    }

    std::vector<glm::dvec3> find() {
        std::vector<glm::dvec3> points;
        if (cavities_.empty()) return points;
        const auto [origin, scale] = enter_unit_cube();
        const lattice::FaceTree tree(surface_);
        for (std::vector<std::uint32_t>& cavity : cavities_)
            points.push_back(origin + scale * find_point(cavity, tree));
        return points;
    }

private:
    // The tree's tolerances are for such a surface.
    std::pair<glm::dvec3, double> enter_unit_cube() {
        glm::dvec3 low(surface_.positions.front()), high = low;
        for (const glm::dvec3& p : surface_.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const double scale = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        for (glm::dvec3& p : surface_.positions) p = (p - low) / scale;
        return {low, scale};
    }

    const glm::dvec3& corner(std::uint32_t face, int k) const {
        return surface_.positions[surface_.faces[face][k]];
    }
    glm::dvec3 area(std::uint32_t face) const {
        return 0.5 * glm::cross(corner(face, 1) - corner(face, 0), corner(face, 2) - corner(face, 0));
    }

    bool is_inward(const std::vector<std::uint32_t>& piece) const {
        const glm::dvec3 origin = corner(piece.front(), 0);
        double volume = 0.0;
        for (const std::uint32_t f : piece) volume += glm::dot(area(f), corner(f, 0) - origin);
        return volume < 0.0;
    }

    // Half-way between a face and the next one in front of it there is no other. Of the largest faces the one
    // with the most space in front of it is taken.
    glm::dvec3 find_point(std::vector<std::uint32_t>& faces, const lattice::FaceTree& tree) const {
        constexpr std::size_t kTries = 16;
        constexpr double kReach = 2.0;  // through the cube
        const std::size_t tries = std::min(kTries, faces.size());
        std::partial_sort(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(tries), faces.end(),
                          [&](std::uint32_t a, std::uint32_t b) {
                              const double first = glm::length(area(a)), second = glm::length(area(b));
                              return first != second ? first > second : a < b;
                          });
        glm::dvec3 best = corner(faces.front(), 0);
        double most = 0.0;
        std::vector<lattice::Crossing> crossings;
        for (std::size_t k = 0; k < tries; ++k) {
            const std::uint32_t face = faces[k];
            // Not the centre: rays from there would meet edges of symmetric cavities.
            const glm::dvec3 start = 0.43 * corner(face, 0) + 0.32 * corner(face, 1) + 0.25 * corner(face, 2);
            const glm::dvec3 ahead = kReach * glm::normalize(area(face));
            tree.find_crossings(start, start + ahead, crossings);
            const auto next = std::find_if(
                crossings.begin(), crossings.end(),
                [&](const lattice::Crossing& crossing) { return tree.sources()[crossing.face] != face; });
            if (next == crossings.end() || next->at <= most) continue;
            most = next->at;
            best = start + 0.5 * most * ahead;
        }
        return best;
    }

    SurfaceMesh surface_;
    std::vector<std::vector<std::uint32_t>> cavities_;
};

}  // namespace

std::vector<glm::dvec3> find_cavity_points(const SurfaceMesh& surface) {
    return CavityPoints(surface).find();
}

}  // namespace gelatin
