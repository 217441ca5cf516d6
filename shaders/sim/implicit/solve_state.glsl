// The state of an island's conjugate gradients. total: what its bodies lack together [J], and how many lack more than they may.
// CPU twin: gelatin::cpu::IslandSolve::conjugate_gradients.
#include "layouts/contact_tuning.glsl"

uniform uint most_iterations;  // of a linearisation; twice as many without rows

// What a body lacks; after sim/implicit/solve_system.glsl.
vec2 lack_of(uint object, float lack) { return vec2(lack, lack <= enough_of(object) ? 0.0 : 1.0); }

// Where a linearisation begins. @param state after the one before
SolveState first_state(SolveState state, vec2 total, bool has_rows) {
    // One iteration is made in any case: what elements exert counts, however short the part.
    bool is_needed = state.iterations == 0u || total.y > 0.0;
    bool is_done = state.is_over != 0u || !(total.x > 0.0) || !is_needed;
    return SolveState(total.x, is_done ? 1u : 0u, 0u, state.iterations, 0u, has_rows ? kSlightly * total.x : 0.0,
                      state.is_over, 0u);
}

// After an iteration.
SolveState next_state(SolveState state, vec2 total, bool has_rows) {
    uint made = state.made + (state.is_stuck != 0u ? 0u : 1u), most = most_iterations * (has_rows ? 1u : 2u);
    bool goes_on = state.is_stuck == 0u && total.y > 0.0 && total.x > state.enough && made < most;
    return SolveState(total.x, goes_on ? 0u : 1u, 0u, state.iterations + 1u, made, state.enough, state.is_over, 0u);
}
