// Tets as the nodes of a group see them, one in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_TET_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_TET_LANES
#undef GELATIN_CPU_TET_LANES
#else
#define GELATIN_CPU_TET_LANES
#endif

#include "cpu/elasticity/elements-inl.h"
#include "cpu/elasticity/tet_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// Where the oldest vertex of strips stays: the sign bits.
HWY_INLINE LaneMask oldest_stays(Lanes d, Vector signs) {
    const hn::Rebind<std::int32_t, Lanes> di;  // of floats, -0 would not be negative
    return hn::RebindMask(d, hn::Lt(hn::BitCast(di, signs), hn::Zero(di)));
}

// A number at each of the last three vertices of strips, the oldest first.
struct NumberStrip {
    FloatLanes a, b, c;

    HWY_INLINE NumberStrip() : a(0.0f), b(0.0f), c(0.0f) {}
    HWY_INLINE void step(FloatLanes next, LaneMask keeps) {
        a = select(keeps, a, b);
        b = c;
        c = next;
    }
    HWY_INLINE FloatLanes sum() const { return a + b + c; }
};

// Values at the last three vertices, relative to the rows' nodes.
struct StripLanes {
    Vec3Lanes a, b, c;
    NumberStrip w;  // as they are

    HWY_INLINE StripLanes() : a(FloatLanes(0.0f)), b(FloatLanes(0.0f)), c(FloatLanes(0.0f)) {}

    // @param nodes the vertices that come in
    HWY_INLINE void step(Lanes d, const float* values, const std::uint32_t* nodes, const Columns& self,
                         LaneMask keeps) {
        a = {select(keeps, a.x, b.x), select(keeps, a.y, b.y), select(keeps, a.z, b.z)};
        b = c;
        const Columns next = load_nodes(d, values, nodes);
        c = difference(next, self);
        w.step(next.w, keeps);
    }

    // Twice the area of the triangle, away from the nodes where its vertices come counter-clockwise.
    HWY_INLINE Vec3Lanes area() const { return cross(b - a, c - a); }
};

HWY_INLINE FloatLanes load(Lanes d, const std::array<float, kGroup>& column, std::uint32_t row) {
    return hn::LoadU(d, &column[row]);
}

// A block's neo-Hookean tets.
struct NeoHookeanLanes {
    TetModuli<FloatLanes> moduli;  // times V
    Vec3Lanes g;                   // the nodes' own shape gradients
    Mat3Lanes f;
    TetAtCorner<FloatLanes> at_corner;

    HWY_INLINE NeoHookeanLanes(Lanes d, const NeoHookeanBlock& block, std::uint32_t row,
                               const StripLanes& strip)
        : moduli{hn::Abs(load(d, block.mu, row).v), load(d, block.lambda, row)},
          aa_(load(d, block.aa, row)),
          ab_(load(d, block.ab, row)),
          bb_(load(d, block.bb, row)),
          ac_(load(d, block.ac, row)),
          bc_(load(d, block.bc, row)),
          cc_(load(d, block.cc, row)) {
        g = {-(aa_ + ab_ + ac_), -(bb_ + bc_), -cc_};
        f = gradient_of(strip);
        at_corner.stretched = f * g;
        at_corner.slope = (aa_ * bb_ * cc_) * strip.area();
        at_corner.squares = double_dot(f, f);
        at_corner.ratio = -dot(strip.a, at_corner.slope);
        at_corner.gradient_squared = dot(g, g);
    }

    HWY_INLINE Mat3Lanes gradient_of(const StripLanes& strip) const {
        return {multiply_add(aa_, strip.a, multiply_add(ab_, strip.b, ac_ * strip.c)),
                multiply_add(bb_, strip.b, bc_ * strip.c), cc_ * strip.c};
    }

    // dv/dx, with v the tet's volume [m^2]; 0 without a tet.
    HWY_INLINE Vec3Lanes volume_slope(Lanes d, const StripLanes& strip) const {
        const Vector side = (aa_ * bb_ * cc_).v;
        return FloatLanes(hn::IfThenElseZero(hn::Ne(side, hn::Zero(d)),
                                             hn::CopySign(hn::Set(d, 1.0f / 6.0f), side))) *
               strip.area();
    }

    // Tets that are nearly a point open in their rest orientation, which blocks do not have.
    HWY_INLINE void add_openings(Lanes d, const std::array<glm::vec3, kGroup>& openings, std::uint32_t row,
                                 Vec3Lanes& force) const {
        const LaneMask collapsed = hn::And(
            at_corner.squares<FloatLanes(static_cast<float>(kCollapsed)), moduli.mu> FloatLanes(0.0f));
        if (hn::AllFalse(d, collapsed)) return;
        HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) {
            x[l] = openings[row + l].x;
            y[l] = openings[row + l].y;
            z[l] = openings[row + l].z;
        }
        force += Vec3Lanes(hn::IfThenElseZero(collapsed, hn::Load(d, x)),
                           hn::IfThenElseZero(collapsed, hn::Load(d, y)),
                           hn::IfThenElseZero(collapsed, hn::Load(d, z)));
    }

private:
    FloatLanes aa_, ab_, bb_, ac_, bc_, cc_;  // NeoHookeanBlock
};

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
