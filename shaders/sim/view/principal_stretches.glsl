// The principal stretches of a deformation gradient: its singular values, descending, of which the last has the sign
// of the determinant. Jacobi's method on F^T F (Golub and Van Loan, Matrix Computations, 8.5) for the first two; the
// third by the determinant, which keeps it exact where it is small.

// Rotates the first two axes so that the symmetric matrix with this diagonal, and these elements opposite to it, has no element
// between them; then permutes the axes, so that after three calls their order is the original one.
void turn_axes(inout vec3 diagonal, inout vec3 opposite) {
    float difference = diagonal.y - diagonal.x, twice = 2.0 * opposite.z;
    float size = abs(difference) + sqrt(difference * difference + twice * twice);
    float tangent = size > 0.0 ? (difference < 0.0 ? -twice : twice) / size : 0.0;
    float cosine = inversesqrt(tangent * tangent + 1.0), sine = tangent * cosine;
    vec2 change = 0.5 * tangent * vec2(-twice, twice);
    vec2 turned = vec2(sine * opposite.y + cosine * opposite.x, cosine * opposite.y - sine * opposite.x);
    diagonal = vec3(diagonal.y + change.y, diagonal.z, diagonal.x + change.x);
    opposite = vec3(turned.y, 0.0, turned.x);
}

vec3 principal_stretches(mat3 f) {
    const int kSweeps = 4;
    float size = max(max(length(f[0]), length(f[1])), length(f[2]));
    mat3 scaled = f / max(size, 1e-30);
    vec3 diagonal = vec3(dot(scaled[0], scaled[0]), dot(scaled[1], scaled[1]), dot(scaled[2], scaled[2]));
    vec3 opposite = vec3(dot(scaled[1], scaled[2]), dot(scaled[2], scaled[0]), dot(scaled[0], scaled[1]));
    for (int k = 0; k < 3 * kSweeps; ++k) turn_axes(diagonal, opposite);
    float most = max(max(diagonal.x, diagonal.y), diagonal.z);
    float least = min(min(diagonal.x, diagonal.y), diagonal.z);
    float first = sqrt(max(most, 0.0));
    float second = sqrt(max(diagonal.x + diagonal.y + diagonal.z - most - least, 0.0));
    float volume = dot(scaled[0], cross(scaled[1], scaled[2]));
    // If the second is only rounding, so is the volume.
    float third = clamp(volume / max(first * second, 1e-30), -second, second);
    return size * vec3(first, second, third);
}
