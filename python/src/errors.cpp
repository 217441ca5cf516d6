#include "errors.h"

#include <string>

#include "gelatin/error.h"

namespace gelatin::python {
namespace {

namespace nb = nanobind;

// Live as long as the process: the translator has nobody to give them back to.
struct Classes {
    PyObject* error = nullptr;
    PyObject* invalid_input = nullptr;
    PyObject* diverged = nullptr;
    PyObject* gl_error = nullptr;
    PyObject* no_open_gl = nullptr;
    PyObject* system_error = nullptr;
};
Classes classes;

PyObject* make_class(nb::module_& module, const char* name, nb::tuple bases, const char* doc) {
    const std::string full_name = std::string("gelatin.") + name;
    PyObject* made = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, bases.ptr(), nullptr);
    if (made == nullptr) nb::raise_python_error();
    module.attr(name) = nb::borrow(made);
    return made;
}

void raise(PyObject* type, const std::exception& error) {
    PyErr_SetString(type, error.what());
}

template <class SetAttributes>
void raise_with(PyObject* type, const std::exception& error, const SetAttributes& set) {
    nb::object object = nb::borrow(type)(error.what());
    set(object);
    PyErr_SetObject(type, object.ptr());
}

void translate(const std::exception_ptr& pointer, void* /*payload*/) {
    try {
        std::rethrow_exception(pointer);
    } catch (const InvalidInput& error) {
        raise_with(classes.invalid_input, error, [&](nb::object& object) {
            const InputProblem& problem = error.problem();
            object.attr("file") = problem.file;
            object.attr("line") = problem.line;
            object.attr("field") = problem.field;
            object.attr("value") = problem.value;
        });
    } catch (const Diverged& error) {
        raise_with(classes.diverged, error, [&](nb::object& object) {
            const Divergence& where = error.where();
            object.attr("step") = where.step;
            object.attr("frame") = where.frame;
            object.attr("time") = where.time;
            object.attr("object") = where.object;
            object.attr("node") = where.node;
        });
    } catch (const NoOpenGl& error) {
        raise(classes.no_open_gl, error);
    } catch (const GlError& error) {
        raise(classes.gl_error, error);
    } catch (const SystemError& error) {
        raise(classes.system_error, error);
    } catch (const Error& error) {
        raise(classes.error, error);
    }
}

}  // namespace

void bind_errors(nb::module_& module) {
    const auto builtin = [](PyObject* type) { return nb::borrow(type); };
    classes.error = make_class(module, "Error", nb::make_tuple(builtin(PyExc_Exception)),
                               "Base of every exception that Gelatin raises on purpose.");
    const nb::object base = nb::borrow(classes.error);
    classes.invalid_input =
        make_class(module, "InvalidInput", nb::make_tuple(base, builtin(PyExc_ValueError)),
                   "A scene, a file or a call is wrong. Attributes: file, line (0: none), field and value, "
                   "as far as known.");
    classes.diverged = make_class(
        module, "Diverged", nb::make_tuple(base, builtin(PyExc_ArithmeticError)),
        "The simulation produced numbers that are not finite, or energy without a cause. Attributes: "
        "step (0: unknown), frame, time [s], object, node.");
    classes.gl_error = make_class(module, "GlError", nb::make_tuple(base),
                                  "OpenGL failed; the text has the driver's messages.");
    classes.no_open_gl = make_class(module, "NoOpenGl", nb::make_tuple(nb::borrow(classes.gl_error)),
                                    "There is no OpenGL that Gelatin can use.");
    classes.system_error =
        make_class(module, "SystemError", nb::make_tuple(base, builtin(PyExc_OSError)),
                   "The operating system or a helper program failed: disk full, a program missing.");
    nb::register_exception_translator(translate);
}

}  // namespace gelatin::python
