// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h, which has doubles).
// All numbers of contact and the implicit step that are chosen and not derived. Each with its unit, why it is there, and what was
// measured with others; a range that nothing is said of was not searched.
#ifndef __cplusplus
#define REAL const float
#define COUNT const uint
#endif

// Time.

// What users see as one moment [s]. In parts shorter than this contacts are no stiffer than in one of this length: else impacts
// give nothing back. Motors cover what is left to their position in this time. Bodies come to rest that vibrate, and go to and fro,
// more slowly than after a fall of this time; what meets more slowly than after twice of it does not bounce.
REAL kFrame = 1.0 / 60.0;
// Elements and contacts of bodies that hardly move have at least this damping time [s]: towers sway on without it.
REAL kRestingTime = 0.1;
// Nodes that have kept to their places for so long rest [s]. Whatever swings that slowly moves farther.
REAL kSleepTime = 0.5;
// A place, as a part of the thickness of the body's surface: a 2000th of its median edge.
REAL kSleepPlace = 0.01;
// Into how many parts a step is divided at least, where bodies that touch others move, are calm, are still. Scene B keeps 67.6 J of
// 71.3 with four parts, 66.8 with three, 63.9 with two.
COUNT kPartsOfMoving = 4u, kPartsOfCalm = 2u, kPartsOfStill = 1u;
// And at most, where bodies meet fast.
COUNT kMostParts = 256u;
// What is left of fast vibrations in a part, with their sign reversed: (1 - alpha) / (1 + alpha). Slow ones are damped by less the
// nearer it is to 1. 0.5 and 0.85 leave less of scene B.
REAL kLeftOfFast = 0.7;

// The law of contacts. Lengths are parts of the reach.

// From here inwards the force is linear: with the barrier to a ten-thousandth stiff cubes at 10 m/s ended in values that are not
// finite.
REAL kLinearGap = 0.1;
// A chord of the law goes no nearer than to this part of the gap at the start.
REAL kChordGap = 0.25;
// A contact that is found nearer than its reach presses from there, but from this part of it at least; the reach grows to all of it
// within a time [s].
REAL kLeastReach = 1e-3, kEasing = 1.0 / 3.0;
// What lies in a plane at first is pushed out as fast as it is deep, over this time [s].
REAL kPushing = 0.1;
// Parts of one body press from this part of their distance at rest on, if that is less than the reach.
REAL kOfRestGap = 0.5;
// And have no row with a gap of more than so many of these reaches, at the start and as expected: at rest they are two apart.
REAL kIdleGap = 1.5;
// Ties of attachments are so many times as stiff as what they tie together.
REAL kTied = 300.0;
// And those of rigid bodies, which nothing else yields at.
REAL kRigidTied = 1000.0;
// Edges that a neighbour of the face beside them hides from the line by a cosine of this press half as much as edges without. With
// 0.05 a block on a slope of faces is slowed by more than friction.
REAL kSoftened = 0.04;
// A nearest point on a face that is nearer to an edge of it than this part of the gap is on that edge, and what is nearer by less
// is not: by rounding, where flat faces meet, both would press a node, or none.
REAL kOnEdge = 2e-3;

// Detection.

// Nodes may end this far from where they are expected, in thicknesses of the body's surface. With 0.3 the guard finds more pairs
// anew than detection saves; so it does where the slack grows with displacements.
REAL kPathSlack = 0.5;
// Bodies that are convex at the start and keep this part of all distances do not meet themselves. Nearer parts would press from
// half of their distance at rest on, but so far elements resist more than contacts.
REAL kKept = 0.1;
// A part is halved in which contacts would come into each other by so many reaches: by two edges of the surface. With one edge
// frames of three stacked balls took up to 200 ms for it.
REAL kDeepest = 20.0;
// And one in which two objects go so many reaches beside each other.
REAL kFastest = 4.0 * kDeepest;
// And one in which a body with contacts or joints rotates by more than this [rad]. A wheel of 0.1 kg that a motor turns by 90
// degrees in a part explodes; by 75 it does not.
REAL kMostTurn = 1.0;

// The solve.

// A body is nearly in balance where what is left of all forces on it is this part of what presses it: then the limits of friction
// are found anew. It is in balance below the second.
REAL kNearBalance = 0.1, kBalance = 1e-3;
// A step along a direction is shortened where the slope has turned by more than this part of that at its start.
REAL kTurned = 0.1;
// Rounds of the rigid level, and halvings of a step along a direction, at most: these end by themselves.
COUNT kMostRounds = 20u;
// Each round of the rigid level is solved until it lacks this part of the energy that it lacked at first, in so many iterations at
// most.
REAL kRigidForcing = 1e-8;
COUNT kMostRigidIterations = 200u;
// Linearisations of contacts in a part, at most. Each is solved until it lacks this part of the energy that it lacked at first.
COUNT kMostLinearisations = 4u;
REAL kForcing = 0.05;
// Conjugate gradients miss at most this part of the energy of motion. With 1e-3 two balls keep 2 J less of 68.
REAL kTolerance = 1e-4;
// Of that motion is, at least: this part of what gravity adds in a part; this part of a body's share of its island's energy; and so
// many times what rounding makes of positions.
REAL kAtRest = 0.001, kInIsland = 0.1, kRoundings = 2.0;

// The guard.

// What is left of a gap at the end of a part is at least this part of the reach, or of the gap if that is less.
REAL kLeastOfReach = 0.02, kLeastOfGap = 0.9;
// But no less than so many times what rounding makes of it: what comes nearer, step by step, or by rounding of what a frame adds,
// is moved apart again.
REAL kLeastOfRounding = 8.0;
// Of the rest, clipped pairs use this part: with all of it rounding stops bodies at a box for good (`ColliderSurfaces.StopBodies`).
REAL kUsable = 0.95;
// A side of a pair uses at least this part of the gap, if it yields at all.
REAL kLeastShare = 0.05;
// The shortest piece of a motion that is checked by itself. With whole motions 250 to 390 pairs a frame were clipped where soft
// balls roll on each other, with these a tenth.
REAL kShortestPiece = 1.0 / 16.0;
// A node is projected on its half spaces so often before it is shortened.
COUNT kProjections = 12u;
// Detections of a part for its guard alone, at most.
COUNT kMostGuards = 10u;

// Energy and restitution.

// Rounding of energies, as a part of them, and for bodies at rest [J].
REAL kEnergyRounding = 1e-7, kLeastEnergy = 1e-9;
// What is owed up to this part of an island's energy is not taken: energies go to and fro.
REAL kSlackOfEnergy = 0.002;
// A part that gains an island this part of its energy was too long for its linearisation, and is halved. With a tenth bars that
// fold gained energy from part to part.
REAL kMostGain = 0.05;
// An impact is over when what is left of the approach, and what it would still change if it took as long again, are this part of
// the approach.
REAL kLeftOfApproach = 0.1;
// What takes longer is softness [s].
REAL kLongestImpact = 0.1;

// The device.

// A sum over rows begins with so many at most.
COUNT kRowsOfChunk = 16u;
// Passes of the guard in a part, one a try. Scenes hardly ever need more; a part that does is halved.
COUNT kGuardPasses = 3u;
// In each of so many rounds nodes are placed, and pairs of those that have moved are checked; at most 30.
COUNT kGuardRounds = 8u;
