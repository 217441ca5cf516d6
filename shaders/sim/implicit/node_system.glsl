// The system of a step at a node: elements, inertia and rows.
#include "layouts/element_edge.glsl"
#include "sim/elasticity/node_terms.glsl"
#include "sim/implicit/rows_at_nodes.glsl"

uniform samplerBuffer element_blocks;  // NodeBlock, two texels each

NodeTerms block_at(uint n, float inertia) {
    NodeTerms block = NodeTerms(vec3(0.0), texelFetch(element_blocks, 2 * int(n)).xyz,
                                texelFetch(element_blocks, 2 * int(n) + 1).xyz);
    block.diagonal += inertia;
#ifdef ROWS
    uint end = texelFetch(entry_starts, int(n) + 1).x;
    for (uint e = texelFetch(entry_starts, int(n)).x; e < end; ++e) {
        uint entry = texelFetch(row_entries, int(e)).x;
        float weight = rows[entry / 4u].weights[entry % 4u];
        RowStiffness k = row_stiffness(entry / 4u);
        block.diagonal += weight * weight * k.diagonal;
        block.beside += weight * weight * k.beside;
    }
#endif
    return block;
}

#ifdef PRODUCTS
#include "sim/implicit/half_edges.glsl"

// Without rows, where a solve begins [N].
vec3 base_of(uint n, vec4 load, vec3 d) { return load.xyz - stiffness_times(n, d) - load.w * d; }

// A p, rows among it.
vec3 product_at(uint n, float inertia, vec3 p) { return stiffness_times(n, p) + inertia * p + sum_of_rows(n); }
#endif
