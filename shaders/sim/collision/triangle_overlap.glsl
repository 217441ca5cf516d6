// Do two closed triangles have a point in common? CPU twin, which explains the method: src/cpu/collision/triangle_overlap.h.
// Both give the same answer for every input. Parity: tests/gpu/collision/triangle_overlap_test.cpp.
//
// Signs are bits of a uvec2, x for positive, y for negative: bit i is the side of t's plane that vertex i of s is on,
// 3 + j the side of s's plane for vertex j of t, 6 + 3 i + j the orientation of edge i of s about edge j of t.
// Software drivers run every branch, and every loop once: what is rarely needed is one iteration of a loop.

#include "sim/collision/rounding.glsl"

const uint kVerticesOfS = 7u, kVerticesOfT = 56u, kAllSigns = 32767u;
const uint kEdgeOfS = 448u, kEdgeOfT = 4672u;  // orientations of the first ones

// Relative rounding bounds: 2^-20, 2^-49. In float 2^-99 pays for products that are flushed to zero; in double there
// are none, as differences of floats are at least 2^-149.
const float kFloatBound = float(kOverlapRounding) * kEpsilon;
const double kDoubleBound = 1.7763568394002505e-15lf;

// The sign of w . (u x v).
uvec2 determinant_sign(vec3 u, vec3 v, vec3 w) {
    precise vec3 plus = u.yzx * v.zxy, minus = u.zxy * v.yzx;
    precise vec3 a = w * (plus - minus), b = abs(w) * (abs(plus) + abs(minus) + kUnderflowBound);
    precise float value = (a.x + a.y) + a.z, bound = ((b.x + b.y) + b.z + kUnderflowBound) * kFloatBound;
    return uvec2(value > bound, value < -bound);
}

uvec2 determinant_sign(dvec3 u, dvec3 v, dvec3 w) {
    precise dvec3 plus = u.yzx * v.zxy, minus = u.zxy * v.yzx;
    precise dvec3 a = w * (plus - minus), b = abs(w) * (abs(plus) + abs(minus));
    precise double value = (a.x + a.y) + a.z, bound = ((b.x + b.y) + b.z) * kDoubleBound;
    return uvec2(value > bound, value < -bound);
}

// p[i] for a variable i: an array with a variable index would be moved to memory.
vec3 corner(vec3 p[6], uint i) {
    return i < 3u ? (i == 0u ? p[0] : i == 1u ? p[1] : p[2]) : (i == 3u ? p[3] : i == 4u ? p[4] : p[5]);
}

uvec2 sign_in_double(uint bit, vec3 p[6]) {
    uint i = (bit - 6u) / 3u, j = (bit - 6u) % 3u;
    uint base = bit < 3u ? 3u : 0u;  // of the plane
    uvec4 ends = bit < 6u ? uvec4(base, base + 1u, base, base + 2u)
                          : uvec4(i, (i + 1u) % 3u, 3u + j, 3u + (j + 1u) % 3u);
    dvec3 a = dvec3(corner(p, ends.x)), b = dvec3(corner(p, ends.y));
    dvec3 c = dvec3(corner(p, ends.z)), d = dvec3(corner(p, ends.w));
    dvec3 across = bit < 6u ? dvec3(corner(p, bit)) : c;
    return determinant_sign(b - a, d - c, across - a);
}

bool all_alike(uvec2 signs, uint bits) { return any(equal(signs & bits, uvec2(bits))); }
bool mixed(uvec2 signs, uint bits) { return all(notEqual(signs & bits, uvec2(0u))); }
uint zero_signs(uvec2 signs) { return kAllSigns & ~(signs.x | signs.y); }

// The sides of line ab on which p is, in the projections along the axes.
ivec3 sides_of_line(dvec3 a, dvec3 b, dvec3 p) {
    dvec3 u = b - a, v = p - a;
    precise dvec3 plus = u.yzx * v.zxy, minus = u.zxy * v.yzx;
    precise dvec3 value = plus - minus, bound = (abs(plus) + abs(minus)) * kDoubleBound;
    return ivec3(greaterThan(value, bound)) - ivec3(lessThan(value, -bound));
}

