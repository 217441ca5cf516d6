#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

namespace gelatin::python {

/// Makes Gelatin's exceptions classes of the module, and translates them with their text and what else they
/// tell.
void bind_errors(nanobind::module_& module);

}  // namespace gelatin::python
