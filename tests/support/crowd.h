#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "cpu/collision/collision.h"
#include "cpu/nodes.h"
#include "gl/buffer.h"
#include "model/model.h"
#include "support/step_on_gpu.h"

namespace gelatin::test {

/// `count` blocks of different sizes and turns, thrown so close together that many overlap, each in motion;
/// some nodes of the first are pinned.
Model make_crowd(int count, unsigned seed = 1);

/// Gives pinned nodes a velocity, as handles do.
void move_pinned(Model& model, const glm::vec3& velocity);

/// `count` pairs of cubes of 5 cm that overlap a little, turned at random and strewn over a cube of side
/// `extent` [m].
Model make_far_pairs(int count, double extent, unsigned seed = 1);

/// A face, the object that it touches, and how.
struct FaceCollision {
    std::uint32_t face, other;
    cpu::FaceContact touch;

    bool operator==(const FaceCollision&) const = default;
    bool operator<(const FaceCollision& o) const { return std::tie(face, other) < std::tie(o.face, o.other); }
};

/// In ascending order.
using FaceCollisions = std::vector<FaceCollision>;

/// What brute force in double precision, over all faces and without boxes, finds in the model's start.
FaceCollisions find_collisions_by_brute_force(const Model& model);

/// What the CPU's stages find in the model's start, by continuous detection in the step [s] before it.
template <class Real>
FaceCollisions find_collisions_on_cpu(const Model& model, const CollisionSettings& settings, double step = 0);

/// What the GPU's stages find, every buffer that they write poisoned first.
FaceCollisions find_collisions_on_gpu(const Model& model, const CollisionSettings& settings, double step = 0);

/// The marks of the faces that the GPU's stages find, poisoned first; empty if anything behind them was
/// written.
std::vector<std::uint32_t> mark_faces_on_gpu(const Model& model, const CollisionSettings& settings = {});

/// Where the model's nodes were a step before its start [m], [s].
std::vector<glm::vec4> positions_before(const Model& model, double step);

/// The model's start after the response to what collides in it, in the precision of `Real`.
template <class Real>
cpu::Nodes<Real> respond_on_cpu(const Model& model, const CollisionSettings& settings, double step);

/// The same on the GPU, every buffer between the stages poisoned first, kGuard elements behind the nodes.
NodeArrays respond_on_gpu(const Model& model, const CollisionSettings& settings, double step);

/// Fills a buffer, so that an element that is not written cannot pass.
template <class T>
void poison(gl::Buffer<T>& buffer) {
    const std::vector<std::uint32_t> words(buffer.size() * sizeof(T) / 4, 0xDEADBEEFu);
    buffer.upload({reinterpret_cast<const T*>(words.data()), buffer.size()});
}

/// The largest error of the nodes over its bound [m], [m/s]; infinite where something is not finite.
double worst_node_error(const cpu::Nodes<double>& expected, const NodeArrays& actual, double position_bound,
                        double velocity_bound);

/// The largest error of a response against the double reference, over its bound; infinite where something is
/// not finite. At most 1 is a pass. A response is a quotient of sums over a patch: some 500 corners of speeds
/// below 5 m/s, summed in single precision over 64 lanes, give 128 eps of the speed, and the same of the
/// displacement of a step.
double worst_response_error(const Model& model, const CollisionSettings& settings, double step,
                            const NodeArrays& actual);

}  // namespace gelatin::test
