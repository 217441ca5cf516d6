#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "gelatin/recording.h"
#include "python_simulator.h"
#include "scene_conversion.h"

namespace gelatin::python {
namespace {

std::vector<int> frames_of(PythonSimulator& self) {
    return self.use([](const Simulator& simulator) {
        std::vector<int> frames;
        const Recording& recording = *simulator.recording();
        for (std::size_t k = 0; k < recording.frame_count(); ++k) frames.push_back(recording.frame(k));
        return frames;
    });
}

std::unique_ptr<RecordingWriter> record(const std::string& file, PythonSimulator& simulator) {
    return simulator.use([&](const Simulator& s) { return std::make_unique<RecordingWriter>(file, s); });
}

void write(RecordingWriter& self, PythonSimulator& simulator) {
    simulator.use([&](const Simulator& s) {
        const nb::gil_scoped_release released;
        self.write(s);
    });
}

}  // namespace

void bind_recording(nb::module_& module, nb::class_<PythonSimulator>& simulator) {
    nb::class_<RecordingWriter>(module, "RecordingWriter")
        .def("write", &write, nb::arg("simulator"))
        .def("finish", &RecordingWriter::finish, nb::call_guard<nb::gil_scoped_release>());
    module.def("record", &record, nb::arg("file"), nb::arg("simulator"));
    module.def(
        "play", [](const std::string& file) { return std::make_unique<PythonSimulator>(file); },
        nb::arg("file"));
    simulator.def("recorded_frames", &frames_of)
        .def(
            "show_recorded",
            [](PythonSimulator& self, int frame) {
                self.use([&](Simulator& s) { s.show_recorded(s.recording()->index_of(frame)); });
            },
            nb::arg("frame"))
        .def("scene", [](PythonSimulator& self) {
            return self.use([](const Simulator& s) { return python_scene(s.scene()); });
        });
}

}  // namespace gelatin::python
