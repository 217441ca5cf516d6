#pragma once

#include <vector>

#include "model/scene/value_checks.h"

namespace gelatin {

/// A part of validate(). @param field of the list
void check_cavities(const ValueChecks& checks, const FieldPath& field,
                    const std::vector<CavityDescription>& cavities, SolverKind solver);

/// What a cavity has from some time on: one value, of its law.
void check_gas(const ValueChecks& checks, const FieldPath& field, const CavityDescription& cavity,
               const CavityGas& gas);

}  // namespace gelatin
