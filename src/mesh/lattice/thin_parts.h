#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mesh/lattice/enclosed_space.h"

namespace gelatin::lattice {

/// A piece of a face behind which the enclosed space is thin.
struct ThinPlace {
    Triangle face;
    double thickness;     ///< [m]
    std::uint32_t piece;  ///< of the surface
    bool is_small_piece;  ///< all of that is as small as `thickness`

    /// Half of the thickness behind the middle of the face.
    glm::dvec3 middle() const;
};

/// Searches for thin parts of an enclosed space. Each search knows what those before it found, so that many
/// searches for one mesh cost little more than the widest.
class ThinParts {
public:
    /// @param space must outlive this
    explicit ThinParts(const EnclosedSpace& space) : space_(space), known_(space.tree().faces().size()) {}

    /// Where the enclosed space is thinner than `thickness`, and all faces of closed pieces that are smaller
    /// than that. Faces are divided into pieces: none longer than `spacing`, and none longer than half of
    /// that where it is thin; longer ones where the surface is folded again and again.
    std::vector<ThinPlace> find(double thickness, double spacing);

private:
    // What is known of a part of a face. Part 1 is the whole face, and 2 k and 2 k + 1 are halves of part k.
    struct Known {
        Thickness found = {{}, false};
        double limit = 0.0;                  // up to which was searched
        std::optional<bool> is_inside = {};  // the middle, if the piece of the surface is small
    };
    struct FaceSearch;

    const EnclosedSpace& space_;
    std::vector<std::unordered_map<std::uint64_t, Known>> known_;  // of each face, by part
};

}  // namespace gelatin::lattice
