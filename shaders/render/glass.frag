// Transparent bodies: their outlines and their inside are visible.
uniform vec3 eye;  // [m]

in vec3 position;
in vec3 normal;
flat in vec3 albedo;
layout(location = 0) out vec4 pixel;

const vec3 kTint = vec3(0.16, 0.19, 0.25);  // sRGB values

void main() {
    float facing = abs(dot(normalize(normal), normalize(eye - position)));
    pixel = vec4(kTint, mix(0.75, 0.45, facing));
}
