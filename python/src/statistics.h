#pragma once

#include <nanobind/nanobind.h>

#include <vector>

#include "gelatin/simulator.h"

namespace gelatin::python {

/// A list of dicts.
nanobind::list to_list(const std::vector<AttachmentStatus>& attachments);
nanobind::list to_list(const std::vector<CavityStatus>& cavities, const Simulator& simulator);

/// The measurements of a frame as a dict, with the keys of `gelatin run --stats` and names instead of
/// indices.
nanobind::dict to_dict(const FrameStatistics& frame, const Simulator& simulator);

}  // namespace gelatin::python
