#pragma once

namespace gelatin::test {

/// The largest error of points that random tets of a tenth of a metre carry at some distance from the origin
/// [m], over what single precision may do; infinite where one is not finite, or where more is written. Some
/// points are outside of their tets, some at nodes, some tets flat. No multiple of 64 points. To first order
/// a point is off by a rounding of its own, and by 8 of the weighted differences.
double carry_skin_error(double distance);

}  // namespace gelatin::test