// True if in a projection p, q and r are on one side of line ab and c is not on that side.
bool line_separates(vec3 a, vec3 b, vec3 c, vec3 p, vec3 q, vec3 r) {
    ivec3 outer = sides_of_line(a, b, p) + sides_of_line(a, b, q) + sides_of_line(a, b, r);
    ivec3 own = sides_of_line(a, b, c);
    return any(greaterThan(outer * (outer - own), ivec3(6)));  // 9 or 12 if outer is 3 or -3 and own is not alike
}

bool misses_in_projection(vec3 p, vec3 q, vec3 a, vec3 b, vec3 c) {
    bool misses = any(lessThan(max(p, q), min(min(a, b), c))) || any(lessThan(max(max(a, b), c), min(p, q)));
    bool own_line = true;  // pq first, then ab, bc, ca
    for (int line = 0; line < 4 && !misses; ++line) {
        misses = line_separates(own_line ? p : a, own_line ? q : b, own_line ? p : c, own_line ? a : p,
                                own_line ? b : q, own_line ? c : q);
        if (!own_line) {
            vec3 first = a;
            a = b;
            b = c;
            c = first;
        }
        own_line = false;
    }
    return misses;
}

bool comes_before(vec3 a, vec3 b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

void sort(inout vec3 a, inout vec3 b) {
    bool swap = comes_before(b, a);
    vec3 first = swap ? b : a;
    b = swap ? a : b;
    a = first;
}

// By the bits, since compilers may assume that there is no NaN.
bool is_finite(vec3 a, vec3 b, vec3 c) {
    const uvec3 exponent = uvec3(0x7f800000u);
    return all(notEqual(floatBitsToUint(a) & exponent, exponent)) &&
           all(notEqual(floatBitsToUint(b) & exponent, exponent)) &&
           all(notEqual(floatBitsToUint(c) & exponent, exponent));
}

bool triangles_overlap(vec3 s0, vec3 s1, vec3 s2, vec3 t0, vec3 t1, vec3 t2) {
    if (!is_finite(s0, s1, s2) || !is_finite(t0, t1, t2)) return false;
    sort(s0, s1);
    sort(s1, s2);
    sort(s0, s1);
    sort(t0, t1);
    sort(t1, t2);
    sort(t0, t1);
    vec3 p[6] = vec3[6](s0, s1, s2, t0, t1, t2);

    uvec2 signs = uvec2(0u);
    for (int i = 0; i < 3; ++i) signs |= determinant_sign(t1 - t0, t2 - t0, p[i] - t0) << i;
    if (all_alike(signs, kVerticesOfS)) return false;
    for (int j = 0; j < 3; ++j) signs |= determinant_sign(s1 - s0, s2 - s0, p[3 + j] - s0) << (3 + j);
    if (all_alike(signs, kVerticesOfT)) return false;
    for (int i = 0; i < 3; ++i) {
        vec3 along_s = p[(i + 1) % 3] - p[i];
        for (int j = 0; j < 3; ++j) {
            signs |= determinant_sign(along_s, p[3 + (j + 1) % 3] - p[3 + j], p[3 + j] - p[i]) << (6 + 3 * i + j);
        }
    }
    for (uint rest = zero_signs(signs); rest != 0u; rest &= rest - 1u) {
        int bit = findLSB(rest);
        signs |= sign_in_double(uint(bit), p) << bit;
    }

    uint open_edges = 0u;  // those of s, then those of t, that neither miss nor certainly meet
    for (int i = 0; i < 3; ++i) {
        uint ends = 1u << i | 1u << (i + 1) % 3, orientations = kEdgeOfS << 3 * i;
        if (!all_alike(signs, ends) && !mixed(signs, orientations)) {
            if ((zero_signs(signs) & (ends | orientations)) == 0u) return true;
            open_edges |= 1u << i;
        }
        ends <<= 3;
        orientations = kEdgeOfT << i;
        if (!all_alike(signs, ends) && !mixed(signs, orientations)) {
            if ((zero_signs(signs) & (ends | orientations)) == 0u) return true;
            open_edges |= 8u << i;
        }
    }
    for (; open_edges != 0u; open_edges &= open_edges - 1u) {
        uint edge = uint(findLSB(open_edges));
        bool of_s = edge < 3u;
        vec3 a = of_s ? t0 : s0, b = of_s ? t1 : s1, c = of_s ? t2 : s2;
        uint next = edge == 2u ? 0u : edge == 5u ? 3u : edge + 1u;
        if (!misses_in_projection(corner(p, edge), corner(p, next), a, b, c)) return true;
    }
    return false;
}
