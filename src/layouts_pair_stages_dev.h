#pragma once
#include <cstdint>
namespace gelatin { using uint = std::uint32_t;
namespace pair_stages {
#include "layouts/pair_stages.glsl"
} }
