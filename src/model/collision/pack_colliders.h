#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "model/layouts.h"

namespace gelatin {

/// Colliders in the form that all backends use, sorted by kind.
std::vector<Collider> pack_colliders(const std::vector<ColliderDescription>& colliders);

}  // namespace gelatin
