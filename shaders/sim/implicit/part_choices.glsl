// How a part goes on, by what bodies touch and how they move beside it.
// CPU twins: gelatin::cpu::ImplicitStep::run, gelatin::cpu::Paces.
#include "sim/implicit/part_length.glsl"

const uint kMoving = 0u, kCalm = 1u, kStill = 2u;  // as in cpu::Paces

uint parts_of(uint pace) { return pace == kMoving ? kPartsOfMoving : pace == kCalm ? kPartsOfCalm : kPartsOfStill; }

StepClock halved(StepClock now) {
    now.step *= 0.5;
    now.damps = 0u;
    now.goes_on = 0u;
    return now;
}

// Of a try whether it goes on; else the next one is shorter. @param deepest how far contacts would come into each other [reaches]
StepClock with_length(StepClock now, uint parts, float deepest) {
    now.parts = parts;
    float step = shortened(now, parts);
    if (step != now.step) {
        now.step = step;
        now.goes_on = 0u;
    } else if (deepest > kDeepest && !is_shortest(now)) {
        now = halved(now);
    }
    return now;
}

// Whether an island goes on by a scheme that is not Euler's.
bool has_past_scheme(StepClock now, uint pace, bool is_struck, bool touches, bool resolves) {
    bool has_past = now.damps == 0u && !is_shortest(now) && now.last_step > 0.0;
    return has_past && pace == kMoving && !is_struck && (!touches || resolves);
}

// [s]
float least_damping(bool goes_on, uint pace) { return !goes_on && pace == kStill ? kImpactTime : 0.0; }
