#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/lattice/enclosed_space.h"

namespace gelatin::lattice {

/// A piece of a face behind which the enclosed space is thin.
struct ThinPlace {
    Triangle face;
    double thickness;  ///< [m]
    std::optional<std::uint32_t> small_piece =
        {};  ///< the piece of the surface, if all of it is as small as that

    /// Half of the thickness behind the middle of the face.
    glm::dvec3 middle() const;
};

/// Where the enclosed space is thinner than `thickness`, and all faces of closed pieces that are smaller than
/// that. Faces are divided into pieces: none longer than `spacing`, and none longer than half of that where
/// it is thin; longer ones where the surface is folded again and again.
std::vector<ThinPlace> find_thin_places(const EnclosedSpace& space, double thickness, double spacing);

}  // namespace gelatin::lattice
