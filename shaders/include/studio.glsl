// The studio that surrounds the scene: a key light, a soft sky, what the floor gives back. Linear RGB.
const vec3 kKeyLight = vec3(2.10, 1.98, 1.80);
const vec3 kSkyLight = vec3(0.62, 0.68, 0.76);
const vec3 kFloorLight = vec3(0.50, 0.46, 0.42);  // from a lit floor, upwards
const vec3 kFloorAlbedo = vec3(0.56, 0.57, 0.585);
const vec3 kHorizon = vec3(1.36, 1.38, 1.40);
const vec3 kZenith = vec3(0.50, 0.62, 0.80);

uniform vec3 to_key_light;  // unit
