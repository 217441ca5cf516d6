// Vertex block descent (Chen et al. 2024): each node of one colour makes a Newton step on its own part of the objective.
// One invocation a row; rows are nodes by colour, in slices of 64 as advance_nodes has them. Neighbours have other
// colours, so that what is gathered is not written here.
// With FORCES nodes stay, and the force on each is written: rows of all colours at once.
// CPU twin: gelatin::cpu::NodeSweep. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/collision/colliders.glsl"
#include "sim/descent/descent_step.glsl"
#include "sim/elasticity/node_terms.glsl"
#include "sim/elasticity/strip.glsl"
#include "layouts/descent.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;      // xyz [m], inverse mass [1/kg]
uniform usamplerBuffer rows;          // DescentRow
uniform usamplerBuffer spring_ends;   // of two half springs, the nodes at their other ends
uniform samplerBuffer springs;        // their rest length [m], stiffness [N/m], dampers in them
uniform usamplerBuffer slice_starts;
uniform usamplerBuffer near_flat;    // of nodes, the number of the marking that they were marked in
uniform usamplerBuffer tet_corners;   // TetCorner, of bodies of springs
uniform usamplerBuffer corner_starts;
uniform samplerBuffer tet_rests;     // volume [m^3], modulus [Pa]
#ifdef VOLUME
uniform usamplerBuffer volume_strips;  // VolumeStep, of bodies of springs, in slices of rows; kNone pads
uniform usamplerBuffer volume_starts;  // of the slices
uniform samplerBuffer offsets;         // of each tet's bound [J]
#endif
layout(std430) writeonly buffer OutPositions { vec4 out_positions[]; };
#ifdef FORCES
layout(std430) readonly buffer Displacements { vec4 displacements[]; };       // [m]
layout(std430) writeonly buffer Forces { vec4 forces[]; };  // [N]
uniform uint is_ahead;  // positions are those after the displacements
#endif
layout(std430) buffer ObjectContacts { uint object_contacts[]; };
#ifdef NEO_HOOKEAN
#include "sim/elasticity/neo_hookean_terms.glsl"
#endif
uniform uint first_row;
uniform uint row_count;
uniform uint mark;         // number of the last marking

vec3 position_of(uint node) { return texelFetch(positions, int(node)).xyz; }

#ifdef VOLUME
// The volume term's part of the node of a row.
void add_tet_volumes(uint row, vec3 position, inout NodeTerms terms) {
    Strip strip = kNoStrip;
    uint end = texelFetch(volume_starts, int(row / kSlice) + 1).x;
    for (uint e = texelFetch(volume_starts, int(row / kSlice)).x + row % kSlice; e < end; e += kSlice) {
        uvec4 texel = texelFetch(volume_strips, int(e));
        if (texel.x == kNone) break;
        step_strip(texel.x, position_of(uint(node_of(texel.x))) - position, strip);
        if (texel.y == kNone) continue;
        vec2 rest = uintBitsToFloat(texel.zw);
        vec3 slope = rest.x * cross(strip.b - strip.a, strip.c - strip.a);
        add_tet_volume(slope, -dot(strip.a, slope), vec2(texelFetch(offsets, int(texel.y)).x, rest.y), terms);
    }
}
#endif

#if COLLIDER_KINDS != 0
layout(std430) buffer Contacts { ColliderContact contacts[]; };  // of nodes

vec2 times(vec3 m, vec2 v) { return vec2(m.x * v.x + m.y * v.y, m.y * v.x + m.z * v.y); }

vec3 inverse_of(vec3 m) { return vec3(m.z, -m.y, m.x) / (m.x * m.z - m.y * m.y); }

// (I + y * stiffness)^-1
vec3 yields(vec3 stiffness, float y) { return inverse_of(vec3(1.0, 0.0, 1.0) + y * stiffness); }

struct Slip {
    vec2 way;        // since the step began, along the plane [m]
    vec3 stiffness;  // within the plane: xx, xy, yy [N/m]
    float pressing;  // after that way [N]
    vec2 coupling;   // how much more it presses, by a way along the plane [N/m]
};
struct Friction {
    vec2 force;      // against the slip [N]
    vec2 back;       // where the node goes [m]
    float pressing;  // there [N]
    float yielding;  // what is left of the slip, by the force [m/N]
};

