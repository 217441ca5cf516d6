// The floor: a square around the scene, far larger than it.
uniform mat4 world_to_clip;
uniform vec3 floor_center;  // [m]
uniform float floor_radius; // [m]

out vec2 xz;

void main() {
    vec2 corner = vec2(gl_VertexID >> 1, gl_VertexID & 1) * 2.0 - 1.0;
    xz = floor_center.xz + corner * floor_radius;
    gl_Position = world_to_clip * vec4(xz.x, floor_center.y, xz.y, 1.0);
}
