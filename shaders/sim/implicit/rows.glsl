// The law of a contact (docs/contact.md), and friction.
// CPU twin: src/cpu/implicit/contact_row.h.
#include "layouts/contact_tuning.glsl"
#include "layouts/step_rows.glsl"

// A symmetric matrix [N/m].
struct RowStiffness {
    vec3 diagonal;  // xx, yy, zz
    vec3 beside;    // yz, zx, xy
};

vec3 times(RowStiffness k, vec3 v) { return k.diagonal * v + k.beside.zxy * v.yzx + k.beside.yzx * v.zxy; }

void add_outer_to(inout RowStiffness k, float factor, vec3 v) {
    k.diagonal += factor * v * v;
    k.beside += factor * v.yzx * v.zxy;
}

float gap_at(StepRow row, vec3 s) { return row.normal.w + dot(row.normal.xyz, s); }

// Minus the derivative of the law [N/m]. From the least gap inwards it is linear.
float slope_of(StepRow row, float g) {
    if (!(g < row.reach)) return 0.0;
    float part = max(g / row.reach, kLinearGap);
    return row.stiffness * (part < 0.5 ? 0.25 / (part * part) : 1.0);
}

// [N]
float force_of(StepRow row, float g) {
    if (!(g < row.reach)) return 0.0;
    float part = g / row.reach, inside = max(part, kLinearGap);
    float force = row.stiffness * row.reach * (inside < 0.5 ? 0.25 / inside : 1.0 - inside);
    return part < kLinearGap ? force + slope_of(row, g) * (kLinearGap - part) * row.reach : force;
}

// Contacts never pull.
float pressing(StepRow row, vec3 s) {
    float moved = dot(row.normal.xyz, s);
    return max(force_of(row, row.normal.w + moved) - row.damping * moved, 0.0);
}

// What friction would hold with if nothing slid [N].
vec3 stick(StepRow row, vec3 s) {
    return row.hold.xyz + row.stiffness * (s - dot(row.normal.xyz, s) * row.normal.xyz);
}

// Coulomb: friction holds with no more than the limit [N].
vec3 held_at(StepRow row, vec3 s, float limit) {
    vec3 q = stick(row, s);
    float size = length(q);
    return (size > limit ? limit / size * q : q);
}

// On the second side; the first has the reverse [N].
vec3 force_at(StepRow row, vec3 s, float limit) {
    vec3 along = pressing(row, s) * row.normal.xyz;
    return limit > 0.0 ? along - held_at(row, s, limit) : along;
}

// Of the tangent of the law. Along a slip friction does not change.
RowStiffness stiffness_at(StepRow row, vec3 s, float limit) {
    RowStiffness k = RowStiffness(vec3(0.0), vec3(0.0));
    vec3 n = row.normal.xyz;
    if (pressing(row, s) > 0.0) add_outer_to(k, slope_of(row, gap_at(row, s)) + row.damping, n);
    if (limit > 0.0) {
        vec3 q = stick(row, s);
        float size = length(q);
        bool slides = size > limit;
        float across = slides ? row.stiffness * limit / size : row.stiffness;
        k.diagonal += across;
        add_outer_to(k, -across, n);
        if (slides) add_outer_to(k, -across, q / size);
    }
    return k;
}

StepTangent tangent_of(vec3 constant, RowStiffness k) {
    return StepTangent(vec4(constant, 0.0), vec4(k.diagonal, 0.0), vec4(k.beside, 0.0));
}

StepTangent tangent_at(StepRow row, vec3 s, float limit) {
    RowStiffness k = stiffness_at(row, s, limit);
    return tangent_of(force_at(row, s, limit) + times(k, s), k);
}

// In place of the tangent, for a first step that closes gaps: from the gap at the start to the one expected, at s.
StepTangent chord_at(StepRow row, vec3 s, float limit) {
    StepTangent t = tangent_of(vec3(0.0), RowStiffness(vec3(0.0), vec3(0.0)));
    float gap = row.normal.w, there = gap_at(row, s);
    vec3 n = row.normal.xyz;
    if (min(gap, there) < row.reach) {
        float from = min(gap, row.reach), to = gap > 0.0 ? max(there, kChordGap * from) : there;
        float force = force_of(row, from), slope = row.stiffness;
        if (to < from * 0.999999)
            slope = (force_of(row, to) - force) / (from - to);
        else if (from < row.reach)
            slope = slope_of(row, from);
        RowStiffness k = RowStiffness(vec3(0.0), vec3(0.0));
        add_outer_to(k, slope + row.damping, n);
        t = tangent_of((force + slope * (from - gap)) * n, k);
    }
    if (limit > 0.0) {
        StepRow friction = row;  // that never presses
        friction.reach = 0.0;
        friction.damping = 0.0;
        friction.normal.w = 1.0;
        StepTangent f = tangent_at(friction, s, limit);
        t.constant += f.constant;
        t.diagonal += f.diagonal;
        t.beside += f.beside;
    }
    return t;
}

// What the law and friction hold, apart from dampers [J].
float energy_at(StepRow row, vec3 s, float limit) {
    float energy = 0.0, g = gap_at(row, s);
    if (g < row.reach) {
        float part = g / row.reach, inside = max(part, kLinearGap), beyond = (inside - part) * row.reach, depth = 1.0 - inside;
        energy = row.stiffness * row.reach * row.reach *
                 (inside < 0.5 ? 0.125 * (1.0 - 2.0 * log(2.0 * inside)) : 0.5 * depth * depth);
        energy += beyond * (force_of(row, inside * row.reach) + 0.5 * beyond * slope_of(row, inside * row.reach));
    }
    if (!(limit > 0.0)) return energy;
    vec3 q = held_at(row, s, limit);
    return energy + dot(q, q) / (2.0 * row.stiffness);
}

uvec4 nodes_of(StepRow row) { return uvec4(row.node_0, row.node_1, row.node_2, row.node_3); }

// s of a row, for a field of displacements.
vec3 relative(StepRow row, samplerBuffer field) {
    uvec4 nodes = nodes_of(row);
    vec3 s = vec3(0.0);
    for (int k = 0; k < 4; ++k) s += row.weights[k] * texelFetch(field, int(nodes[k])).xyz;
    return s;
}
