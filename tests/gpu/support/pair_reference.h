#pragma once

#include "gpu/support/pairs_on_gpu.h"

namespace gelatin::test {

/// The largest error of what the device found against cpu::FindPairs<double> of the same paths, over its
/// bound.
double error_of_pairs(const PairCase& at, const FoundPairs& found);

/// Of the slots and their ranges of pairs alone.
double error_of_slots(const FoundPairs& found);

}  // namespace gelatin::test
