#pragma once

namespace gelatin::python {

/// The name of a struct's Python class, and its fields by the names of that class' attributes. The structured
/// bindings do not compile when scene.h has a field that is missing here.
template <class Struct>
struct Fields;

template <class Struct>
concept HasFields = requires {
    Fields<Struct>::kClass;
};

}  // namespace gelatin::python
