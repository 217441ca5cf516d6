// What moves vertices and nodes: frames in memory, from and to arrays, and handles.
#include <nanobind/ndarray.h>

#include "convert.h"

namespace gelatin::python {

void read(nb::handle source, const std::string& where, FramesInMemory& value) {
    using FrameArray = nb::ndarray<const double, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;
    const nb::object vectors = nb::module_::import_("gelatin.arguments").attr("vectors");
    const auto array = nb::cast<FrameArray>(vectors(where, nb::borrow(source), "frames", "vertices"));
    std::vector<std::vector<glm::dvec3>> frames(array.shape(0));
    const double* xyz = array.data();
    for (std::vector<glm::dvec3>& frame : frames) {
        frame.reserve(array.shape(1));
        for (std::size_t v = 0; v < array.shape(1); ++v, xyz += 3) frame.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
    value = std::make_shared<const std::vector<std::vector<glm::dvec3>>>(std::move(frames));
}

// All frames are of one size, as read above: scenes in files have none.
nb::object to_python(const FramesInMemory& value) {
    auto* const kept = new std::vector<double>;
    const nb::capsule owner(
        kept, [](void* pointer) noexcept { delete static_cast<std::vector<double>*>(pointer); });
    const std::size_t frames = value ? value->size() : 0, vertices = frames > 0 ? value->front().size() : 0;
    for (std::size_t f = 0; f < frames; ++f)
        for (const glm::dvec3& p : (*value)[f]) kept->insert(kept->end(), {p.x, p.y, p.z});
    return nb::cast(nb::ndarray<nb::numpy, double, nb::ndim<3>>(kept->data(), {frames, vertices, 3}, owner));
}

void read(nb::handle source, const std::string& where, HandleDescription& value) {
    read<HandleDescription>(source, where, value);
    const bool has_region = !source.attr("region").is_none();
    if (has_region == value.skeleton.has_value())
        throw InvalidInput(
            {{},
             0,
             where,
             {},
             std::string("must have exactly one of region or skeleton") + (has_region ? ", has both" : "")});
}

}  // namespace gelatin::python
