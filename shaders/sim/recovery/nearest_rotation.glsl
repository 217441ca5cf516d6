// The rotation that fits nodes at X that have come to x best. CPU twin: src/model/nearest_rotation.h.
// Source: Horn 1987, Closed-form Solution of Absolute Orientation Using Unit Quaternions.

// @param moment the sum of x X^T
mat3 nearest_rotation(mat3 moment) {
    const int kSquarings = 20;
    vec3 a = moment[0], b = moment[1], c = moment[2];  // x X_x, x X_y, x X_z
    vec3 rotated = vec3(b.z - c.y, c.x - a.z, a.y - b.x);
    mat4 m = mat4(a.x + b.y + c.z, rotated.x, rotated.y, rotated.z,
                  rotated.x, a.x - b.y - c.z, a.y + b.x, c.x + a.z,
                  rotated.y, a.y + b.x, b.y - a.x - c.z, b.z + c.y,
                  rotated.z, c.x + a.z, b.z + c.y, c.z - a.x - b.y);
    vec4 sums = abs(m[0]) + abs(m[1]) + abs(m[2]) + abs(m[3]);
    float size = sums.x + sums.y + sums.z + sums.w;
    m = mat4(1.0) + m * (size > 0.0 ? 1.0 / size : 0.0);  // none of its eigenvalues is negative
    for (int k = 0; k < kSquarings; ++k) {
        m = m * m;
        m /= m[0][0] + m[1][1] + m[2][2] + m[3][3];
    }
    vec4 q = m[0];
    float longest = m[0][0];
    for (int k = 1; k < 4; ++k) {
        if (m[k][k] <= longest) continue;
        longest = m[k][k];
        q = m[k];
    }
    q = normalize(q);
    vec3 v = q.yzw;
    mat3 cross_ = mat3(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0);
    return mat3(1.0) + 2.0 * (q.x * cross_ + cross_ * cross_);
}
