#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "core/log.h"
#include "errors.h"
#include "gelatin/error.h"
#include "gelatin/version.h"
#include "scene_conversion.h"

namespace gelatin::python {

namespace nb = nanobind;
NB_MODULE(_gelatin, module) {
    set_up_log(LogLevel::notes);
    bind_errors(module);
    bind_simulator(module);
    bind_batch(module);
    module.def("version", &version);
    module.def("commit", &commit);
    module.def(
        "load",
        [](const std::string& file, const std::vector<std::string>& overrides) {
            return python_scene(load_scene(file, overrides));
        },
        nb::arg("file"), nb::arg("overrides"));
    module.def(
        "validate", [](nb::handle scene) { validate(scene_of(scene)); }, nb::arg("scene"));
    module.def(
        "same", [](nb::handle scene) { return python_scene(scene_of(scene)); }, nb::arg("scene"),
        "The scene, through C++ and back; for tests.");
    module.def("defaults", &scene_defaults, "Defaults of C++'s structs by class; for tests.");
    module.def(
        "set_log_level",
        [](const std::string& level) {
            if (level == "warnings") return set_up_log(LogLevel::warnings);
            if (level == "notes") return set_up_log(LogLevel::notes);
            if (level == "debugging") return set_up_log(LogLevel::debugging);
            throw InvalidInput({{},
                                0,
                                "level",
                                "\"" + level + "\"",
                                "must be one of \"warnings\", \"notes\", \"debugging\""});
        },
        nb::arg("level"));
}

}  // namespace gelatin::python
