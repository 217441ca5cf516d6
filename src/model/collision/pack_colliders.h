#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "model/layouts.h"

namespace gelatin {

/// Colliders as every backend has them, in the order of their kinds.
std::vector<Collider> pack_colliders(const std::vector<ColliderDescription>& colliders);

}  // namespace gelatin
