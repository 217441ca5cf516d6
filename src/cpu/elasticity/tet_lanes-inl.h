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

// Values at three other corners of each lane's tet, relative to its node.
struct EdgeLanes {
    Vec3Lanes a, b, c;
    FloatLanes sum_of_w;  // of all four

    template <class Block>
    HWY_INLINE EdgeLanes(Lanes d, const float* values, const Block& block, std::uint32_t row,
                         const Columns& self) {
        const Columns at_a = load_nodes(d, values, &block.nodes[0][row]),
                      at_b = load_nodes(d, values, &block.nodes[1][row]),
                      at_c = load_nodes(d, values, &block.nodes[2][row]);
        a = difference(at_a, self);
        b = difference(at_b, self);
        c = difference(at_c, self);
        sum_of_w = hn::Add(hn::Add(self.w, at_a.w), hn::Add(at_b.w, at_c.w));
    }

    // Twice the area of the face opposite to the node, away from it.
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
                               const EdgeLanes& edges)
        : moduli{load(d, block.mu, row), load(d, block.lambda, row)},
          aa_(load(d, block.aa, row)),
          ab_(load(d, block.ab, row)),
          bb_(load(d, block.bb, row)),
          ac_(load(d, block.ac, row)),
          bc_(load(d, block.bc, row)),
          cc_(load(d, block.cc, row)) {
        g = {-(aa_ + ab_ + ac_), -(bb_ + bc_), -cc_};
        f = gradient_of(edges);
        at_corner.stretched = f * g;
        at_corner.slope = (aa_ * bb_ * cc_) * edges.area();
        at_corner.squares = double_dot(f, f);
        at_corner.ratio = -dot(edges.a, at_corner.slope);
        at_corner.gradient_squared = dot(g, g);
    }

    HWY_INLINE Mat3Lanes gradient_of(const EdgeLanes& edges) const {
        return {multiply_add(aa_, edges.a, multiply_add(ab_, edges.b, ac_ * edges.c)),
                multiply_add(bb_, edges.b, bc_ * edges.c), cc_ * edges.c};
    }

    // Tets that are nearly a point open in their rest orientation, which blocks do not have.
    HWY_INLINE void add_openings(Lanes d, const std::array<glm::vec3, kGroup>& openings, std::uint32_t row,
                                 Vec3Lanes& force) const {
        const LaneMask collapsed = at_corner.squares < FloatLanes(static_cast<float>(kCollapsed));
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
