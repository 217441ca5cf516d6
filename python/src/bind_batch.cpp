#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <exception>
#include <memory>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "gelatin/batch.h"
#include "gelatin/error.h"
#include "python_simulator.h"
#include "scene_conversion.h"

namespace gelatin::python {
namespace {

Batch make_batch(nb::handle source, std::int64_t worlds) {
    if (worlds < 1) throw InvalidInput({{}, 0, "worlds", std::to_string(worlds), "must be 1 or more"});
    const Scene scene = scene_of(source);
    const MessagesAtEnd messages;
    const nb::gil_scoped_release released;
    return Batch(scene, static_cast<std::size_t>(worlds));
}

class PythonBatch {
public:
    PythonBatch(nb::handle scene, std::int64_t worlds) : batch_(make_batch(scene, worlds)) {}

    std::size_t size() const { return batch_.size(); }

    void step(std::int64_t count) {
        if (count < 0) throw InvalidInput({{}, 0, "count", std::to_string(count), "must be 0 or more"});
        const std::unique_lock<std::mutex> lock = turn_.take();
        std::exception_ptr diverged;
        make_in_pieces(count, [&](std::int64_t steps) {
            try {
                batch_.step(static_cast<std::size_t>(steps));
            } catch (const Diverged&) {  // the other worlds go on, however long the pieces are
                if (!diverged) diverged = std::current_exception();
            }
        });
        if (diverged) std::rethrow_exception(diverged);
    }

    void reset(const std::vector<std::uint8_t>& mask) {
        const MessagesAtEnd messages;
        const std::unique_lock<std::mutex> lock = turn_.take();
        const nb::gil_scoped_release released;
        batch_.reset(mask);
    }

    std::vector<bool> diverged() const { return {batch_.diverged().begin(), batch_.diverged().end()}; }

    std::unique_ptr<PythonSimulator> world(std::size_t index) {
        return std::make_unique<PythonSimulator>(batch_[index], turn_, nb::find(*this));
    }

private:
    Batch batch_;
    Turn turn_;
};

}  // namespace

void bind_batch(nb::module_& module) {
    nb::class_<PythonBatch>(module, "Batch")
        .def(nb::init<nb::handle, std::int64_t>(), nb::arg("scene").none(), nb::arg("worlds"))
        .def("__len__", &PythonBatch::size)
        .def("step", &PythonBatch::step, nb::arg("count"))
        .def("reset", &PythonBatch::reset, nb::arg("mask"))
        .def("diverged", &PythonBatch::diverged)
        .def("world", &PythonBatch::world, nb::arg("index"));
}

}  // namespace gelatin::python
