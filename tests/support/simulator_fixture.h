#pragma once

#include "gelatin/simulator.h"
#include "support/gl_fixture.h"

namespace gelatin::test {

/// Two balls of radius 0.3 m, 1 m apart, above the floor.
Scene falling_balls();

/// A ball that is held at its left, rotated and released, and another one that is pushed and pressed for a
/// while.
Scene driven_balls(SolverKind solver);

/// Of two frames' coordinates [m].
double largest_difference(const HostFrame& a, const HostFrame& b);

/// Simulators share the fixture's context, as a host application's would.
class SimulatorFixture : public GlTest {
protected:
    static SimulatorOptions on(Backend backend) {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        return options;
    }
};

}  // namespace gelatin::test
