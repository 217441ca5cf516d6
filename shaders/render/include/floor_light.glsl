// How much light reaches the floor inside the patch round the scene: red of the key light, green of the sky.
uniform sampler2D floor_light;
uniform vec4 floor_patch;  // x, z of its corner [m]; 1 / its size [1/m]

vec2 floor_visibility(vec2 xz) {
    vec2 uv = (xz - floor_patch.xy) * floor_patch.zw;
    vec2 inside = smoothstep(vec2(0.5), vec2(0.40), abs(uv - 0.5));
    return mix(vec2(1.0), textureLod(floor_light, uv, 0.0).rg, inside.x * inside.y);
}
