// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// What the end of a part sums over nodes, in doubles: by chunk, or by collider and chunk. Places in these sums.
// Of a body's motion: masses m of free nodes [kg], and about its centre where the part began m r, m r r^T (xx, yy, zz; yz, zx, xy),
// momentum, angular momentum.
const uint kMass = 0u;
const uint kArm = 1u;
const uint kSquare = 4u;
const uint kBeside = 7u;
const uint kMomentum = 10u;
const uint kAngular = 13u;
const uint kMotionSums = 16u;
// Behind them, where nodes have moved: forces of all but elements and gravity, their moments, m d.
const uint kForce = 16u;
const uint kMoment = 19u;
const uint kMoved = 22u;
const uint kFinishSums = 36u;
// Behind these of free nodes where the part began: momentum, angular momentum about the centre, m r; kinetic and potential energy [J].
const uint kStart = 25u;
// Or energies [J], and angular momentum about the centre with the arms where the part began.
const uint kElastic = 16u;
const uint kKinetic = 17u;
const uint kPotential = 18u;
const uint kTurning = 19u;
const uint kEnergySums = 22u;
// Of contacts where the part began and ends, and work [J]; what presses, and times it how fast; m v^2 beside the rigid motion; the
// greatest speed.
const uint kContactsAtStart = 0u;
const uint kContactsAtEnd = 1u;
const uint kWork = 2u;
const uint kPressing = 3u;
const uint kApproach = 4u;
const uint kSquares = 5u;
const uint kGreatestSpeed = 6u;
// Then what is in kStart.
const uint kStartMomentum = 7u;
const uint kStartAngular = 10u;
const uint kStartArm = 13u;
const uint kStartKinetic = 16u;
const uint kStartPotential = 17u;
const uint kPartSums = 18u;
// Of a body, over its chunks: both; then what it vibrates with [J].
const uint kVibrations = 40u;
const uint kObjectSums = 41u;
// Of an island, at its first body: what it owes, and of that more than the slack [J]; what it vibrates with [J]; its mass [kg]; what
// it has gained beyond vibrations, as a part of its energy then.
const uint kIslandOwed = 0u;
const uint kIslandDues = 1u;
const uint kIslandVibrations = 2u;
const uint kIslandMass = 3u;
const uint kIslandGain = 4u;
const uint kIslandSums = 5u;
// Of what presses a body on a collider with restitution: force, force n, its moment, force times the arm.
const uint kPressed = 0u;
const uint kPressedForce = 1u;
const uint kPressedMoment = 4u;
const uint kPressedArm = 7u;
const uint kPressedSums = 10u;
// Of what the guard has moved: how many nodes it has held, how many it has moved, and by masses: changes of velocity, their moments.
const uint kHeldBack = 0u;
const uint kStopped = 1u;
const uint kChange = 2u;
const uint kChangeMoment = 5u;
const uint kGuardSums = 8u;
// An impact of a body on a collider: the time since they met [s], 0: there is none; the speed then [m/s]; the body's energy then [J];
// the size of all impulses [N s], their sum, and the sum of their sizes times arms.
const uint kMetTime = 0u;
const uint kMetSpeed = 1u;
const uint kMetEnergy = 2u;
const uint kMetSize = 3u;
const uint kMetImpulse = 4u;
const uint kMetArm = 7u;
const uint kMeeting = 10u;
// Of an impact of two objects, the same of what presses the second, with arms from the centre of a body of the two that is free, the
// second if both are; then the velocity of what is not free, times the sizes; both objects; and 1 + the number of the pair in the
// tables by which they press each other now, 0: none.
const uint kMetHeld = 10u;
const uint kMetFirst = 13u;
const uint kMetSecond = 14u;
const uint kMetPress = 15u;
const uint kPairMeeting = 16u;
// Of what presses two objects in a part: both; force; on the second force n; its moment about the centres of the second and of the
// first; force times the arm; force times the velocity of what is not free; and by how much that takes them apart.
const uint kPairFirst = 0u;
const uint kPairSecond = 1u;
const uint kPairForce = 2u;
const uint kPairPushed = 3u;
const uint kPairMoment = 6u;
const uint kPairOpposite = 9u;
const uint kPairArm = 12u;
const uint kPairHeld = 15u;
const uint kPairApart = 18u;
const uint kPairSums = 19u;
