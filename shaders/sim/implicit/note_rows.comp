// What contacts of two objects hold when a part has been solved. An invocation a row.
// CPU twin: gelatin::cpu::ContactRows::note. Parity: tests/gpu/implicit/pair_rows_test.cpp.
#include "include/global_index.glsl"
#include "layouts/near_pair.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/rows.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer slips;  // s of rows [m]
layout(std430) readonly buffer Rows { StepRow rows[]; };
layout(std430) buffer RowNotes { RowMemory row_notes[]; };

void main() {
    uint r = global_index();
    if (r >= clock[0].row_count) return;
    StepRow row = rows[r];
    vec3 s = texelFetch(slips, int(r)).xyz;
    float limit = row.friction * pressing(row, s);
    row_notes[r].hold = vec4(limit > 0.0 ? held_at(row, s, limit) : vec3(0.0), limit);
    row_notes[r].reach = row.reach;
}
