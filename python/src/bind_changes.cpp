#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "bindings.h"
#include "gelatin/error.h"
#include "python_simulator.h"
#include "scene_conversion.h"

namespace gelatin::python {
namespace {

using Values = nb::ndarray<const float, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Vertices = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Triple = std::array<double, 3>;
// Nodes, their arms, the stiffness of each, the target, the damping time.
using PullValues = std::tuple<std::vector<std::uint32_t>, std::vector<Triple>, double, Triple, double>;

static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));

std::span<const glm::vec3> vectors_of(const Values& values) {
    return {reinterpret_cast<const glm::vec3*>(values.data()), values.shape(0)};
}

glm::dvec3 vector_of(const Triple& triple) {
    return {triple[0], triple[1], triple[2]};
}

Pull pull_of(const PullValues& values) {
    const auto& [nodes, arms, stiffness, target, damping_time] = values;
    if (arms.size() != nodes.size()) throw InvalidInput("a pull must have an arm for each node");
    Pull pull;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        pull.nodes.push_back({nodes[n], glm::vec3(vector_of(arms[n])), static_cast<float>(stiffness)});
    pull.target = vector_of(target);
    pull.damping_time = damping_time;
    return pull;
}

using Setter = void (Simulator::*)(std::size_t, std::span<const glm::vec3>);
auto setter(Setter set) {
    return [set](PythonSimulator& self, std::size_t object, const Values& values) {
        self.use([&](Simulator& simulator) {
            const nb::gil_scoped_release released;
            (simulator.*set)(object, vectors_of(values));
        });
    };
}

// Makes a solver's tables, for seconds.
template <class Work>
void use_released(PythonSimulator& self, const Work& work) {
    self.use([&](Simulator& simulator) {
        const nb::gil_scoped_release released;
        work(simulator);
    });
}

}  // namespace

void bind_changes(nb::class_<PythonSimulator>& simulator) {
    simulator.def("set_positions", setter(&Simulator::set_positions), nb::arg("object"), nb::arg("positions"))
        .def("set_velocities", setter(&Simulator::set_velocities), nb::arg("object"), nb::arg("velocities"))
        .def("set_forces", setter(&Simulator::set_forces), nb::arg("object"), nb::arg("forces"))
        .def(
            "nodes_in",
            [](PythonSimulator& self, std::size_t object, nb::handle source) {
                const Region region = region_of(source);
                return self.use([&](Simulator& s) { return s.nodes_in(object, region); });
            },
            nb::arg("object"), nb::arg("region"))
        .def(
            "pin",
            [](PythonSimulator& self, std::size_t object, const std::vector<std::uint32_t>& nodes) {
                use_released(self, [&](Simulator& s) { s.pin(object, nodes); });
            },
            nb::arg("object"), nb::arg("nodes"))
        .def(
            "unpin",
            [](PythonSimulator& self, std::size_t object) {
                use_released(self, [&](Simulator& s) { s.unpin(object); });
            },
            nb::arg("object"))
        .def(
            "set_material",
            [](PythonSimulator& self, nb::handle source) {
                const Material material = material_of(source);
                use_released(self, [&](Simulator& s) { s.set_material(material); });
            },
            nb::arg("material"))
        .def(
            "attach",
            [](PythonSimulator& self, nb::handle source) {
                const AttachmentDescription attachment = attachment_of(source);
                std::size_t place = 0;
                use_released(self, [&](Simulator& s) { place = s.attach(attachment); });
                return place;
            },
            nb::arg("attachment"))
        .def("scene_attachments",
             [](PythonSimulator& self) {
                 return self.use([](const Simulator& s) { return python_attachments(s.scene()); });
             })
        .def(
            "detach",
            [](PythonSimulator& self, std::size_t attachment) {
                self.use([&](Simulator& s) { s.detach(attachment); });
            },
            nb::arg("attachment"))
        .def(
            "set_motor",
            [](PythonSimulator& self, std::size_t attachment, nb::handle source) {
                const JointMotor motor = motor_of(source);
                self.use([&](Simulator& s) { s.set_motor(attachment, motor); });
            },
            nb::arg("attachment"), nb::arg("motor"))
        .def(
            "set_collider_vertices",
            [](PythonSimulator& self, const std::string& collider, const Vertices& values) {
                const auto* const first = reinterpret_cast<const glm::dvec3*>(values.data());
                const std::vector<glm::dvec3> vertices(first, first + values.shape(0));
                self.use([&](Simulator& s) { s.set_collider_vertices(collider, vertices); });
            },
            nb::arg("collider"), nb::arg("vertices"))
        .def(
            "set_cavity",
            [](PythonSimulator& self, std::size_t cavity, nb::handle pressure, nb::handle amount) {
                const CavityGas gas = gas_of(pressure, amount);
                self.use([&](Simulator& s) { s.set_cavity(cavity, gas); });
            },
            nb::arg("cavity"), nb::arg("pressure").none(), nb::arg("amount").none())
        .def(
            "set_pulls",
            [](PythonSimulator& self, const std::vector<PullValues>& values) {
                std::vector<Pull> pulls;
                for (const PullValues& pull : values) pulls.push_back(pull_of(pull));
                self.use([&](Simulator& s) { s.set_pulls(std::move(pulls)); });
            },
            nb::arg("pulls"))
        .def(
            "move_pull",
            [](PythonSimulator& self, std::size_t pull, const Triple& target) {
                self.use([&](Simulator& s) { s.move_pull(pull, vector_of(target)); });
            },
            nb::arg("pull"), nb::arg("target"));
}

}  // namespace gelatin::python
