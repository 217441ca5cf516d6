// The paper's response (2.4): nodes of colliding faces that approach the other object go back to their previous
// positions, along the normal and as seen from the contact, and their velocities respond. A node that touches several
// objects answers each by its share of colliding faces. CPU twin: gelatin::cpu::respond. Parity: tests/gpu/collision/respond_test.cpp.
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "sim/collision/node_faces.glsl"
#include "layouts/contact.glsl"
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer previous_positions;  // xyz [m], inverse mass [1/kg]
uniform usamplerBuffer faces;              // Face
uniform usamplerBuffer node_shares;
layout(std430) readonly buffer Responses { ContactResponse responses[]; };
layout(std430) buffer Positions { vec4 positions[]; };    // an invocation reads and writes its own node
layout(std430) buffer Velocities { vec4 velocities[]; };  // alone
uniform float time_step;  // [s]

void main() {
    uint n = global_index();
    if (n >= dispatches[kNodes].count) return;
    uint shares = texelFetch(node_shares, int(n)).x;
    vec4 previous = texelFetch(previous_positions, int(n));
    if (shares == 0u || previous.w == 0.0) return;
    uint first = texelFetch(node_face_starts, int(n)).x;
    PairRow row = pair_rows[texelFetch(faces, int(texelFetch(node_faces, int(first)).x)).w];

    vec4 position = positions[n];
    vec4 velocity = velocities[n];
    vec3 change = vec3(0.0);
    vec3 way_back = vec3(0.0);
    for (uint p = row.first_pair; p < row.first_pair + row.pair_count; ++p) {
        uint count = count_colliding(n, object_pairs[p]);
        ContactResponse response = responses[p];
        vec3 normal = response.normal.xyz;
        float approach = dot(velocity.xyz - response.velocity.xyz, normal);
        if (count == 0u || approach <= 0.0) continue;
        float share = float(count) / float(shares);
        change += share * (response.slowing.xyz - response.normal.w * approach * normal);
        float advance = dot(position.xyz - previous.xyz - time_step * response.velocity.xyz, normal);
        way_back += share * max(advance, 0.0) * normal;
    }
    positions[n] = vec4(position.xyz - way_back, position.w);
    velocities[n] = vec4(velocity.xyz + change, velocity.w);
}
