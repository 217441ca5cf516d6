#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "core/file.h"
#include "errors.h"
#include "gelatin/version.h"
#include "messages.h"
#include "scene_conversion.h"

namespace gelatin::python {

namespace nb = nanobind;
NB_MODULE(_gelatin, module) {
    collect_messages();
    translate_errors();
    bind_meshes(module);
    bind_simulator(module);
    bind_batch(module);
    module.def("version", &version);
    module.def("commit", &commit);
    module.def(
        "write_file",
        [](const std::string& file, const nb::bytes& content) {
            write_file(file, {content.c_str(), content.size()});
        },
        nb::arg("file"), nb::arg("content"));
    module.def(
        "load",
        [](const std::string& file, const std::vector<std::string>& overrides) {
            const MessagesAtEnd messages;
            return python_scene(load_scene(file, overrides));
        },
        nb::arg("file"), nb::arg("overrides"));
    module.def(
        "validate", [](nb::handle scene) { validate(scene_of(scene)); }, nb::arg("scene"));
    module.def(
        "same", [](nb::handle scene) { return python_scene(scene_of(scene)); }, nb::arg("scene"),
        "The scene, through C++ and back; for tests.");
    module.def("defaults", &scene_defaults, nb::sig("def defaults() -> dict[str, dict[str, typing.Any]]"),
               "Defaults of C++'s structs by class; for tests.");
}

}  // namespace gelatin::python
