#pragma once

#include <string>
#include <vector>

#include "gelatin/views.h"

namespace gelatin {

/// What `--overlay` asks for: "boxes", "boxes:3" (with three levels of the trees below), "faces", "springs",
/// "springs:0.02" (full colour at a strain of 2%).
/// @throws InvalidInput naming what is allowed and the nearest name
Overlays parse_overlays(const std::vector<std::string>& texts);

}  // namespace gelatin
