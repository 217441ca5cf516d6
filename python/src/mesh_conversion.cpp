#include <nanobind/ndarray.h>

#include <glm/vec4.hpp>
#include <limits>
#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "convert.h"

namespace gelatin::python {
namespace {

// Scene.meshes, of which Python knows nothing else.
struct HeldMeshes {
    std::shared_ptr<const SceneMeshes> meshes;
};

// An array of these numbers in a row, and of `columns` columns, which may be 1.
template <class Number>
using Rows = nb::ndarray<const Number, nb::c_contig, nb::device::cpu>;

template <class Number>
Rows<Number> rows_of(nb::handle source, const std::string& where, const char* type, std::size_t columns) {
    const nb::object numpy = nb::module_::import_("numpy");
    nb::object array = numpy.attr("asarray")(source);
    const auto size = nb::cast<std::size_t>(array.attr("size"));
    const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    const bool is_number = kind == "i" || kind == "u" || (kind == "f" && std::is_same_v<Number, double>);
    if (size > 0 && !is_number)
        raise_type_error(
            where, std::is_same_v<Number, double> ? "an array of numbers" : "an array of integers", source);
    if (size == 0) array = array.attr("reshape")(0, columns);
    if (columns == 1) array = array.attr("reshape")(-1, 1);
    const auto shape = nb::cast<nb::tuple>(array.attr("shape"));
    if (shape.size() != 2 || nb::cast<std::size_t>(shape[1]) != columns) {
        const auto text = nb::cast<std::string>(nb::str(shape));
        throw InvalidInput({{}, 0, where, text, "must have the shape (n, " + std::to_string(columns) + ")"});
    }
    return nb::cast<Rows<Number>>(numpy.attr("ascontiguousarray")(array, type));
}

template <class Vector>
std::vector<Vector> indices_of(nb::handle source, const std::string& where, std::size_t columns) {
    const Rows<std::int64_t> rows = rows_of<std::int64_t>(source, where, "int64", columns);
    std::vector<Vector> result(rows.shape(0));
    for (std::size_t r = 0; r < result.size(); ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            const std::int64_t index = rows.data()[r * columns + c];
            if (index < 0 || index > std::numeric_limits<std::uint32_t>::max()) {
                throw InvalidInput({{}, 0, where, std::to_string(index), "is not the index of a vertex"});
            }
            result[r][static_cast<int>(c)] = static_cast<std::uint32_t>(index);
        }
    }
    return result;
}

template <class Number>
nb::object array_of(std::vector<Number> numbers, std::size_t columns) {
    auto* const kept = new std::vector<Number>(std::move(numbers));
    const nb::capsule owner(
        kept, [](void* pointer) noexcept { delete static_cast<std::vector<Number>*>(pointer); });
    return nb::cast(
        nb::ndarray<nb::numpy, Number, nb::ndim<2>>(kept->data(), {kept->size() / columns, columns}, owner));
}

template <class Number, class Vector>
nb::object array_of(const std::vector<Vector>& vectors, int columns) {
    std::vector<Number> numbers;
    for (const Vector& vector : vectors)
        for (int c = 0; c < columns; ++c) numbers.push_back(vector[c]);
    return array_of(std::move(numbers), static_cast<std::size_t>(columns));
}

}  // namespace

void read(nb::handle source, const std::string& where, MeshShape& value) {
    if (!is_instance(source, &value)) raise_type_error(where, "a Mesh", source);
    auto mesh = std::make_shared<Mesh>();
    const Rows<double> vertices =
        rows_of<double>(source.attr("vertices"), joined(where, "vertices"), "float64", 3);
    for (std::size_t v = 0; v < vertices.shape(0); ++v) {
        const double* const xyz = vertices.data() + 3 * v;
        mesh->vertices.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
    mesh->triangles = indices_of<glm::uvec3>(source.attr("triangles"), joined(where, "triangles"), 3);
    mesh->tets = indices_of<glm::uvec4>(source.attr("tets"), joined(where, "tets"), 4);
    const Rows<std::int64_t> numbers =
        rows_of<std::int64_t>(source.attr("attributes"), joined(where, "attributes"), "int64", 1);
    for (std::size_t t = 0; t < numbers.shape(0); ++t)
        mesh->attributes.push_back(static_cast<int>(numbers.data()[t]));
    value.mesh = std::move(mesh);
}

nb::object to_python(const MeshShape& value) {
    const Mesh& mesh = *value.mesh;
    const nb::object attributes =
        array_of(std::vector<std::int32_t>(mesh.attributes.begin(), mesh.attributes.end()), 1);
    return class_named("Mesh")(array_of<double>(mesh.vertices, 3), array_of<std::uint32_t>(mesh.triangles, 3),
                               array_of<std::uint32_t>(mesh.tets, 4), attributes.attr("reshape")(-1));
}

void read(nb::handle source, const std::string& where, std::shared_ptr<const SceneMeshes>& value) {
    value = nullptr;
    if (source.is_none()) return;
    if (!nb::isinstance<HeldMeshes>(source))
        raise_type_error(where, "of a recording's scene, or None", source);
    value = nb::cast<const HeldMeshes&>(source).meshes;
}

nb::object to_python(const std::shared_ptr<const SceneMeshes>& value) {
    return value ? nb::cast(HeldMeshes{value}) : nb::none();
}

// In another process they are made again.
void bind_meshes(nb::module_& module) {
    nb::class_<HeldMeshes>(module, "SceneMeshes")
        .def("__copy__", [](nb::object self) { return self; })
        .def("__deepcopy__", [](nb::object self, nb::handle /*known*/) { return self; })
        .def(
            "__reduce__",
            [](nb::handle /*self*/) {
                return nb::make_tuple(nb::borrow(nb::none().type()), nb::make_tuple());
            },
            nb::sig("def __reduce__(self) -> tuple[object, ...]"));
}

}  // namespace gelatin::python
