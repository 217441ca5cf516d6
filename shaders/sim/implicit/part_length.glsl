// How long a part of a step may be. CPU twin: gelatin::cpu::ImplicitStep.
#include "layouts/contact_tuning.glsl"
#include "layouts/step_state.glsl"

bool is_shortest(StepClock now) { return now.step < 2.0 * now.size / float(kMostParts); }

// Of a step that is divided into so many parts at least: the same, or one of them [s].
float shortened(StepClock now, uint parts) {
    float longest = now.size / float(max(parts, 1u));
    return now.divides == 0u || now.step < 1.01 * longest ? now.step : longest;  // but for rounding
}
