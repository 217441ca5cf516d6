#pragma once

#include <array>
#include <cstdint>

/// All numbers of contact and the implicit step that are chosen and not derived. Each with its unit, why it
/// is there, and what was measured with others; a range that nothing is said of was not searched.
namespace gelatin::cpu::tuning {

// Time.

/// What users see as one moment [s]. In parts shorter than this contacts are no stiffer than in one of this
/// length: else impacts give nothing back.
inline constexpr double kFrame = 1.0 / 60.0;
/// Bodies come to rest that vibrate, and go to and fro, more slowly than after a fall of this time [s]. What
/// meets more slowly than after twice of it does not bounce.
inline constexpr double kRestingFall = kFrame;
/// Elements and contacts of bodies that hardly move have at least this damping time [s]: towers sway on
/// without it.
inline constexpr double kRestingTime = 0.1;
/// Nodes that have kept to their places for so long rest [s]. Whatever swings that slowly moves farther.
inline constexpr double kSleepTime = 0.5;
/// A place, as a part of the thickness of the body's surface: a 2000th of its median edge.
inline constexpr double kSleepPlace = 0.01;
/// Into how many parts a step is divided at least, where bodies that touch others move, are calm, are still.
/// Scene B keeps 67.6 J of 71.3 with four parts, 66.8 with three, 63.9 with two.
inline constexpr std::array<std::uint32_t, 3> kParts{4, 2, 1};
/// And at most, where bodies meet fast.
inline constexpr int kMostParts = 256;
/// What is left of fast vibrations in a part, with their sign reversed: (1 - alpha) / (1 + alpha). Slow ones
/// are damped by less the nearer it is to 1. 0.5 and 0.85 leave less of scene B.
inline constexpr double kLeftOfFast = 0.7;

// The law of contacts. Lengths are parts of the reach.

/// From here inwards the force is linear: with the barrier to a ten-thousandth stiff cubes at 10 m/s ended in
/// values that are not finite.
inline constexpr double kLinearGap = 0.1;
/// A chord of the law goes no nearer than to this part of the gap at the start.
inline constexpr double kChordGap = 0.25;
/// A contact that is found nearer than its reach presses from there, but from this part of it at least; the
/// reach grows to all of it within a time [s].
inline constexpr double kLeastReach = 1e-3, kEasing = 1.0 / 3.0;
/// What lies in a plane at first is pushed out as fast as it is deep, over this time [s].
inline constexpr double kPushing = 0.1;
/// Parts of one body press from this part of their distance at rest on, if that is less than the reach.
inline constexpr double kOfRestGap = 0.5;
/// And have no row with a gap of more than so many of these reaches, at the start and as expected: at rest
/// they are two apart.
inline constexpr double kIdleGap = 1.5;
/// Ties of attachments are so many times as stiff as what they tie together.
inline constexpr double kTied = 300.0;
/// And those of rigid bodies, which nothing else yields at.
inline constexpr double kRigidTied = 1000.0;
/// Motors cover what is left to their position in this time [s].
inline constexpr double kServo = kFrame;
/// Edges of which a neighbour of the face beside them is in the way of the line by a cosine of this press
/// half as much as edges without. With 0.05 a block on a slope of faces is slowed by more than friction.
inline constexpr double kSoftened = 0.04;
/// A nearest point on a face that is nearer to an edge of it than this part of the gap is on that edge, and
/// what is nearer by less is not: by rounding, where flat faces meet, both would press a node, or none.
inline constexpr double kOnEdge = 2e-3;

// Detection.

/// Nodes may end this far from where they are expected, in thicknesses of the body's surface. With 0.3 the
/// guard finds more pairs anew than detection saves; so it does where the slack grows with displacements.
inline constexpr double kPathSlack = 0.5;
/// Bodies that are convex at the start and keep this part of all distances do not meet themselves. Nearer
/// parts would press from half of their distance at rest on, but so far elements resist more than contacts.
inline constexpr double kKept = 0.1;
/// A part is halved in which contacts would come into each other by so many reaches: by two edges of the
/// surface. With one edge frames of three stacked balls took up to 200 ms for it.
inline constexpr double kDeepest = 20.0;
/// And one in which two objects go so many reaches beside each other.
inline constexpr double kFastest = 4.0 * kDeepest;

// The solve.

/// A body is nearly in balance where what is left of all forces on it is this part of what presses it: then
/// the limits of friction are found anew. It is in balance below the second.
inline constexpr double kNearBalance = 0.1, kBalance = 1e-3;
/// A step along a direction is shortened where the slope has turned by more than this part of that at its
/// start.
inline constexpr double kTurned = 0.1;
/// Rounds of the rigid level, and halvings of a step along a direction, at most: these end by themselves.
inline constexpr int kMostRounds = 20;
/// Each round of the rigid level is solved until it lacks this part of the energy that it lacked at first, in
/// so many iterations at most.
inline constexpr double kRigidForcing = 1e-8;
inline constexpr int kMostRigidIterations = 200;
/// Linearisations of contacts in a part, at most. Each is solved until it lacks this part of the energy that
/// it lacked at first.
inline constexpr int kMostLinearisations = 4;
inline constexpr double kForcing = 0.05;
/// Conjugate gradients miss at most this part of the energy of motion. With 1e-3 two balls keep 2 J less
/// of 68.
inline constexpr double kTolerance = 1e-4;
/// Of that motion is, at least: this part of what gravity adds in a part; this part of a body's share of its
/// island's energy; and so many times what rounding makes of positions.
inline constexpr double kAtRest = 0.001, kInIsland = 0.1, kRoundings = 2.0;

// The guard.

/// What is left of a gap at the end of a part is at least this part of the reach, or of the gap if that is
/// less.
inline constexpr double kLeastOfReach = 0.02, kLeastOfGap = 0.9;
/// But no less than so many times what rounding makes of it: what comes nearer, step by step, or by rounding
/// of what a frame adds, is moved apart again.
inline constexpr double kLeastOfRounding = 8.0;
/// Of the rest, clipped pairs use this part: with all of it rounding stops bodies at a box for good
/// (`ColliderSurfaces.StopBodies`).
inline constexpr double kUsable = 0.95;
/// A side of a pair uses at least this part of the gap, if it yields at all.
inline constexpr double kLeastShare = 0.05;
/// The shortest piece of a motion that is checked by itself. With whole motions 250 to 390 pairs a frame were
/// clipped where soft balls roll on each other, with these a tenth.
inline constexpr double kShortestPiece = 1.0 / 16.0;
/// A node is projected on its half spaces so often before it is shortened.
inline constexpr int kProjections = 12;
/// Detections of a part for its guard alone, at most.
inline constexpr int kMostGuards = 10;

// Energy and restitution.

/// Rounding of energies, as a part of them, and for bodies at rest [J].
inline constexpr double kEnergyRounding = 1e-7, kLeastEnergy = 1e-9;
/// What is owed up to this part of an island's energy is not taken: energies go to and fro.
inline constexpr double kSlackOfEnergy = 0.002;
/// A part that gains an island this part of its energy was too long for its linearisation, and is halved.
/// With a tenth bars that fold gained energy from part to part.
inline constexpr double kMostGain = 0.05;
/// An impact is over when what is left of the approach, and what it would still change if it took as long
/// again, are this part of the approach.
inline constexpr double kLeftOfApproach = 0.1;
/// What takes longer is softness [s].
inline constexpr double kLongestImpact = 0.1;

}  // namespace gelatin::cpu::tuning
