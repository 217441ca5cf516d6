#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "arrays.h"
#include "bindings.h"
#include "cpu/cpu_solver.h"
#include "python_simulator.h"
#include "sim/simulator_internals.h"
#include "statistics.h"

namespace gelatin::python {
namespace {

// Null with OpenGL, which has the nodes in memory of its own.
const cpu::Nodes<float>* nodes_on_host(const Simulator& simulator) {
    const auto* solver = dynamic_cast<const cpu::CpuSolver<float>*>(&SimulatorInternals::solver(simulator));
    return solver == nullptr ? nullptr : &solver->nodes();
}

// Without the nodes of colliders' surfaces, which come last.
Vectors vectors_of(PythonSimulator& self, std::vector<glm::vec4> cpu::Nodes<float>::*member,
                   std::vector<float> HostFrame::*copied) {
    return self.use([&](const Simulator& simulator) {
        const std::size_t count = model_of(simulator).body_node_count();
        if (const cpu::Nodes<float>* nodes = nodes_on_host(simulator))
            return view_of(std::span(nodes->*member).first(count), nb::find(self));
        std::vector<float> values = std::move(simulator.read_frame().*copied);
        values.resize(3 * count);
        return array_of(std::move(values));
    });
}

// Empty where a solver does not find it.
Vectors forces_of(PythonSimulator& self, std::vector<float> HostFrame::*member) {
    return self.use([&](const Simulator& simulator) {
        std::vector<float> values = std::move(simulator.read_frame().*member);
        values.resize(std::min<std::size_t>(values.size(), 3 * model_of(simulator).body_node_count()));
        return array_of(std::move(values));
    });
}

std::size_t body_face_count(const Model& model) {
    return model.body_count() == 0 ? 0 : model.objects[model.body_count() - 1].faces.end();
}

nb::list objects_of(PythonSimulator& self) {
    return self.use([&](const Simulator& simulator) {
        const auto ends = [](const Range& range) { return nb::make_tuple(range.first, range.end()); };
        nb::list all;
        for (const ModelObject& object : model_of(simulator).bodies()) {
            nb::dict fields;
            fields["name"] = object.name;
            fields["nodes"] = ends(object.nodes);
            fields["faces"] = ends(object.faces);
            fields["tets"] = ends(object.tets);
            fields["mass"] = object.mass;
            fields["rest_volume"] = object.rest_volume;
            all.append(fields);
        }
        return all;
    });
}

nb::dict statistics_of(PythonSimulator& self) {
    return self.use([&](Simulator& simulator) {
        FrameStatistics statistics;
        {
            const nb::gil_scoped_release released;
            simulator.begin_statistics();
            statistics = simulator.take_statistics();
        }
        return to_dict(statistics, simulator);
    });
}

template <class Result>
auto getter(Result (Simulator::*member)() const) {
    return [member](PythonSimulator& self) {
        return self.use([&](const Simulator& simulator) { return (simulator.*member)(); });
    };
}

}  // namespace

void bind_simulator(nb::module_& module) {
    nb::class_<PythonSimulator>(module, "Simulator")
        .def(nb::init<nb::handle, const std::string&, std::optional<int>, bool>(), nb::arg("scene"),
             nb::arg("backend"), nb::arg("gl_device") = nb::none(), nb::arg("gl_debug") = false)
        .def("step", &PythonSimulator::step, nb::arg("count"))
        .def("advance", &PythonSimulator::advance, nb::arg("frames"))
        .def("reset", [](PythonSimulator& self) { self.use([](Simulator& s) { s.reset(); }); })
        .def("check", [](PythonSimulator& self) { self.use([](Simulator& s) { s.check(); }); })
        .def_prop_ro("frame", getter(&Simulator::frame))
        .def_prop_ro("time", getter(&Simulator::time))
        .def_prop_ro("substeps", getter(&Simulator::substeps))
        .def_prop_ro("step_size", getter(&Simulator::step_size))
        .def_prop_ro("backend", getter(&Simulator::backend))
        .def_prop_ro("device", getter(&Simulator::device))
        .def("positions",
             [](PythonSimulator& self) {
                 return vectors_of(self, &cpu::Nodes<float>::positions, &HostFrame::positions);
             })
        .def("velocities",
             [](PythonSimulator& self) {
                 return vectors_of(self, &cpu::Nodes<float>::velocities, &HostFrame::velocities);
             })
        .def("contact_forces",
             [](PythonSimulator& self) { return forces_of(self, &HostFrame::contact_forces); })
        .def("contact_friction",
             [](PythonSimulator& self) { return forces_of(self, &HostFrame::contact_friction); })
        .def("holding_forces",
             [](PythonSimulator& self) { return forces_of(self, &HostFrame::holding_forces); })
        .def("rest_positions",
             [](PythonSimulator& self) {
                 return self.use([&](const Simulator& simulator) {
                     const Model& model = model_of(simulator);
                     return view_of(std::span(model.positions).first(model.body_node_count()),
                                    nb::find(self));
                 });
             })
        .def("faces",
             [](PythonSimulator& self) {
                 return self.use([&](const Simulator& simulator) {
                     const Model& model = model_of(simulator);
                     return view_of(&model.faces[0].a, body_face_count(model), 3, nb::find(self));
                 });
             })
        .def("tets",
             [](PythonSimulator& self) {
                 return self.use([&](const Simulator& simulator) {
                     const Model& model = model_of(simulator);
                     return view_of(&model.tets[0].x, model.tets.size(), 4, nb::find(self));
                 });
             })
        .def("masses",
             [](PythonSimulator& self) {
                 return self.use([&](const Simulator& simulator) {
                     const Model& model = model_of(simulator);
                     return nb::ndarray<nb::numpy, const float, nb::ndim<1>>(
                         model.masses.data(), {model.body_node_count()}, nb::find(self));
                 });
             })
        .def("objects", &objects_of)
        .def("statistics", &statistics_of)
        .def(
            "save_checkpoint",
            [](PythonSimulator& self, const std::string& file) {
                self.use([&](const Simulator& s) { s.save_checkpoint(file); });
            },
            nb::arg("file"))
        .def(
            "load_checkpoint",
            [](PythonSimulator& self, const std::string& file) {
                self.use([&](Simulator& s) { s.load_checkpoint(file); });
            },
            nb::arg("file"));
}

}  // namespace gelatin::python
