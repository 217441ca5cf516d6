// How many invocations an island gets. In software, where they take turns, fewer are faster.
#ifndef LANES
#define LANES 256
#endif
const uint kLanes = uint(LANES);
