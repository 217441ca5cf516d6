#include "errors.h"

#include "convert.h"
#include "gelatin/error.h"

namespace gelatin::python {
namespace {

nb::object exception_of(const char* name, const std::exception& error) {
    return class_named(name)(error.what());
}

void raise(const nb::object& exception) {
    PyErr_SetObject(exception.type().ptr(), exception.ptr());
}

void translate(const std::exception_ptr& pointer, void* /*payload*/) {
    try {
        std::rethrow_exception(pointer);
    } catch (const InvalidInput& error) {
        nb::object exception = exception_of("InvalidInput", error);
        const InputProblem& problem = error.problem();
        exception.attr("file") = problem.file;
        exception.attr("line") = problem.line;
        exception.attr("field") = problem.field;
        exception.attr("value") = problem.value;
        raise(exception);
    } catch (const Diverged& error) {
        nb::object exception = exception_of("Diverged", error);
        const Divergence& where = error.where();
        exception.attr("step") = where.step;
        exception.attr("frame") = where.frame;
        exception.attr("time") = where.time;
        exception.attr("object") = where.object;
        exception.attr("node") = where.node;
        raise(exception);
    } catch (const NoOpenGl& error) {
        raise(exception_of("NoOpenGl", error));
    } catch (const GlError& error) {
        raise(exception_of("GlError", error));
    } catch (const SystemError& error) {
        raise(exception_of("SystemError", error));
    } catch (const Error& error) {
        raise(exception_of("Error", error));
    }
}

}  // namespace

void translate_errors() {
    nb::register_exception_translator(translate);
}

}  // namespace gelatin::python
