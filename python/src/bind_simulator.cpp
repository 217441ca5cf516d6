#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <glm/gtc/quaternion.hpp>

#include "arrays.h"
#include "bindings.h"
#include "python_simulator.h"
#include "sim/simulator_internals.h"
#include "statistics.h"

namespace gelatin::python {
namespace {

using Numbers = nb::ndarray<nb::numpy, const float, nb::ndim<1>>;

// Without the nodes of colliders' surfaces, which come last.
Vectors vectors_of(PythonSimulator& self, std::span<const glm::vec4> HostNodes::*member,
                   std::vector<float> HostFrame::*copied) {
    return self.use([&](const Simulator& simulator) {
        const std::size_t count = model_of(simulator).body_node_count();
        if (!simulator.uses_gl()) {
            const std::shared_ptr<const Solver> solver = SimulatorInternals::share_solver(simulator);
            return view_of((solver->host_nodes().*member).first(count), solver);
        }
        // OpenGL has them in memory of its own.
        std::vector<float> values = std::move(simulator.read_frame().*copied);
        values.resize(3 * count);
        return array_of(std::move(values));
    });
}

// What never changes of a simulator without pins of programs.
template <class View>
auto model_view(const View& view) {
    return [view](PythonSimulator& self) {
        return self.use([&](const Simulator& simulator) {
            const std::shared_ptr<const Model> model = SimulatorInternals::share_model(simulator);
            return view(*model, model);
        });
    };
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
            fields["is_rigid"] = object.is_rigid;
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
    nb::class_<PythonSimulator> simulator(module, "Simulator");
    simulator
        .def(nb::init<nb::handle, const std::string&, std::optional<int>, bool>(), nb::arg("scene").none(),
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
                 return vectors_of(self, &HostNodes::positions, &HostFrame::positions);
             })
        .def("velocities",
             [](PythonSimulator& self) {
                 return vectors_of(self, &HostNodes::velocities, &HostFrame::velocities);
             })
        .def("contact_forces",
             [](PythonSimulator& self) { return forces_of(self, &HostFrame::contact_forces); })
        .def("contact_friction",
             [](PythonSimulator& self) { return forces_of(self, &HostFrame::contact_friction); })
        .def("holding_forces",
             [](PythonSimulator& self) { return forces_of(self, &HostFrame::holding_forces); })
        .def("rest_positions", model_view([](const Model& model, const Owner& owner) {
                 return view_of(std::span(model.positions).first(model.body_node_count()), owner);
             }))
        .def("faces", model_view([](const Model& model, const Owner& owner) {
                 return view_of(&model.faces[0].a, body_face_count(model), 3, owner);
             }))
        .def("tets", model_view([](const Model& model, const Owner& owner) {
                 return view_of(model.tets.empty() ? nullptr : &model.tets[0].x, model.tets.size(), 4, owner);
             }))
        .def("masses", model_view([](const Model& model, const Owner& owner) {
                 return Numbers(model.masses.data(), {model.body_node_count()}, capsule_of(owner));
             }))
        .def("objects", &objects_of, nb::sig("def objects(self) -> list[dict[str, typing.Any]]"))
        .def(
            "rotation",
            [](PythonSimulator& self, std::size_t object) {
                const glm::dmat3 r =
                    self.use([&](const Simulator& s) { return glm::mat3_cast(s.rotation(object)); });
                return nb::make_tuple(r[0].x, r[1].x, r[2].x, r[0].y, r[1].y, r[2].y, r[0].z, r[1].z, r[2].z);
            },
            nb::arg("object"), nb::sig("def rotation(self, object: int) -> tuple[float, ...]"))
        .def(
            "attachments",
            [](PythonSimulator& self) {
                return self.use([](const Simulator& s) { return to_list(s.attachments()); });
            },
            nb::sig("def attachments(self) -> list[dict[str, typing.Any]]"))
        .def(
            "cavities",
            [](PythonSimulator& self) {
                return self.use([](const Simulator& s) { return to_list(s.cavities(), s); });
            },
            nb::sig("def cavities(self) -> list[dict[str, typing.Any]]"))
        .def("statistics", &statistics_of, nb::sig("def statistics(self) -> dict[str, typing.Any]"))
        .def(
            "save_checkpoint",
            [](PythonSimulator& self, const std::string& file) {
                self.use([&](const Simulator& s) { s.save_checkpoint(file); });
            },
            nb::arg("file"))
        .def(
            "load_checkpoint",
            [](PythonSimulator& self, const std::string& file, std::optional<int> frame) {
                self.use([&](Simulator& s) { s.load_checkpoint(file, frame); });
            },
            nb::arg("file"), nb::arg("frame") = nb::none());
    bind_changes(simulator);
    bind_picture(simulator);
    bind_recording(module, simulator);
}

}  // namespace gelatin::python
