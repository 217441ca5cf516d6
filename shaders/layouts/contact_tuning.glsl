// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// The numbers of cpu/contact/tuning.h that shaders need; tests/gpu/implicit/step_system_test.cpp compares them.
const float kLinearGap = 0.1;
const float kChordGap = 0.25;
const float kNearBalance = 0.1;
const float kBalance = 1e-3;
const float kTurned = 0.1;
const uint kMostRounds = 20u;
const float kRigidForcing = 1e-8;
const uint kMostRigidIterations = 200u;
const float kRestingFall = 1.0 / 60.0;
const uint kMostParts = 256u;
const float kLeftOfFast = 0.7;
const float kLeastOfReach = 0.02;
const float kLeastOfGap = 0.9;
const uint kProjections = 12u;
const float kEnergyRounding = 1e-7;
const float kLeastEnergy = 1e-9;
const float kSlackOfEnergy = 0.002;
const float kMostGain = 0.05;
const float kLeftOfApproach = 0.1;
const float kLongestImpact = 0.1;
const uint kMostLinearisations = 4u;
const float kForcing = 0.05;
// A sum over rows begins with so many at most.
const uint kRowsOfChunk = 16u;
// Where a part of a step begins.
const float kFrame = 1.0 / 60.0;
const float kRestingTime = 0.1;
const float kSleepTime = 0.5;
const float kSleepPlace = 0.01;
const uint kPartsOfMoving = 4u;
const uint kPartsOfCalm = 2u;
const uint kPartsOfStill = 1u;
const float kLeastReach = 1e-3;
const float kEasing = 1.0 / 3.0;
const float kPushing = 0.1;
const float kOfRestGap = 0.5;
const float kSoftened = 0.04;
const float kOnEdge = 2e-3;
const float kPathSlack = 0.5;
const float kIdleGap = 1.5;
const float kDeepest = 20.0;
const float kFastest = 80.0;
const float kTolerance = 1e-4;
const float kAtRest = 0.001;
const float kInIsland = 0.1;
const float kRoundings = 2.0;
const float kKept = 0.1;
// The guard of pairs.
const float kLeastOfRounding = 8.0;
const float kUsable = 0.95;
const float kLeastShare = 0.05;
const float kShortestPiece = 1.0 / 16.0;
// Of a part, one a try. Scenes hardly ever need more; a part that does is halved.
const uint kGuardPasses = 3u;
// In each of so many rounds nodes are placed, and pairs of those that have moved are checked; at most 30.
const uint kGuardRounds = 8u;
