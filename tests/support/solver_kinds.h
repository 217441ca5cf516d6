#pragma once

#include "model/solver.h"

namespace gelatin::test {

inline constexpr SolverKind kExplicitSolvers[] = {SolverKind::explicit_euler, SolverKind::semi_implicit_euler,
                                                  SolverKind::midpoint, SolverKind::rk4};
inline constexpr SolverKind kSolvers[] = {SolverKind::explicit_euler, SolverKind::semi_implicit_euler,
                                          SolverKind::midpoint, SolverKind::rk4, SolverKind::implicit};

}  // namespace gelatin::test
