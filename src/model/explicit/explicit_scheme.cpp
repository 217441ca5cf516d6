#include "model/explicit/explicit_scheme.h"

namespace gelatin {

const ExplicitScheme& explicit_scheme(SolverKind solver) {
    static constexpr ExplicitScheme kExplicitEuler{1, {{{1.0, 0.0}}}, false};
    static constexpr ExplicitScheme kSemiImplicitEuler{1, {{{1.0, 0.0}}}, true};
    static constexpr ExplicitScheme kMidpoint{2, {{{0.0, 0.5}, {1.0, 0.0}}}, false};
    static constexpr ExplicitScheme kRungeKutta4{
        4, {{{1.0 / 6.0, 0.5}, {1.0 / 3.0, 0.5}, {1.0 / 3.0, 1.0}, {1.0 / 6.0, 0.0}}}, false};
    switch (solver) {
        case SolverKind::explicit_euler:
            return kExplicitEuler;
        case SolverKind::midpoint:
            return kMidpoint;
        case SolverKind::rk4:
            return kRungeKutta4;
        case SolverKind::semi_implicit_euler:
        case SolverKind::implicit:  // has none
            break;
    }
    return kSemiImplicitEuler;
}

}  // namespace gelatin
