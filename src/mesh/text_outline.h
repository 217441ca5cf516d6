#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace gelatin {

/// A closed polygon: the last point is joined to the first.
using Contour = std::vector<glm::dvec2>;

/// Outlines of a text as polygons, in ems, the first letter's origin at (0, 0), +y up; lines end with '\n'.
/// Curves are flattened to half a percent of the em. Neighbouring points are at least a thousandth of it
/// apart. The nonzero winding rule defines the inside.
/// @param text UTF-8
/// @param font see find_font.h
/// @throws InvalidInput if the font does not exist or has no outlines, the text is not UTF-8, or a letter is
///   not in the font.
std::vector<Contour> outline_text(const std::string& text, const std::string& font);

}  // namespace gelatin
