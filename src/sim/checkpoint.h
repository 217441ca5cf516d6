#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gelatin/drag.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// A moment of a run, from which it can continue.
struct Checkpoint {
    int frame = 0;
    double time = 0.0;  ///< [s]
    State state;
    std::vector<Drag> drags = {}, drag_targets = {};  ///< of the scene's handles, or none
    std::vector<double> delays = {};                  ///< of these [s], or none
    std::string programmed = {};                      ///< Simulator::Impl::programmed_of; empty: nothing
};

/// A model's tets and faces, as a number: what a state belongs to.
std::uint64_t topology_hash(const Model& model);

/// Writes the exact bits, with the model's topology and a checksum; completely or not at all. @throws
/// SystemError
void write_checkpoint(const std::filesystem::path& file, const Model& model, const Checkpoint& checkpoint);

/// @throws InvalidInput if it is not a checkpoint, is damaged, or was made with other objects than `model`'s.
Checkpoint read_checkpoint(const std::filesystem::path& file, const Model& model);

}  // namespace gelatin
