// Where elements begin in a list, as sum_counts.comp and place_lists.comp leave it.
#include "layouts/pair_stages.glsl"

uint list_start(usamplerBuffer starts, usamplerBuffer group_sums, uint k) {
    return texelFetch(starts, int(k)).x + texelFetch(group_sums, int(k / kCountsAGroup)).x;
}
