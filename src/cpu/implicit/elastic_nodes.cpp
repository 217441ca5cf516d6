// As in advance_nodes_simd.cpp: a node's springs in a lane, compiled once for each instruction set. Nodes'
// lists of tets and edges have no order in which lanes would read them together; these are read one by one,
// as rows of four floats.
#include "cpu/implicit/elastic_lanes.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/implicit/elastic_nodes.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/implicit/elastic_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// A row: four floats, of which mostly three count.
#if HWY_TARGET == HWY_SCALAR
using Row = glm::vec4;
HWY_INLINE Row row_of(float all) {
    return Row(all);
}
HWY_INLINE Row load_row(const float* from) {
    return {from[0], from[1], from[2], from[3]};
}
HWY_INLINE void store_row(const Row& row, float* to) {
    std::memcpy(to, &row.x, sizeof row);
}
HWY_INLINE Row add_times(const Row& a, const Row& b, const Row& sum) {
    return a * b + sum;
}
template <int kPart>
HWY_INLINE Row part_of(const Row& row) {
    return Row(row[kPart]);
}
#else
using RowTag = hn::FixedTag<float, 4>;
using Row = hn::Vec<RowTag>;
HWY_INLINE Row row_of(float all) {
    return hn::Set(RowTag(), all);
}
HWY_INLINE Row load_row(const float* from) {
    return hn::LoadU(RowTag(), from);
}
HWY_INLINE void store_row(Row row, float* to) {
    hn::StoreU(row, RowTag(), to);
}
HWY_INLINE Row add_times(Row a, Row b, Row sum) {
    return hn::MulAdd(a, b, sum);
}
template <int kPart>
HWY_INLINE Row part_of(Row row) {
    return hn::Broadcast<kPart>(row);
}
#endif

// The last one in lanes without a node.
HWY_INLINE IndexColumn nodes_of(const Range& group) {
    IndexColumn nodes;
    for (std::uint32_t l = 0; l < kGroup; ++l) nodes[l] = group.first + std::min(l, group.count - 1);
    return nodes;
}

// A damper over a step makes of a spring another one, as cpu::damped_spring says.
HWY_INLINE TermLanes linearise_springs(Lanes d, const ElasticStart& start, std::size_t group,
                                       std::uint32_t row, ElasticArrays& arrays) {
    const float *positions = &start.positions[0].x, *velocities = &start.velocities[0].x;
    const IndexColumn nodes = nodes_of(arrays.groups[group]);
    const Columns self = load_nodes(d, positions, &nodes[row]);
    const FloatLanes own_time = load_nodes(d, velocities, &nodes[row]).w;
    TermLanes terms;
    for (std::uint32_t b = arrays.spring_starts[group]; b < arrays.spring_starts[group + 1]; ++b) {
        LinearSprings& springs = arrays.springs[b];
        const SpringLaws& laws = arrays.spring_laws[b];
        prefetch_block(&springs);
        prefetch_block(&laws);
        const Vec3Lanes apart = difference(load_nodes(d, positions, &springs.others[row]), self);
        const FloatLanes inverse = inverse_length<FloatLanes>(apart);
        SpringLaw<FloatLanes> law{load(d, laws.rest_lengths, row), load(d, laws.stiffnesses, row)};
        if (arrays.is_damped) {
            const FloatLanes times = own_time + FloatLanes(load_nodes(d, velocities, &springs.others[row]).w);
            law =
                damped_spring(law, FloatLanes(1.0f) / inverse, FloatLanes(0.5f * start.inverse_step) * times);
        }
        const FloatLanes pull = multiply_add(-(law.stiffness * law.rest_length), inverse, law.stiffness);
        const FloatLanes across = larger(pull, FloatLanes(0.0f));
        const Vec3Lanes stretch = (square_root(law.stiffness - across) * inverse) * apart;
        terms.force = multiply_add(pull, apart, terms.force);
        terms.hessian.add_identity(across);
        terms.hessian.add_outer(FloatLanes(1.0f), stretch);
        hn::StoreU(stretch.x.v, d, &springs.stretches[0][row]);
        hn::StoreU(stretch.y.v, d, &springs.stretches[1][row]);
        hn::StoreU(stretch.z.v, d, &springs.stretches[2][row]);
        hn::StoreU(across.v, d, &springs.across[row]);
    }
    return terms;
}

