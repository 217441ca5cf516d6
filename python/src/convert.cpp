#include "convert.h"

namespace gelatin::python {
namespace {

template <class Vector>
void read_vector(nb::handle source, const std::string& where, const char* allowed, Vector& value) {
    const auto fail = [&] { raise_type_error(where, allowed, source); };
    if (nb::isinstance<nb::str>(source) || !PySequence_Check(source.ptr()) ||
        PySequence_Size(source.ptr()) != Vector::length()) {
        PyErr_Clear();
        fail();
    }
    for (int k = 0; k < Vector::length(); ++k) {
        const nb::object element = nb::steal(PySequence_GetItem(source.ptr(), k));
        read(element, where + "[" + std::to_string(k) + "]", value[k]);
    }
}

template <class Vector>
nb::object tuple_of(const Vector& value) {
    return nb::make_tuple(value.x, value.y, value.z);
}

}  // namespace

std::string joined(const std::string& where, const char* name) {
    return where.empty() ? name : where + "." + name;
}

std::string place_of(nb::handle element, const std::string& where, std::size_t index) {
    std::string name;
    if (where.ends_with('s') && nb::try_cast(nb::getattr(element, "name", nb::none()), name) && !name.empty())
        return where.substr(0, where.size() - 1) + "." + name;
    return where + "[" + std::to_string(index) + "]";
}

void raise_type_error(const std::string& where, const std::string& allowed, nb::handle source) {
    const auto shown =
        nb::cast<std::string>(nb::module_::import_("gelatin.arguments").attr("shown")(nb::borrow(source)));
    throw nb::type_error((where + " = " + shown + ": must be " + allowed).c_str());
}

std::string with_article(const std::string& name) {
    return (std::string("AEIO").find(name.front()) == std::string::npos ? "a " : "an ") + name;
}

nb::object class_named(const char* name) {
    return nb::module_::import_("gelatin").attr(name);
}

nb::object list_of(nb::handle source, const std::string& where) {
    if (nb::isinstance<nb::str>(source) || !nb::hasattr(source, "__iter__"))
        raise_type_error(where, "a list", source);
    return nb::list(nb::borrow(source));
}

void read(nb::handle source, const std::string& where, bool& value) {
    if (!nb::try_cast(source, value)) raise_type_error(where, "True or False", source);
}

void read(nb::handle source, const std::string& where, int& value) {
    const nb::object index = nb::steal(PyNumber_Index(source.ptr()));
    if (!index.is_valid()) {
        PyErr_Clear();
        raise_type_error(where, "an integer", source);
    }
    if (!nb::try_cast(index, value))
        throw InvalidInput({{}, 0, where, nb::cast<std::string>(nb::str(index)), "is too large"});
}

void read(nb::handle source, const std::string& where, double& value) {
    value = PyFloat_AsDouble(source.ptr());
    if (PyErr_Occurred() == nullptr) return;
    PyErr_Clear();
    raise_type_error(where, "a number", source);
}

void read(nb::handle source, const std::string& where, std::string& value) {
    if (!nb::try_cast(source, value)) raise_type_error(where, "a str", source);
}

void read(nb::handle source, const std::string& where, std::filesystem::path& value) {
    const nb::object text = nb::steal(PyOS_FSPath(source.ptr()));
    std::string path;
    if (!text.is_valid() || !nb::try_cast(text, path)) {
        PyErr_Clear();
        raise_type_error(where, "a path", source);
    }
    value = path;
}

void read(nb::handle source, const std::string& where, Automatic& value) {
    value.number.reset();
    std::string word;
    if (source.is_none() || (nb::try_cast(source, word) && word == "auto")) return;
    if (!PyIndex_Check(source.ptr())) raise_type_error(where, "\"auto\" or an integer", source);
    read(source, where, value.number.emplace());
}

void read(nb::handle source, const std::string& where, glm::dvec2& value) {
    read_vector(source, where, "two numbers", value);
}

void read(nb::handle source, const std::string& where, glm::dvec3& value) {
    read_vector(source, where, "three numbers", value);
}

void read(nb::handle source, const std::string& where, glm::ivec3& value) {
    read_vector(source, where, "three integers", value);
}

nb::object to_python(bool value) {
    return nb::bool_(value);
}
nb::object to_python(int value) {
    return nb::int_(value);
}
nb::object to_python(double value) {
    return nb::float_(value);
}
nb::object to_python(const std::string& value) {
    return nb::str(value.c_str(), value.size());
}
nb::object to_python(const std::filesystem::path& value) {
    return to_python(value.string());
}
nb::object to_python(const glm::dvec2& value) {
    return nb::make_tuple(value.x, value.y);
}
nb::object to_python(const glm::dvec3& value) {
    return tuple_of(value);
}
nb::object to_python(const glm::ivec3& value) {
    return tuple_of(value);
}
nb::object to_python(const Automatic& value) {
    return to_python(value.number);
}

}  // namespace gelatin::python
