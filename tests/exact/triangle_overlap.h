#pragma once

#include "cpu/collision/triangle_overlap.h"

namespace gelatin::test {

/// cpu::triangles_overlap in exact arithmetic, by CGAL: the truth that it is held against. Finite
/// coordinates.
bool exactly_overlap(const cpu::Triangle<double>& s, const cpu::Triangle<double>& t);

/// How far apart two triangles are that do not overlap [m].
double distance_apart(const cpu::Triangle<double>& s, const cpu::Triangle<double>& t);

}  // namespace gelatin::test
