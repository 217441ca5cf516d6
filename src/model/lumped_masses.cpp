#include "model/lumped_masses.h"

namespace gelatin {
namespace {

template <class Counts>
std::vector<double> sum_masses(const Model& model, const Counts& counts) {
    std::vector<double> masses;
    for (const ModelObject& object : model.objects) {
        double& mass = masses.emplace_back(0.0);
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
            if (counts(n)) mass += static_cast<double>(model.masses[n]);
    }
    return masses;
}

}  // namespace

std::vector<double> lumped_masses(const Model& model) {
    return sum_masses(model, [](std::uint32_t) { return true; });
}

std::vector<double> free_lumped_masses(const Model& model) {
    return sum_masses(model, [&](std::uint32_t n) { return model.positions[n].w > 0.0f; });
}

}  // namespace gelatin
