// The studio that surrounds the scene: a key light, a soft sky, what the floor gives back. Linear RGB.
const vec3 kKeyLight = vec3(2.25, 2.12, 1.95);
const vec3 kSkyLight = vec3(0.60, 0.68, 0.80);
const vec3 kFloorLight = vec3(0.46, 0.43, 0.40);  // from a lit floor, upwards
const vec3 kFloorAlbedo = vec3(0.50, 0.51, 0.53);
const vec3 kHorizon = vec3(1.02, 1.06, 1.12);
const vec3 kZenith = vec3(0.42, 0.53, 0.70);

uniform vec3 to_key_light;  // unit
