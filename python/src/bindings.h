#pragma once

#include <nanobind/nanobind.h>

namespace gelatin::python {

void bind_simulator(nanobind::module_& module);
void bind_batch(nanobind::module_& module);

}  // namespace gelatin::python
