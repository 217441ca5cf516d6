// Clips a line in clip coordinates at the near plane, because points behind the eye have no position in pixels. True if nothing
// is left.
bool cut_by_near_plane(inout vec4 a, inout vec4 b) {
    float depth_a = a.z + a.w, depth_b = b.z + b.w;
    vec4 cut = mix(a, b, depth_a / (depth_a - depth_b));
    a = depth_a < 0.0 ? cut : a;
    b = depth_b < 0.0 ? cut : b;
    return depth_a <= 0.0 && depth_b <= 0.0;
}
