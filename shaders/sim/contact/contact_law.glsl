// How two surfaces press each other that are nearer than r: docs/contact.md. CPU twin: src/cpu/contact/contact_law.inl.

// Of a gap that rounding has left without any, one that is this much of r is taken.
float contact_gap(float gap, float reach) { return max(gap, 1e-4 * reach); }

// Minus the slope of the energy by the gap [N].
float contact_force(float gap, float reach, float stiffness) {
    float barrier = 0.25 * reach * reach / contact_gap(gap, reach);
    return stiffness * (gap < 0.5 * reach ? barrier : max(reach - gap, 0.0));
}

// The second derivative of the energy by the gap [N/m].
float contact_hessian(float gap, float reach, float stiffness) {
    float least = contact_gap(gap, reach);
    float barrier = 0.25 * reach * reach / (least * least);
    return stiffness * (gap < 0.5 * reach ? barrier : gap < reach ? 1.0 : 0.0);
}
