// How two surfaces press each other that are nearer than a distance r (docs/contact.md): a spring that is
// stiff from the start, and a barrier below half of r. With k the stiffness, for a gap g:
//   from r on         nothing;
//   from r / 2 to r   energy k / 2 (r - g)^2;
//   below             k r^2 / 8 (1 + 2 ln(r / (2 g))), whose force k r^2 / (4 g) has no bound.
// The force and its derivative are continuous. The energy is convex.

/// Of a gap that rounding has left without any, one that is this much of r is taken.
template <class Real>
Real contact_gap(Real gap, Real reach) {
    return larger(gap, Real(1e-4f) * reach);
}

/// [J]
template <class Real>
Real contact_energy(Real gap, Real reach, Real stiffness) {
    const Real depth = larger(reach - gap, Real(0));
    const Real barrier = Real(0.125f) * reach * reach *
                         (Real(1) + Real(2) * logarithm(reach / (Real(2) * contact_gap(gap, reach))));
    return stiffness * select(gap < Real(0.5f) * reach, barrier, Real(0.5f) * depth * depth);
}

/// Minus the slope of the energy by the gap [N].
template <class Real>
Real contact_force(Real gap, Real reach, Real stiffness) {
    const Real depth = larger(reach - gap, Real(0));
    const Real barrier = Real(0.25f) * reach * reach / contact_gap(gap, reach);
    return stiffness * select(gap < Real(0.5f) * reach, barrier, depth);
}

/// The second derivative of the energy by the gap [N/m].
template <class Real>
Real contact_hessian(Real gap, Real reach, Real stiffness) {
    const Real least = contact_gap(gap, reach);
    const Real barrier = Real(0.25f) * reach * reach / (least * least);
    const Real spring = select(gap < reach, Real(1), Real(0));
    return stiffness * select(gap < Real(0.5f) * reach, barrier, spring);
}

/// One node's share of a contact, as the node alone sees it: with m the direction towards the other side, d
/// the node's displacement since the contact was aimed, and s the share of the gap that its side may use,
///   E = s contact_energy(g_0 - (m . d) / s) + s F(q_0 + k / s (d - (m . d) m)).
/// The stiffness k, q_0 and the limit of friction L are the contact's times the node's weight. F is Coulomb's
/// friction for a force that stays as it is: q is what holds the surfaces together while they stick, and
///   F(q) = |q|^2 / (2 k) up to |q| = L, from there on L (|q| - L / 2) / k.
/// The sum over the nodes of both sides is no less than the contact's energy, and equal to it where it was
/// aimed, in value and slope, because both parts are convex (Jensen's inequality).
template <class Real>
struct ContactShare {
    Vec3<Real> towards;  ///< m, unit
    Real gap;            ///< g_0 [m]
    Real inverse_share;  ///< 1 / s
    Real stiffness;      ///< k [N/m]
    Real reach;          ///< r [m]
    Vec3<Real> hold;     ///< q_0 [N], at right angles to m
    Real friction;       ///< Coulomb's coefficient
    Real limit;          ///< L [N]

    /// @param displacement d [m]
    Real gap_at(const Vec3<Real>& displacement) const {
        return gap - inverse_share * dot(towards, displacement);
    }
    Vec3<Real> hold_at(const Vec3<Real>& displacement) const {
        const Vec3<Real> along = displacement - dot(towards, displacement) * towards;
        return multiply_add(stiffness * inverse_share, along, hold);
    }
};

/// Of what friction adds to the second derivative, this share stays along a slip, whose force does not change
/// with it. Without any, Newton's step along a slip has no bound.
template <class Real>
constexpr Real kSlipShare = Real(0.01f);

/// [J]
template <class Real>
Real contact_share_energy(const ContactShare<Real>& share, const Vec3<Real>& displacement) {
    const Vec3<Real> hold = share.hold_at(displacement);
    const Real squared = dot(hold, hold), length = square_root(squared);
    const Real friction = select(length > share.limit, share.limit * (length - Real(0.5f) * share.limit),
                                 Real(0.5f) * squared) /
                          share.stiffness;
    return (contact_energy(share.gap_at(displacement), share.reach, share.stiffness) + friction) /
           share.inverse_share;
}

template <class Real>
void add_contact_share(const ContactShare<Real>& share, const Vec3<Real>& displacement,
                       NodeTerms<Real>& terms) {
    const Real gap = share.gap_at(displacement);
    terms.force =
        multiply_add(Real(0) - contact_force(gap, share.reach, share.stiffness), share.towards, terms.force);
    terms.hessian.add_outer(share.inverse_share * contact_hessian(gap, share.reach, share.stiffness),
                            share.towards);
}

/// @pre the limit is positive
template <class Real>
void add_friction_share(const ContactShare<Real>& share, const Vec3<Real>& displacement,
                        NodeTerms<Real>& terms) {
    const Vec3<Real> hold = share.hold_at(displacement);
    const Real squared = dot(hold, hold);
    const Real shortened = larger(square_root(squared), share.limit);  // at least the limit
    const Real part = share.limit / shortened;
    terms.force = multiply_add(Real(0) - part, hold, terms.force);
    const Real across = share.inverse_share * share.stiffness * part;
    terms.hessian.add_identity(across);
    terms.hessian.add_outer(Real(0) - across, share.towards);
    const Real slides = select(squared > share.limit * share.limit, Real(1) - kSlipShare<Real>, Real(0));
    terms.hessian.add_outer(Real(0) - slides * across / larger(squared, share.limit * share.limit), hold);
}
