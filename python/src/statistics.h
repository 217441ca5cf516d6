#pragma once

#include <nanobind/nanobind.h>

#include "gelatin/simulator.h"

namespace gelatin::python {

/// The measurements of a frame as a dict, with the keys of `gelatin run --stats` and names instead of
/// indices.
nanobind::dict to_dict(const FrameStatistics& frame, const Simulator& simulator);

}  // namespace gelatin::python
