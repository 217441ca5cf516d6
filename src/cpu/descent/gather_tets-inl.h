// What tets add to the terms of nodes, one node in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_GATHER_TETS) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_GATHER_TETS
#undef GELATIN_CPU_GATHER_TETS
#else
#define GELATIN_CPU_GATHER_TETS
#endif

#include "cpu/descent/descend_groups.h"
#include "cpu/elasticity/node_terms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

using TermLanes = NodeTerms<FloatLanes>;

// Values at the nodes of each lane and at three other corners of its tet, relative to the first.
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
};

HWY_INLINE FloatLanes load(Lanes d, const std::array<float, kGroup>& column, std::uint32_t row) {
    return hn::LoadU(d, &column[row]);
}

// The shape gradients of a block in lanes.
struct GradientLanes {
    FloatLanes aa, ab, bb, ac, bc, cc;

    HWY_INLINE GradientLanes(Lanes d, const NeoHookeanBlock& block, std::uint32_t row)
        : aa(load(d, block.aa, row)),
          ab(load(d, block.ab, row)),
          bb(load(d, block.bb, row)),
          ac(load(d, block.ac, row)),
          bc(load(d, block.bc, row)),
          cc(load(d, block.cc, row)) {}

    // Of the rows' own nodes.
    HWY_INLINE Vec3Lanes own() const { return {-(aa + ab + ac), -(bb + bc), -cc}; }
    HWY_INLINE Mat3Lanes gradient_of(const EdgeLanes& edges) const {
        return {{multiply_add(aa, edges.a, multiply_add(ab, edges.b, ac * edges.c)),
                 multiply_add(bb, edges.b, bc * edges.c), cc * edges.c}};
    }
};

HWY_INLINE VolumeBound<FloatLanes> load_bounds(Lanes d, std::span<const glm::vec4> bounds,
                                               const std::uint32_t* tets) {
    if (bounds.empty()) return {};
    const Columns columns = load_nodes(d, &bounds[0].x, tets);
    return {columns.x, columns.y};
}

// Tets that are nearly a point open in their rest orientation, which blocks do not have.
HWY_INLINE void add_openings(Lanes d, LaneMask collapsed, std::uint32_t row,
                             const std::array<glm::vec3, kGroup>& openings, TermLanes& terms) {
    HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) {
        x[l] = openings[row + l].x;
        y[l] = openings[row + l].y;
        z[l] = openings[row + l].z;
    }
    terms.force += Vec3Lanes(hn::IfThenElseZero(collapsed, hn::Load(d, x)),
                             hn::IfThenElseZero(collapsed, hn::Load(d, y)),
                             hn::IfThenElseZero(collapsed, hn::Load(d, z)));
}

HWY_INLINE void gather_neo_hookean_lanes(Lanes d, const DescentGroups& from, std::size_t group,
                                         std::uint32_t row, const std::uint32_t* shown, const Columns& self,
                                         const float* positions, TermLanes& terms) {
    const DescentTets& tets = from.tets;
    const std::uint32_t first = tets.blocks.neo_hookean_starts[group],
                        end = tets.blocks.neo_hookean_starts[group + 1];
    if (first == end) return;
    const float* starts = tets.starts.empty() ? nullptr : &tets.starts[0].x;
    const Columns start = load_nodes(d, starts != nullptr ? starts : positions, &shown[row]);
    for (std::uint32_t b = first; b < end; ++b) {
        const NeoHookeanBlock& block = tets.blocks.neo_hookean[b];
        const EdgeLanes edges(d, positions, block, row, self);
        const GradientLanes gradients(d, block, row);
        const TetModuli<FloatLanes> moduli{load(d, block.mu, row), load(d, block.lambda, row)};
        const Mat3Lanes f = gradients.gradient_of(edges);
        const Vec3Lanes g = gradients.own();
        TetAtCorner<FloatLanes> tet;
        tet.stretched = f * g;
        tet.slope =
            (gradients.aa * gradients.bb * gradients.cc) * cross(edges.b - edges.a, edges.c - edges.a);
        tet.squares = dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]);
        tet.ratio = -dot(edges.a, tet.slope);
        tet.gradient_squared = dot(g, g);
        add_neo_hookean(tet, moduli, load_bounds(d, tets.bounds, &block.tets[row]), terms);
        const LaneMask collapsed = tet.squares < FloatLanes(static_cast<float>(thresholds::kCollapsed));
        if (!hn::AllFalse(d, collapsed)) add_openings(d, collapsed, row, tets.blocks.openings[b], terms);
        if (starts == nullptr) continue;
        const EdgeLanes before(d, starts, block, row, start);
        const FloatLanes damping = FloatLanes(0.25f * tets.inverse_step) * before.sum_of_w;
        if (hn::AllFalse(d, damping > FloatLanes(0.0f))) continue;
        add_viscosity(g, f, gradients.gradient_of(before), moduli, damping, terms);
    }
}

HWY_INLINE void gather_volume_lanes(Lanes d, const DescentGroups& from, std::size_t group, std::uint32_t row,
                                    const Columns& self, const float* positions, TermLanes& terms) {
    const DescentTets& tets = from.tets;
    for (std::uint32_t b = tets.blocks.volume_starts[group]; b < tets.blocks.volume_starts[group + 1]; ++b) {
        const VolumeBlock& block = tets.blocks.volumes[b];
        const EdgeLanes edges(d, positions, block, row, self);
        const Vec3Lanes slope =
            load(d, block.over_six_volumes, row) * cross(edges.b - edges.a, edges.c - edges.a);
        add_tet_volume(slope, -dot(edges.a, slope), load_bounds(d, tets.bounds, &block.tets[row]), terms);
    }
}

// What the tets of kLanes rows from `row` of the group on add. @param shown the group's nodes
HWY_INLINE TermLanes gather_tets(Lanes d, const DescentGroups& from, std::size_t group, std::uint32_t row,
                                 const std::uint32_t* shown, const Columns& self, const float* positions) {
    TermLanes terms;
    gather_neo_hookean_lanes(d, from, group, row, shown, self, positions, terms);
    gather_volume_lanes(d, from, group, row, self, positions, terms);
    return terms;
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
