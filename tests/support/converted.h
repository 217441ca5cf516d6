#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "cpu/nodes.h"

namespace gelatin::test {

/// A model's vectors in the precision of a solver.
template <class Real>
std::vector<cpu::Vec4<Real>> converted(const std::vector<glm::vec4>& values) {
    return {values.begin(), values.end()};
}

}  // namespace gelatin::test
