// The studio around the scene: a key light, a soft sky, reflection from the floor. Linear RGB; light is that of a white surface
// that faces it.
const vec3 kKeyLight = vec3(1.20, 1.13, 1.03);
const vec3 kSkyLight = vec3(0.37, 0.405, 0.455);
const vec3 kFloorLight = vec3(0.33, 0.305, 0.28);  // from a lit floor, upwards
const vec3 kFloorAlbedo = vec3(0.56, 0.57, 0.585);
const vec3 kHorizon = vec3(0.755, 0.765, 0.775);
const vec3 kZenith = vec3(0.39, 0.465, 0.575);

uniform vec3 to_key_light;  // unit
