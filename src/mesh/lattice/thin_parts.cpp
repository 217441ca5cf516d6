#include "mesh/lattice/thin_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin::lattice {
namespace {

struct Search {
    const EnclosedSpace& space;
    double thickness, spacing;

    std::optional<ThinPlace> find(const Triangle& face, std::uint32_t piece) const {
        const double whole = space.pieces().thickness[piece];
        const bool is_small =
            whole > 0.0 && whole < thickness && space.contains(ThinPlace{face, whole}.middle());
        if (is_small) return ThinPlace{face, whole, piece};
        const auto found = space.find_thickness(face, thickness);
        return found ? std::optional(ThinPlace{face, *found}) : std::nullopt;
    }

    void add(const Triangle& face, std::uint32_t piece, std::vector<ThinPlace>& places) const {
        int longest = 0;
        double length = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double edge = glm::distance(face[k], face[(k + 1) % 3]);
            if (edge <= length) continue;
            length = edge;
            longest = k;
        }
        if (length <= spacing) {
            const auto found = find(face, piece);
            if (!found) return;
            if (length <= std::max(found->thickness, 0.5 * spacing)) {
                places.push_back(*found);
                return;
            }
        }
        Triangle first = face, second = face;
        first[(longest + 1) % 3] = second[longest] = 0.5 * (face[longest] + face[(longest + 1) % 3]);
        add(first, piece, places);
        add(second, piece, places);
    }
};

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

std::vector<ThinPlace> find_thin_places(const EnclosedSpace& space, double thickness, double spacing) {
    constexpr double kMostPieces = 5e4;
    const double most = std::max(kMostPieces, 2.0 * static_cast<double>(space.tree().faces().size()));
    while (count_pieces(space.tree(), spacing) > most) spacing *= 1.5;
    const Search search{space, thickness, spacing};
    const auto faces = space.tree().faces();
    std::vector<std::vector<ThinPlace>> found(faces.size());
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t f) {
        search.add(faces[f], space.piece_of(static_cast<std::uint32_t>(f)), found[f]);
    });
    std::vector<ThinPlace> places;
    for (const auto& of_face : found) places.insert(places.end(), of_face.begin(), of_face.end());
    return places;
}

}  // namespace gelatin::lattice
