#pragma once

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::test {

/// Bodies at rest, `scale` times as large as about 1 m: a large block of two chunks of nodes, a long bar, a
/// block that is held at one end, and a cube.
Model make_bodies_to_lose(double scale = 1.0);

/// Nodes of them, moving at random: with `bar_is_lost` those of all but the cube lie at random in boxes, else
/// the bar is rolled up to a ring, without a tet inside out. The cube is mirrored: all of its tets are.
cpu::Nodes<float> lose_shapes(const Model& model, bool bar_is_lost, float scale = 1.0f);

constexpr double kElapsed = 1.0 / 60.0;  ///< from run to run [s]

/// A run of the matcher on the GPU for each of `runs`, one after the other.
void match_on_gpu(const Model& model, std::vector<cpu::Nodes<float>>& runs);

/// The largest error of runs on the GPU against the double reference, in places over 1e-5 m, in velocities
/// over 1e-4 m/s, both times `scale`: bodies and coordinates are about 1 m large times that, speeds 1 m/s.
double worst_matching_error(double scale = 1.0);

}  // namespace gelatin::test
