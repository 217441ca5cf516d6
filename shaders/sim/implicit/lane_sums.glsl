// Sums over the nodes of a chunk by its work group of 64, and over the chunks of a body by each group that needs them, in doubles and
// in a fixed order. kSums: how many.
#include "layouts/end_sums.glsl"

shared double lane_sums[64u * kSums];

void put_sum(uint k, double own) { lane_sums[gl_LocalInvocationID.x * kSums + k] = own; }
void put_sums(uint k, dvec3 own) {
    put_sum(k, own.x);
    put_sum(k + 1u, own.y);
    put_sum(k + 2u, own.z);
}

// After a barrier: all that the lanes have put.
double sum_of_lanes(uint k) {
    double sum = 0.0LF;
    for (uint l = 0u; l < 64u; ++l) sum += lane_sums[l * kSums + k];
    return sum;
}
double most_of_lanes(uint k) {
    double most = 0.0LF;
    for (uint l = 0u; l < 64u; ++l) most = max(most, lane_sums[l * kSums + k]);
    return most;
}

// Of a node with mass m at r from the centre.
void put_motion(double motion[kMotionSums]) {
    for (uint k = 0u; k < kMotionSums; ++k) put_sum(k, motion[k]);
}
void add_to(inout double motion[kMotionSums], uint k, dvec3 value) {
    motion[k] += value.x;
    motion[k + 1u] += value.y;
    motion[k + 2u] += value.z;
}
void add_node(double m, dvec3 r, dvec3 v, inout double motion[kMotionSums]) {
    motion[kMass] += m;
    add_to(motion, kArm, m * r);
    add_to(motion, kSquare, m * r * r);
    add_to(motion, kBeside, m * r.yzx * r.zxy);
    add_to(motion, kMomentum, m * v);
    add_to(motion, kAngular, m * cross(r, v));
}