// Coulomb's, of at most c times what presses; see push_outside.h.
Friction friction_on(Slip slip, float c) {
    const int kRounds = 6;
    const float kEnough = 1e-5;
    vec2 holding = times(slip.stiffness, slip.way);
    vec2 relieving = times(inverse_of(slip.stiffness), slip.coupling);
    float length_ = length(holding), most = 0.0, least = 1e-6 * length_, way = length(slip.way);
    Friction found = Friction(holding, vec2(0.0), 0.0, 0.0);
    for (int round_ = 0;; ++round_) {
        float pressing = slip.pressing - dot(relieving, found.force);
        found.pressing = max(0.0, pressing);
        most = max(c * found.pressing, least);
        bool holds = found.yielding == 0.0 && length_ <= most;
        if (holds || abs(length_ - most) <= kEnough * most || round_ == kRounds) break;
        float bound = pressing > 0.0 ? most : c * pressing;
        vec2 falls = times(yields(slip.stiffness, found.yielding), times(slip.stiffness, found.force));
        float slope = bound * dot(found.force, falls) / (length_ * length_) + c * dot(relieving, falls);
        float yielding = slope > 0.0 ? found.yielding + (length_ - bound) / slope
                                     : 2.0 * found.yielding + way / (c * slip.pressing);
        found.yielding = clamp(yielding, 0.0, way / least);
        found.force = times(yields(slip.stiffness, found.yielding), holding);
        length_ = length(found.force);
    }
    if (length_ > most) found.force *= most / length_;
    found.back = found.yielding * found.force - slip.way;
    return found;
}

