// Arguments of dispatches by the clock as it is. One work group.
// Parity: tests/gpu/implicit/tries_test.cpp.
#include "sim/implicit/tries.glsl"
layout(local_size_x = 64) in;

void main() { set_clock(clock[0]); }
