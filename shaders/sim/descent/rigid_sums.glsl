// Sums over a body's nodes, at r from its origin, for Newton's step along rigid motions. In double: what colliders hold
// outweighs inertia by any factor. CPU twin: gelatin::cpu::RigidStep.
struct RigidSums {      // 512 bytes
    dvec4 arm;          // k r; w: k, with k the stiffness that resists alike in all directions
    dvec4 square;       // k r_x r_x, k r_y r_y, k r_z r_z; w: nodes that are held
    dvec4 product;      // k r_y r_z, k r_z r_x, k r_x r_y
    dvec4 force;        // f
    dvec4 moment;       // r x f
    dvec4 translations;       // of surfaces, along n, with t = r x n: k n_x n_x, k n_y n_y, k n_z n_z; w: what they press with
    dvec4 translation_pairs;  // k n_y n_z, k n_z n_x, k n_x n_y; w: k n_x, by which that falls
    dvec4 rotations;        // k t_x t_x, ...; w: k n_y
    dvec4 rotation_pairs;   // k t_y t_z, ...; w: k n_z
    dvec4 mixed_x;      // k t_x n; w: k t_x
    dvec4 mixed_y;
    dvec4 mixed_z;
    // Friction of nodes that slide, k being how it falls:
    dvec4 sliding_arm;      // k r; w: k
    dvec4 sliding_square;   // as square; w: f_x
    dvec4 sliding_product;  // as product; w: f_y
    dvec4 sliding_moment;   // r x f; w: f_z
};

const dvec4 kZero = dvec4(0.0);
const RigidSums kNothing = RigidSums(kZero, kZero, kZero, kZero, kZero, kZero, kZero, kZero, kZero, kZero, kZero, kZero,
                                     kZero, kZero, kZero, kZero);

RigidSums add(RigidSums a, RigidSums b) {
    return RigidSums(a.arm + b.arm, a.square + b.square, a.product + b.product, a.force + b.force, a.moment + b.moment,
                     a.translations + b.translations, a.translation_pairs + b.translation_pairs, a.rotations + b.rotations,
                     a.rotation_pairs + b.rotation_pairs, a.mixed_x + b.mixed_x, a.mixed_y + b.mixed_y, a.mixed_z + b.mixed_z,
                     a.sliding_arm + b.sliding_arm, a.sliding_square + b.sliding_square,
                     a.sliding_product + b.sliding_product, a.sliding_moment + b.sliding_moment);
}

void add_node(dvec3 r, double stiffness, dvec3 force, inout RigidSums sums) {
    sums.arm += dvec4(stiffness * r, stiffness);
    sums.square.xyz += stiffness * r * r;
    sums.product.xyz += stiffness * r.yzx * r.zxy;
    sums.force.xyz += force;
    sums.moment.xyz += cross(r, force);
}

void add_along(dvec3 r, dvec3 normal, double stiffness, inout RigidSums sums) {
    dvec3 rotated = cross(r, normal);
    sums.translations.xyz += stiffness * normal * normal;
    sums.translation_pairs.xyz += stiffness * normal.yzx * normal.zxy;
    sums.rotations.xyz += stiffness * rotated * rotated;
    sums.rotation_pairs.xyz += stiffness * rotated.yzx * rotated.zxy;
    sums.mixed_x.xyz += stiffness * rotated.x * normal;
    sums.mixed_y.xyz += stiffness * rotated.y * normal;
    sums.mixed_z.xyz += stiffness * rotated.z * normal;
}

// A surface that presses a node with a force along its normal, which falls by `along` as the node comes away, and holds
// it back with friction, which falls by `across` as the node slides back; alike where it does not let the node slide.
// What slides is resisted along the normal by a little more than that, which spares sums.
void add_contact(dvec3 r, dvec3 normal, double pressing, dvec3 friction, double along, double across,
               inout RigidSums sums) {
    bool slides = across < along;
    add_node(r, slides ? 0.0 : across, pressing * normal + (slides ? dvec3(0.0) : friction), sums);
    add_along(r, normal, slides ? along : along - across, sums);
    dvec3 fall = along * normal, fall_by_rotation = along * cross(r, normal);
    sums.translations.w += pressing;
    sums.translation_pairs.w += fall.x;
    sums.rotations.w += fall.y;
    sums.rotation_pairs.w += fall.z;
    sums.mixed_x.w += fall_by_rotation.x;
    sums.mixed_y.w += fall_by_rotation.y;
    sums.mixed_z.w += fall_by_rotation.z;
    if (!slides) return;
    sums.sliding_arm += dvec4(across * r, across);
    sums.sliding_square += dvec4(across * r * r, friction.x);
    sums.sliding_product += dvec4(across * r.yzx * r.zxy, friction.y);
    sums.sliding_moment += dvec4(cross(r, friction), friction.z);
}