// Where the node's own objective, to second order, is least outside the collider's tangent plane, behind which all of it
// lies: the normal force is what that takes. Friction then takes back what the node has slid along the plane, with as much
// force as Coulomb's law allows.
void push_out(uint c, vec4 surface, vec3 start, NodeTerms terms, inout vec3 position, inout ColliderContact contact) {
    if (surface.w >= 0.0) return;
    vec3 n = surface.xyz;
    vec3 yielding = solve(terms, n);  // to a force along n
    float compliance = dot(n, yielding);
    if (!(compliance > 0.0)) {  // lost in rounding
        position -= surface.w * n;
        return;
    }
    float stiffness = 1.0 / compliance;
    float pressing = -surface.w * stiffness;
    position += pressing * yielding;
    contact.force.w = stiffness;
    contact.normal = vec4(n, 0.0);
    float coefficient = texelFetch(colliders, int(4u * c + 3u)).y;
    if (!(coefficient > 0.0)) {
        contact.force.xyz += pressing * n;
        return;
    }
    vec3 u = normalize(cross(n, abs(n.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
    vec3 v = cross(n, u), of_u = stiffness_times(terms, u), of_v = stiffness_times(terms, v);
    vec3 displacement = position - start;
    Slip slip = Slip(vec2(dot(u, displacement), dot(v, displacement)), vec3(dot(u, of_u), dot(u, of_v), dot(v, of_v)),
                     pressing, vec2(dot(n, of_u), dot(n, of_v)));
    Friction friction = friction_on(slip, coefficient);
    position += friction.back.x * u + friction.back.y * v;
    contact.force.xyz += friction.pressing * n - friction.force.x * u - friction.force.y * v;
    // It falls to nothing where all slip is taken back.
    contact.normal.w = friction.yielding * stiffness > 1.0 ? 1.0 / friction.yielding : stiffness;
}

// @param ends of the colliders of each kind, all zero for nodes that are outside: software drivers run all code that is not in
// a loop, but skip loops that no node of a group enters
ColliderContact push_outside_colliders(uvec4 ends, vec3 start, NodeTerms terms, inout vec3 position) {
    ColliderContact contact = ColliderContact(vec4(0.0), vec4(0.0));
    uint c = 0u;
#if (COLLIDER_KINDS & 1) != 0
    for (; c < ends.x; ++c) push_out(c, distance_to_plane(c, position), start, terms, position, contact);
#endif
#if (COLLIDER_KINDS & 2) != 0
    for (; c < ends.y; ++c) push_out(c, distance_to_rotated_box(c, position), start, terms, position, contact);
#endif
#if (COLLIDER_KINDS & 4) != 0
    for (; c < ends.z; ++c) push_out(c, distance_to_sphere(c, position), start, terms, position, contact);
#endif
#if (COLLIDER_KINDS & 8) != 0
    for (; c < ends.w; ++c) push_out(c, distance_to_capsule(c, position), start, terms, position, contact);
#endif
    return contact;
}
#endif

void main() {
    uint index = global_index();
    if (index >= row_count) return;
    uint row = first_row + index;
    uvec4 entry = texelFetch(rows, int(row));
    uint n = entry.x;
    if (n == 0xFFFFFFFFu) return;
    vec4 position = texelFetch(positions, int(n));
    if (position.w == 0.0) {
#ifdef FORCES
        forces[n] = vec4(0.0);
#endif
        return;
    }
    vec4 target = texelFetch(targets, int(n));
    NodeTerms terms = NodeTerms(target.w * (target.xyz - position.xyz), vec3(target.w), vec3(0.0));
    int slice = int(row / 64u);
    uint first = texelFetch(slice_starts, slice).x + row % 64u, end = first + 64u * entry.z;
    for (uint p = first; p < end; p += 64u) {
        uvec2 ends = texelFetch(spring_ends, int(p)).xy;
        vec4 two = texelFetch(springs, int(p));
        add_spring(position_of(ends.x) - position.xyz, two.x, two.y, terms);
        add_spring(position_of(ends.y) - position.xyz, two.z, two.w, terms);
    }
    bool resists = texelFetch(near_flat, int(n)).x == mark;
    uint first_corner = texelFetch(corner_starts, slice).x + row % 64u;
    uint corners_end = texelFetch(corner_starts, slice + 1).x;
    for (uint k = first_corner; k < (resists ? corners_end : first_corner); k += 64u) {
        uvec4 corner = texelFetch(tet_corners, int(k));
        if (corner.w == 0xFFFFFFFFu) break;
        vec2 rest = texelFetch(tet_rests, int(corner.w)).xy;
        vec3 a = position_of(corner.x);
        vec3 slope = cross(position_of(corner.y) - a, position_of(corner.z) - a) / (6.0 * rest.x);
        add_flat_tet(slope, dot(position.xyz - a, slope), rest.x * rest.y, terms);
    }
#ifdef VOLUME
    add_tet_volumes(row, position.xyz, terms);
#endif
#ifdef NEO_HOOKEAN
    add_neo_hookean_tets(row, n, position.xyz, terms);
#endif
#ifdef FORCES
    vec3 force = terms.force;
#if COLLIDER_KINDS != 0
    if (object_contacts[entry.y] != 0u) {
        ColliderContact contact = contacts[n];
        vec3 displacement = is_ahead != 0u ? displacements[n].xyz : vec3(0.0);
        float across = contact.normal.w, along = contact.force.w;
        force += contact.force.xyz - across * displacement - (along - across) * dot(contact.normal.xyz, displacement) * contact.normal.xyz;
    }
#endif
    forces[n] = vec4(force, 0.0);
#else
    vec3 moved = position.xyz + solve(terms, terms.force);
#if COLLIDER_KINDS != 0
    bool is_inside = distance_to_colliders(moved) < 0.0;
    ColliderContact contact = push_outside_colliders(is_inside ? collider_ends : uvec4(0u), texelFetch(start_positions, int(n)).xyz,
                                         terms, moved);
    // A body that has touched nothing in this step has no contacts to clear.
    if (is_inside || object_contacts[entry.y] != 0u) contacts[n] = contact;
    if (contact.force.w != 0.0) object_contacts[entry.y] = 1u;
#endif
    out_positions[n] = vec4(moved, position.w);
#endif
}
