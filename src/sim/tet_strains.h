#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// The values of tets in exported frames.
class TetStrains {
public:
    /// @param model its nodes are at rest where they start
    explicit TetStrains(const Model& model);

    struct Values {
        std::vector<float> strains;  ///< Green's, (F^T F - I) / 2, row by row, shape [tets][3][3]
        std::vector<float>
            stresses;  ///< as colours show it (docs/physics.md, "What colours show") [Pa], shape [tets]
    };
    /// @param positions x, y, z of each node [m]
    Values find(std::span<const float> positions) const;

private:
    std::vector<glm::uvec4> tets_;
    std::vector<glm::mat3> inverse_edges_;  // at rest [1/m]
    std::vector<float> shear_moduli_;       // [Pa]
};

}  // namespace gelatin
