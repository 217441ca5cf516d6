// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h, which has doubles).
// All numbers of contact and the implicit step that are chosen and not derived. Each with its unit, why it is there, and what was
// measured with others. Half and twice as much of any but those marked with * change kinetic energies of scenes A and B of
// bench/peers by less than 2% (docs/decisions/0090-fewer-constants.md).
#ifndef __cplusplus
#define REAL const float
#define COUNT const uint
#endif

// What is less than this part of something: nearly all is left of it or found; it hardly counts; and in between.
//
// Nearly: bodies are in balance when what is left of all forces on them is so little of what presses them, and the limits of friction
// are found anew. A step along a direction is short enough when the slope at its end is so much of that at its start, if it has turned.
// An impact is over when so much of the approach is left, and when it would not change more if it took as long again. Of the energy of
// an island a body's share counts so much in what conjugate gradients may miss. Bodies that are convex at the start and keep so much
// of all distances do not meet themselves: nearer parts would press from half of their distance at rest on, but so far elements resist
// more than contacts.
REAL kNearly = 0.1;
// Slightly: so much of what it lacks at first may be left of a linearised system; an island may gain so much of its energy in a part,
// else the part is halved (with a tenth bars that fold gained energy from part to part); of a gap each side uses that at least, and
// both leave that when they are clipped (with all of it rounding stops bodies at a box for good: `ColliderSurfaces.StopBodies`).
REAL kSlightly = 0.05;
// Hardly: bodies are in balance; motion is what gravity adds in a part, times this, at least; a contact that is found too near presses
// from so much of its reach at least; a nearest point is on an edge that it is nearer to than so much of the gap (by rounding, where
// flat faces meet, both would press a node, or none); twice so much of an island's energy is owed and not taken, as energies go to and
// fro.
REAL kHardly = 1e-3;

// Time.

// What users see as one moment [s]. In parts shorter than this contacts are no stiffer than in one of this length: else impacts
// give nothing back. Motors cover what is left to their position in this time. Bodies come to rest that vibrate, and go to and fro,
// more slowly than after a fall of this time; what meets more slowly than after twice of it does not bounce.
REAL kFrame = 1.0 / 60.0;
// What takes longer is no impact [s]. What lies in a plane at first is pushed out over this time. Elements and contacts of bodies that
// hardly move have at least this damping time: towers sway on without it.
REAL kImpactTime = 0.1;
// Nodes that have kept to their places for so long rest [s]. Whatever swings that slowly moves farther.
REAL kSleepTime = 0.5;
// A place, as a part of the thickness of the body's surface: a 2000th of its median edge.
REAL kSleepPlace = 0.01;
// Into how many parts a step is divided at least, where bodies that touch others move, are calm, are still. Scene B keeps 67.6 J of
// 71.3 with four parts, 66.8 with three, 63.9 with two. *
COUNT kPartsOfMoving = 4u, kPartsOfCalm = 2u, kPartsOfStill = 1u;
// And at most, where bodies meet fast.
COUNT kMostParts = 256u;
// What is left of fast vibrations in a part, with their sign reversed: (1 - alpha) / (1 + alpha). Slow ones are damped by less the
// nearer it is to 1. 0.5 and 0.85 leave less of scene B. *
REAL kLeftOfFast = 0.7;

// The law of contacts. Lengths are parts of the reach.

// From here inwards the force is linear: with the barrier to a ten-thousandth stiff cubes at 10 m/s ended in values that are not
// finite. A chord of the law goes no nearer than to the second part of the gap at the start: with 0.1 a block that is lifted out of a
// plane leaves it with 1.5 m/s. *
REAL kLinearGap = 0.1, kChordGap = 0.25;
// Reaches that begin smaller grow to all within a time [s].
REAL kEasing = 1.0 / 3.0;
// Parts of one body press from this part of their distance at rest on, if that is less than the reach.
REAL kOfRestGap = 0.5;
// And have no row with a gap of more than so many of these reaches, at the start and as expected: half-way to where they are at rest.
REAL kIdleGap = 0.5 + 0.5 / kOfRestGap;
// Ties of attachments are so many times as stiff as what they tie together.
REAL kTied = 300.0;
// And those of rigid bodies, which nothing else yields at.
REAL kRigidTied = 1000.0;
// Edges that a neighbour of the face beside them hides from the line by a cosine of this press half as much as edges without. With
// 0.05 a block on a slope of faces is slowed by more than friction.
REAL kSoftened = 0.04;

// Detection.

// Nodes may end this far from where they are expected, in thicknesses of the body's surface. With 0.3 the guard finds more pairs
// anew than detection saves; so it does where the slack grows with displacements.
REAL kPathSlack = 0.5;
// A part is halved in which contacts would come into each other by so many reaches: by two edges of the surface. With one edge
// frames of three stacked balls took up to 200 ms for it.
REAL kDeepest = 20.0;
// And one in which two objects go so many reaches beside each other.
REAL kFastest = 4.0 * kDeepest;
// And one in which a body with contacts or joints rotates by more than this [rad]. A wheel of 0.1 kg that a motor turns by 90
// degrees in a part explodes; by 75 it does not.
REAL kMostTurn = 1.0;

// The solve.

// Rounds that end by themselves, at most: of the rigid level, of halvings of a step along a direction, of projections of a node on
// its half spaces, of detections of a part for its guard alone.
COUNT kMostRounds = 20u;
// Each round of the rigid level is solved until it lacks this part of the energy that it lacked at first, in so many iterations at
// most.
REAL kRigidForcing = 1e-8;
COUNT kMostRigidIterations = 200u;
// Linearisations of contacts in a part, at most. *
COUNT kMostLinearisations = 4u;
// Conjugate gradients miss at most this part of the energy of motion. With 1e-3 two balls keep 2 J less of 68. So many times what
// rounding makes of positions is motion, too: with 8 what presses a ball differs by 0.13% from what holds it (`HertzLong`).
REAL kTolerance = 1e-4, kRoundings = 2.0;

// The guard.

// What is left of a gap at the end of a part is at least this part of the reach, or of the gap if that is less.
REAL kLeastOfReach = 0.02, kLeastOfGap = 0.9;
// But no less than so many times what rounding makes of it: what comes nearer, step by step, or by rounding of what a frame adds,
// is moved apart again.
REAL kLeastOfRounding = 8.0;
// The shortest piece of a motion that is checked by itself. With whole motions 250 to 390 pairs a frame were clipped where soft
// balls roll on each other, with these a tenth.
REAL kShortestPiece = 1.0 / 16.0;

// Rounding of energies, as a part of them, and of bodies at rest [J/kg]: what they move with at 0.04 mm/s.
REAL kEnergyRounding = 1e-7, kLeastEnergy = 1e-9;

// The device.

// A sum over rows begins with so many at most.
COUNT kRowsOfChunk = 16u;
// Passes of the guard in a part, one a try. Scenes hardly ever need more; a part that does is halved.
COUNT kGuardPasses = 3u;
// In each of so many rounds nodes are placed, and pairs of those that have moved are checked; at most 30.
COUNT kGuardRounds = 8u;
