#pragma once

#include <string>
#include <string_view>

#include "model/model.h"
#include "model/solver.h"
#include "sim/checkpoint.h"
#include "sim/recording/earlier_neighbours.h"

namespace gelatin {

/// A moment in a recording: all that a run can continue from, and the forces that were found.
struct RecordedFrame {
    Checkpoint moment;
    ContactForces contacts;  ///< on nodes in single precision; no arrays: not found
    HoldingForces holds;     ///< the same
};

/// A frame as bytes, from which decoded_frame makes the same, to the last bit of what a solver in single
/// precision has. Only earlier velocities may be left out, if they are not the velocities of `previous`.
/// @param neighbours of its model @param previous from which it is predicted, as decoded; null: it is not
std::string encoded_frame(const RecordedFrame& frame, const EarlierNeighbours& neighbours,
                          const RecordedFrame* previous);

/// @param model of the recorded scene @param previous as it was for encoded_frame
/// @throws InvalidInput without a file's name, if these are not the bytes of such a frame
RecordedFrame decoded_frame(std::string_view bytes, const Model& model, const EarlierNeighbours& neighbours,
                            const RecordedFrame* previous);

}  // namespace gelatin
