#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "gelatin/error.h"
#include "model/scene/value_text.h"
#include "names.h"
#include "scene_fields.h"

namespace gelatin::python {

namespace nb = nanobind;

using FramesInMemory = decltype(AnimationFrames::frames);

/// A value of a scene from Python.
/// @param where for messages: "object.ball.position"; empty for the scene itself
/// @throws nanobind's TypeError for a value of another type; InvalidInput for a word that is not allowed
void read(nb::handle source, const std::string& where, bool& value);
void read(nb::handle source, const std::string& where, int& value);
void read(nb::handle source, const std::string& where, double& value);
void read(nb::handle source, const std::string& where, std::string& value);
void read(nb::handle source, const std::string& where, std::filesystem::path& value);
void read(nb::handle source, const std::string& where, glm::dvec2& value);
void read(nb::handle source, const std::string& where, glm::dvec3& value);
void read(nb::handle source, const std::string& where, glm::ivec3& value);
void read(nb::handle source, const std::string& where, Automatic& value);
void read(nb::handle source, const std::string& where, MeshShape& value);  // mesh_conversion.cpp
void read(nb::handle source, const std::string& where, std::shared_ptr<const SceneMeshes>& value);
// animation_conversion.cpp
void read(nb::handle source, const std::string& where, FramesInMemory& value);
void read(nb::handle source, const std::string& where, HandleDescription& value);

nb::object to_python(bool value);
nb::object to_python(int value);
nb::object to_python(double value);
nb::object to_python(const std::string& value);
nb::object to_python(const std::filesystem::path& value);
nb::object to_python(const glm::dvec2& value);
nb::object to_python(const glm::dvec3& value);
nb::object to_python(const glm::ivec3& value);
nb::object to_python(const Automatic& value);
nb::object to_python(const MeshShape& value);
nb::object to_python(const std::shared_ptr<const SceneMeshes>& value);
nb::object to_python(const FramesInMemory& value);

/// "object.ball"
std::string joined(const std::string& where, const char* name);
/// "object.ball": an element of `objects` goes by its name if it has one, otherwise "pins[1]".
std::string place_of(nb::handle element, const std::string& where, std::size_t index);

/// Raises "WHERE = SOURCE: must be ALLOWED". A source whose text is long goes by its type.
[[noreturn]] void raise_type_error(const std::string& where, const std::string& allowed, nb::handle source);

/// "a Mesh", "an Animation"
std::string with_article(const std::string& name);

/// A class of the package `gelatin`.
nb::object class_named(const char* name);

/// The elements of any iterable of Python but a string.
nb::object list_of(nb::handle source, const std::string& where);

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsVariant : std::false_type {};
template <class... Kinds>
struct IsVariant<std::variant<Kinds...>> : std::true_type {};

/// Python's None is what a variant has that holds nothing.
inline bool is_instance(nb::handle source, std::monostate* /*type*/) {
    return source.is_none();
}
inline std::string class_names(std::monostate* /*type*/) {
    return "None";
}
inline void read(nb::handle /*source*/, const std::string& /*where*/, std::monostate& /*value*/) {}
inline nb::object to_python(std::monostate /*value*/) {
    return nb::none();
}

/// Whether a Python object is of the class, or one of the classes, that a C++ type stands for.
template <class T>
bool is_instance(nb::handle source, T* /*type*/) {
    return nb::isinstance(source, class_named(Fields<T>::kClass));
}
template <class... Kinds>
bool is_instance(nb::handle source, std::variant<Kinds...>* /*type*/) {
    return (is_instance(source, static_cast<Kinds*>(nullptr)) || ...);
}

/// "Sphere, Box": the classes that a variant may hold.
template <class T>
std::string class_names(T* /*type*/) {
    return Fields<T>::kClass;
}
template <class... Kinds>
std::string class_names(std::variant<Kinds...>* /*type*/) {
    std::string names;
    ((names += (names.empty() ? "" : ", ") + class_names(static_cast<Kinds*>(nullptr))), ...);
    return names;
}

template <class T>
void read(nb::handle source, const std::string& where, T& value);

template <class... Kinds>
void read_variant(nb::handle source, const std::string& where, std::variant<Kinds...>& value) {
    const auto try_kind = [&](auto* kind) {
        using Kind = std::remove_pointer_t<decltype(kind)>;
        if (!is_instance(source, kind)) return false;
        Kind content{};
        read(source, where, content);
        value = std::move(content);
        return true;
    };
    if ((try_kind(static_cast<Kinds*>(nullptr)) || ...)) return;
    raise_type_error(where, "one of " + class_names(&value), source);
}

template <class Enum>
void read_word(nb::handle source, const std::string& where, Enum& value) {
    std::string word, allowed;
    read(source, where, word);
    for (const auto& [name, meaning] : Names<Enum>::kAll) {
        if (word == name) {
            value = meaning;
            return;
        }
        allowed += (allowed.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    }
    throw InvalidInput({{}, 0, where, text_of(word), "must be one of " + allowed});
}

template <class T>
void read(nb::handle source, const std::string& where, T& value) {
    if constexpr (IsOptional<T>::value) {
        value.reset();
        if (!source.is_none()) read(source, where, value.emplace());
    } else if constexpr (IsVector<T>::value) {
        value.clear();
        for (nb::handle element : list_of(source, where)) {
            const std::string place = place_of(element, where, value.size());
            read(element, place, value.emplace_back());
        }
    } else if constexpr (IsVariant<T>::value) {
        read_variant(source, where, value);
    } else if constexpr (std::is_enum_v<T>) {
        read_word(source, where, value);
    } else {
        static_assert(HasFields<T>);
        if (!is_instance(source, &value))
            raise_type_error(where.empty() ? "scene" : where, with_article(class_names(&value)), source);
        Fields<T>::visit(value, [&](const char* name, auto& member) {
            read(nb::getattr(source, name), joined(where, name), member);
        });
    }
}

template <class T>
nb::object to_python(const T& value) {
    if constexpr (IsOptional<T>::value) {
        return value ? to_python(*value) : nb::none();
    } else if constexpr (IsVector<T>::value) {
        nb::list list;
        for (const auto& element : value) list.append(to_python(element));
        return list;
    } else if constexpr (IsVariant<T>::value) {
        return std::visit([](const auto& content) { return to_python(content); }, value);
    } else if constexpr (std::is_enum_v<T>) {
        for (const auto& [name, meaning] : Names<T>::kAll)
            if (meaning == value) return nb::str(name);
        return nb::none();
    } else {
        static_assert(HasFields<T>);
        T copy = value;
        nb::dict fields;
        Fields<T>::visit(copy, [&](const char* name, auto& member) { fields[name] = to_python(member); });
        return class_named(Fields<T>::kClass)(**fields);
    }
}

}  // namespace gelatin::python
