#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "model/layouts.h"
#include "model/model.h"

namespace gelatin::test {

/// Where the nodes of a model are wanted at the end of a part.
struct Wishes {
    std::shared_ptr<const Model> model;
    std::vector<glm::vec4> ends = {};          ///< [m]; w: inverse mass
    std::vector<glm::vec4> expected = {};      ///< ends of paths for which pairs are found; none: as wanted
    std::vector<float> compliances = {};       ///< [m/N]; none: those of a part of 1/240 s
    bool own = false;                          ///< bodies meet themselves
    std::optional<std::size_t> capacity = {};  ///< of pairs
    bool loses_always = false;                 ///< each run finds that bodies have lost something
    bool is_long = false;                      ///< the part may be halved
    bool is_full = false;                      ///< pairs have no place
};

/// Where they go.
struct Guarded {
    std::vector<glm::dvec4> ends, path_ends;
    bool is_changed = false, is_given_up = false;
    std::size_t clipped = 0;  ///< of the first run
    std::uint32_t runs = 0;
    StepClock clock{};  ///< on the device
};

/// cpu::ImplicitStep<Real>::guard.
template <class Real>
Guarded guard_on_cpu(const Wishes& wishes);
/// gpu::PairGuard, with pairs of the CPU.
Guarded guard_on_gpu(const Wishes& wishes);

/// Whether faces touch on the straight ways of their nodes, or may do so: those of two objects, and of one
/// without a common corner. In double precision.
bool touch_on_the_way(const Wishes& wishes, const std::vector<glm::dvec4>& ends);

}  // namespace gelatin::test
