#include "mesh/lattice/thin_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin::lattice {
namespace {

// About how many pieces there would be, of faces that are not thin.
double count_pieces(const FaceTree& tree, double spacing) {
    double count = 0.0;
    for (const Triangle& face : tree.faces()) {
        const double area = 0.5 * glm::length(glm::cross(face[1] - face[0], face[2] - face[0]));
        const double around = glm::distance(face[0], face[1]) + glm::distance(face[1], face[2]) +
                              glm::distance(face[2], face[0]);
        count += 1.0 + around / spacing + 2.0 * area / (spacing * spacing);
    }
    return count;
}

}  // namespace

glm::dvec3 ThinPlace::middle() const {
    const glm::dvec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    const double length = glm::length(normal);
    const glm::dvec3 center = (face[0] + face[1] + face[2]) / 3.0;
    return length > 0.0 ? center - 0.5 * thickness / length * normal : center;
}

// The search on one face.
struct ThinParts::FaceSearch {
    const EnclosedSpace& space;
    std::unordered_map<std::uint64_t, Known>& known;
    std::uint32_t piece;
    double thickness, spacing;
    std::vector<ThinPlace>& places;

    std::optional<ThinPlace> find(const Triangle& face, std::uint64_t part) {
        Known& of_part = known[part];
        const double whole = space.pieces().thickness[piece];
        if (whole > 0.0 && whole < thickness) {
            const ThinPlace place{face, whole, piece, true};
            if (!of_part.is_inside) of_part.is_inside = space.contains(place.middle());
            if (*of_part.is_inside) return place;
        }
        if (!of_part.found.is_final && of_part.limit < thickness) {
            of_part.found = space.find_thickness(face, thickness);
            of_part.limit = thickness;
        }
        const auto& found = of_part.found.value;
        if (!found || *found >= thickness) return std::nullopt;
        return ThinPlace{face, *found, piece, false};
    }

    void search(const Triangle& face, std::uint64_t part) {
        int longest = 0;
        double length = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double edge = glm::distance(face[k], face[(k + 1) % 3]);
            if (edge <= length) continue;
            length = edge;
            longest = k;
        }
        if (length <= spacing) {
            const auto found = find(face, part);
            if (!found) return;
            if (length <= std::max(found->thickness, 0.5 * spacing)) {
                places.push_back(*found);
                return;
            }
        }
        Triangle first = face, second = face;
        first[(longest + 1) % 3] = second[longest] = 0.5 * (face[longest] + face[(longest + 1) % 3]);
        search(first, 2 * part);
        search(second, 2 * part + 1);
    }
};

std::vector<ThinPlace> ThinParts::find(double thickness, double spacing) {
    constexpr double kMostPieces = 5e4;
    const auto faces = space_.tree().faces();
    const double most = std::max(kMostPieces, 2.0 * static_cast<double>(faces.size()));
    while (count_pieces(space_.tree(), spacing) > most) spacing *= 1.5;
    std::vector<std::vector<ThinPlace>> found(faces.size());
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t f) {
        const std::uint32_t piece = space_.piece_of(static_cast<std::uint32_t>(f));
        FaceSearch{space_, known_[f], piece, thickness, spacing, found[f]}.search(faces[f], 1);
    });
    std::vector<ThinPlace> places;
    for (const auto& of_face : found) places.insert(places.end(), of_face.begin(), of_face.end());
    return places;
}

}  // namespace gelatin::lattice
