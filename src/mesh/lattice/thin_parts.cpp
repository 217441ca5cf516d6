#include "mesh/lattice/thin_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin::lattice {
namespace {

struct Search {
    const EnclosedSpace& space;
    double thickness, spacing, least;

    std::optional<double> find(const Triangle& face, double piece) const {
        const bool is_small = piece > 0.0 && piece < thickness && space.contains(ThinPlace{face, piece}.middle());
        return is_small ? std::optional(piece) : space.find_thickness(face, thickness);
    }

    // `piece` is the thickness of the whole piece of the surface, or 0.
    void add(const Triangle& face, double piece, std::vector<ThinPlace>& places) const {
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
            if (length <= std::max(*found, least)) {
                places.push_back({face, *found});
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
        count += 1.0 + 2.0 * area / (spacing * spacing);
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

std::vector<ThinPlace> find_thin_places(const EnclosedSpace& space, double thickness, double spacing, double least) {
    constexpr double kMostPieces = 1e6;  // wider apart on surfaces that are folded again and again
    const double count = count_pieces(space.tree(), spacing);
    if (count > kMostPieces) spacing *= std::sqrt(count / kMostPieces);
    const Search search{space, thickness, spacing, least};
    const auto faces = space.tree().faces();
    std::vector<std::vector<ThinPlace>> found(faces.size());
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t f) {
        const double piece = space.pieces().thickness[space.piece_of(static_cast<std::uint32_t>(f))];
        search.add(faces[f], piece, found[f]);
    });
    std::vector<ThinPlace> places;
    for (const auto& of_face : found) places.insert(places.end(), of_face.begin(), of_face.end());
    return places;
}

}  // namespace gelatin::lattice
