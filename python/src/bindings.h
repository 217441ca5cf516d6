#pragma once

#include <nanobind/nanobind.h>

namespace gelatin::python {

class PythonSimulator;

void bind_simulator(nanobind::module_& module);
/// What programs change between steps.
void bind_changes(nanobind::class_<PythonSimulator>& simulator);
void bind_picture(nanobind::class_<PythonSimulator>& simulator);
void bind_meshes(nanobind::module_& module);
void bind_recording(nanobind::module_& module, nanobind::class_<PythonSimulator>& simulator);
void bind_batch(nanobind::module_& module);

}  // namespace gelatin::python
