#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "model/layouts.h"
#include "model/shared_constants.h"

namespace gelatin {

struct Model;

/// An object has lost its shape where more of its tets than this are inside out ...
constexpr double kMostInverted = 0.25;
/// ... and the affine map of its shape at rest that comes nearest to its nodes explains less than this of how
/// they are spread: flat, squashed and twisted bodies keep to one, nodes at random do not.
using thresholds::kLeastExplained;
/// Or where it is less than this thin. Then nothing but a line or a point is left: parts of what unfolds from
/// it would stay inverted.
using thresholds::kThinnest;
/// For longer than this in a row [s]: bodies that are crushed come back by themselves. What is so when nodes
/// are set from outside does not.
using thresholds::kPatience;

/// The objects' shapes at rest, to be matched with where their nodes are (docs/lost-shapes.md).
struct MatchShapes {
    std::vector<glm::vec4> offsets;  ///< from the object's centre of mass [m], mass [kg], shape [nodes]
    std::vector<RestMoment> objects;
};

/// Of the positions that the model starts from.
MatchShapes make_match_shapes(const Model& model);

}  // namespace gelatin
