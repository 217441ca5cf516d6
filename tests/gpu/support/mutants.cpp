#include "gpu/support/mutants.h"

#include <fmt/core.h>

#include <stdexcept>
#include <string_view>

namespace gelatin::test {
namespace {

std::string broken_text(const Mutant& mutant) {
    std::string text = gl::shader_text(mutant.file);
    const std::string_view from = mutant.from;
    const std::size_t at = text.find(from);
    if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
        throw std::runtime_error(fmt::format("{}: {} has {} of: {}", mutant.name, mutant.file,
                                             at == std::string::npos ? "none" : "more than one", from));
    }
    return text.replace(at, from.size(), mutant.to);
}

}  // namespace

BrokenShader::BrokenShader(const Mutant& mutant) : override_(mutant.file, broken_text(mutant)) {}

std::vector<MutantCase> cases(std::span<const Mutant> mutants, const Scenarios& scenarios) {
    std::vector<MutantCase> cases;
    for (const Mutant& mutant : mutants) cases.push_back({mutant, scenarios});
    return cases;
}

}  // namespace gelatin::test
