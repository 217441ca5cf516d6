// Puts the nodes of objects that have lost their shape where it was matched to, moving as a rigid body. Held nodes stay.
// CPU twin: gelatin::cpu::ShapeMatcher. Parity: tests/gpu/recovery/match_shapes_test.cpp.
#include "include/global_index.glsl"
#include "layouts/shape_match.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer rest_offsets;  // from the centre of mass [m], mass [kg]
uniform usamplerBuffer node_objects;
layout(std430) buffer Positions { vec4 positions[]; };    // xyz [m], inverse mass [1/kg]
layout(std430) buffer Velocities { vec4 velocities[]; };  // xyz [m/s], damping time [s]
layout(std430) readonly buffer Places { ShapePlace places[]; };
uniform uint node_count;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    ShapePlace place = places[texelFetch(node_objects, int(n)).x];
    if (place.center.w == 0.0 || positions[n].w == 0.0) return;
    vec3 r = mat3(place.rotation_x.xyz, place.rotation_y.xyz, place.rotation_z.xyz) * texelFetch(rest_offsets, int(n)).xyz;
    positions[n].xyz = place.center.xyz + r;
    velocities[n].xyz = place.velocity.xyz + cross(place.spin.xyz, r);
}
