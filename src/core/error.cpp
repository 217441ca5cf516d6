#include "gelatin/error.h"

#include <utility>

namespace gelatin {
namespace {

// "file:line: field = value: problem", with the parts that are known.
std::string describe(const InputProblem& p) {
    std::string text;
    if (!p.file.empty()) {
        text += p.file;
        if (p.line > 0) text += ":" + std::to_string(p.line);
        text += ": ";
    }
    if (!p.field.empty()) {
        text += p.field;
        if (!p.value.empty()) text += " = " + p.value;
        text += ": ";
    }
    return text + p.problem;
}

}  // namespace

InvalidInput::InvalidInput(InputProblem problem) : Error(describe(problem)), problem_(std::move(problem)) {}

}  // namespace gelatin
