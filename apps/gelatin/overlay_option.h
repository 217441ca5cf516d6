#pragma once

#include <string>
#include <vector>

#include "gelatin/views.h"

namespace gelatin {

/// The value of `--overlay`: names with fields after colons, see docs/command-line.md: "faces", "boxes:3",
/// "boxes:3:alone", "springs:0.02", "stress:2e4", "cut:z", "cut:1:0:1:0.25", "velocity:0.1", "objects", ...
/// @throws InvalidInput naming what is allowed and the nearest name
Overlays parse_overlays(const std::vector<std::string>& texts);

}  // namespace gelatin