void add_sliding(double factor, inout RigidSums sums) {
    sums.arm += factor * sums.sliding_arm;
    sums.square.xyz += factor * sums.sliding_square.xyz;
    sums.product.xyz += factor * sums.sliding_product.xyz;
    sums.force.xyz += factor * dvec3(sums.sliding_square.w, sums.sliding_product.w, sums.sliding_moment.w);
    sums.moment.xyz += factor * sums.sliding_moment.xyz;
}

dmat3 symmetric(dvec3 diagonal, dvec3 pairs) {
    return dmat3(diagonal.x, pairs.z, pairs.y, pairs.z, diagonal.y, pairs.x, pairs.y, pairs.x, diagonal.z);
}

dmat3 cross_matrix(dvec3 v) { return dmat3(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0); }

double inverse_or_zero(double pivot, double diagonal) {
    double d = max(pivot, 1.7763568394002505e-15lf * diagonal);  // 8 epsilon
    return d > 0.0 ? 1.0 / d : 0.0;
}

// m^-1 f by the square-root-free Cholesky decomposition; zero along what has no stiffness.
dvec3 solve(dmat3 m, dvec3 f) {
    double i0 = inverse_or_zero(m[0][0], m[0][0]);
    double l10 = m[0][1] * i0, l20 = m[0][2] * i0;
    double i1 = inverse_or_zero(m[1][1] - l10 * m[0][1], m[1][1]);
    double rest = m[1][2] - l20 * m[0][1], l21 = rest * i1;
    double i2 = inverse_or_zero(m[2][2] - l20 * m[0][2] - l21 * rest, m[2][2]);
    double y1 = f.y - l10 * f.x, y2 = f.z - l20 * f.x - l21 * y1;
    double z = y2 * i2, y = y1 * i1 - l21 * z;
    return dvec3(f.x * i0 - l10 * y - l20 * z, y, z);
}

// [A B; B^T C] (translation, rotation) = (force, moment) by elimination of the translation.
void find_displacement(RigidSums sums, out dvec3 translation, out dvec3 rotation) {
    dmat3 identity = dmat3(1.0);
    double trace = sums.square.x + sums.square.y + sums.square.z;
    dmat3 a = sums.arm.w * identity + symmetric(sums.translations.xyz, sums.translation_pairs.xyz);
    dmat3 b = dmat3(sums.mixed_x.xyz, sums.mixed_y.xyz, sums.mixed_z.xyz) - cross_matrix(sums.arm.xyz);
    dmat3 c = trace * identity - symmetric(sums.square.xyz, sums.product.xyz) +
              symmetric(sums.rotations.xyz, sums.rotation_pairs.xyz);
    dmat3 a_inverse = inverse(a);
    rotation = solve(c - transpose(b) * a_inverse * b, sums.moment.xyz - transpose(b) * (a_inverse * sums.force.xyz));
    translation = a_inverse * (sums.force.xyz - b * rotation);
}

// Friction of nodes that slide is taken times what that leaves of all pressing forces, of which few sweeps find far too
// much in stiff bodies. Adds it to the sums.
void solve_rigid_step(inout RigidSums sums, out dvec3 translation, out dvec3 rotation) {
    add_sliding(1.0, sums);
    find_displacement(sums, translation, rotation);
    if (!(sums.sliding_arm.w > 0.0 && sums.translations.w > 0.0)) return;
    double fall = dot(dvec3(sums.translation_pairs.w, sums.rotations.w, sums.rotation_pairs.w), translation) +
                  dot(dvec3(sums.mixed_x.w, sums.mixed_y.w, sums.mixed_z.w), rotation);
    add_sliding(clamp(1.0 - fall / sums.translations.w, 0.0lf, 1.0lf) - 1.0, sums);
    find_displacement(sums, translation, rotation);
}
