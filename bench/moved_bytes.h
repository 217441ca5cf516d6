#pragma once

#include "model/model.h"

namespace gelatin {

/// @name What parts of an implicit step read and write at least, with gathers counted once for each node
/// Of elements alone, not of contacts [bytes].
/// @{
double linearise_bytes(const Model& model);
/// An iteration of the solve: the matrix, and five fields that are read and written.
double iteration_bytes(const Model& model);
/// @}

}  // namespace gelatin