HWY_FLATTEN void node_group(const ElasticStart& start, std::size_t group, ElasticArrays& arrays,
                            glm::vec3* forces, cpu::SymmetricMatrix<float>* diagonal) {
    const Lanes d;
    HWY_ALIGN float lanes[9][kGroup];
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const TermLanes terms = linearise_springs(d, start, group, row, arrays);
        const Vec3Lanes parts[3] = {terms.force, terms.hessian.diagonal, terms.hessian.beside};
        for (std::size_t k = 0; k < 3; ++k) {
            hn::StoreU(parts[k].x.v, d, &lanes[3 * k][row]);
            hn::StoreU(parts[k].y.v, d, &lanes[3 * k + 1][row]);
            hn::StoreU(parts[k].z.v, d, &lanes[3 * k + 2][row]);
        }
    }
    const std::size_t first = arrays.groups[group].first, end = arrays.groups[group].end();
    for (std::size_t n = first; n < end; ++n) {
        const auto part = [&](std::size_t k) { return lanes[k][n - first]; };
        glm::vec3 force(part(0), part(1), part(2)), on(part(3), part(4), part(5)),
            off(part(6), part(7), part(8));
        if (arrays.has_matrices) {
            Row columns[3] = {row_of(0.0f), row_of(0.0f), row_of(0.0f)}, tet_force = row_of(0.0f);
            for (std::uint32_t e = arrays.half_edge_starts[n]; e < arrays.half_edge_starts[n + 1]; ++e) {
                const float* matrix = &arrays.matrices[ElasticArrays::kMatrix * std::size_t(e)];
                for (std::size_t k = 0; k < 3; ++k) columns[k] = columns[k] + load_row(matrix + 3 * k);
            }
            for (std::uint32_t e = arrays.node_tets.starts[n]; e < arrays.node_tets.starts[n + 1]; ++e) {
                const std::uint32_t entry = arrays.node_tets.entries[e];
                __builtin_prefetch(&arrays.tet_rows[arrays.node_tets.entries[e + ElasticArrays::kAhead] / 4]);
                const Row corner = load_row(&arrays.tet_rows[entry / 4].corners[entry % 4].x);
                tet_force = add_times(part_of<3>(corner), corner, tet_force);
            }
            glm::vec4 x, y, z, sum;
            store_row(columns[0], &x.x);
            store_row(columns[1], &y.x);
            store_row(columns[2], &z.x);
            store_row(tet_force, &sum.x);
            force -= glm::vec3(sum);
            on += glm::vec3(x.x, y.y, z.z);
            off += 0.5f * glm::vec3(y.z + z.y, z.x + x.z, x.y + y.x);
        }
        forces[n] = force;
        diagonal[n] = {on, off};
    }
}

HWY_INLINE void product_group(const Range& wanted, std::size_t group, const ElasticArrays& arrays,
                              const float* displacements, glm::vec3* product) {
    const Lanes d;
    HWY_ALIGN float rows[4 * kGroup];
    const Range& nodes = arrays.groups[group];
    const IndexColumn own = nodes_of(nodes);
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const Columns self = load_nodes(d, displacements, &own[row]);
        Vec3Lanes sum(FloatLanes(0.0f));
        for (std::uint32_t b = arrays.spring_starts[group]; b < arrays.spring_starts[group + 1]; ++b) {
            const LinearSprings& springs = arrays.springs[b];
            prefetch_block(&springs);
            const Vec3Lanes change = difference(self, load_nodes(d, displacements, &springs.others[row]));
            const Vec3Lanes stretch = load(d, springs.stretches, row);
            sum = multiply_add(load(d, springs.across, row), change, sum);
            sum = multiply_add(dot(stretch, change), stretch, sum);
        }
        hn::StoreInterleaved4(sum.x.v, sum.y.v, sum.z.v, hn::Zero(d), d, rows + 4 * row);
    }
    for (std::size_t n = std::max(nodes.first, wanted.first); n < std::min(nodes.end(), wanted.end()); ++n) {
        Row x = load_row(rows + 4 * (n - nodes.first)), y = row_of(0.0f), z = row_of(0.0f);
        if (arrays.has_matrices) {
            const Row self = load_row(displacements + 4 * n);
            for (std::uint32_t e = arrays.half_edge_starts[n]; e < arrays.half_edge_starts[n + 1]; ++e) {
                const Row change = self - load_row(displacements + 4 * std::size_t(arrays.half_edge_ends[e]));
                const float* matrix = &arrays.matrices[ElasticArrays::kMatrix * std::size_t(e)];
                x = add_times(load_row(matrix), part_of<0>(change), x);
                y = add_times(load_row(matrix + 3), part_of<1>(change), y);
                z = add_times(load_row(matrix + 6), part_of<2>(change), z);
            }
        }
        glm::vec4 sum;
        store_row(x + y + z, &sum.x);
        product[n] = glm::vec3(sum);
    }
}

HWY_FLATTEN void product_range(const Range& nodes, const ElasticArrays& arrays,
                               const glm::vec4* displacements, glm::vec3* product) {
    if (nodes.count == 0) return;
    const std::size_t end = arrays.groups_of_nodes[nodes.end() - 1] + 1;
    for (std::size_t g = arrays.groups_of_nodes[nodes.first]; g < end; ++g)
        product_group(nodes, g, arrays, &displacements[0].x, product);
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(node_group);
HWY_EXPORT(product_range);

void linearise_nodes(const ElasticStart& start, std::size_t group, ElasticArrays& arrays, Vec3<float>* forces,
                     SymmetricMatrix<float>* diagonal) {
    HWY_DYNAMIC_DISPATCH(node_group)(start, group, arrays, forces, diagonal);
}

void multiply_nodes(const Range& nodes, const ElasticArrays& arrays, const Vec4<float>* displacements,
                    Vec3<float>* product) {
    HWY_DYNAMIC_DISPATCH(product_range)(nodes, arrays, displacements, product);
}

}  // namespace gelatin::cpu
#endif
