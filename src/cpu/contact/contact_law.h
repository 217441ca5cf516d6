#pragma once

#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

#include "cpu/contact/contact_law.inl"

}  // namespace gelatin::cpu
