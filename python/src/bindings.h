#pragma once

#include <nanobind/nanobind.h>

namespace gelatin::python {

void bind_simulator(nanobind::module_& module);

}  // namespace gelatin::python
