#include "gpu/support/measure_on_gpu.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cpu/measure/measure.h"
#include "gpu/measure/measure.h"

namespace gelatin::test {

std::vector<ObjectMeasure> measure_on_gpu(const Model& model) {
    gpu::Measure stage(model);
    const gpu::ModelBuffers buffers(model);
    const gpu::NodeBuffers nodes(model.positions, model.velocities);
    stage.begin(buffers, nodes);
    return stage.end().objects;
}

double worst_energy_error(const Model& model, const std::vector<ObjectMeasure>& actual) {
    constexpr double kEps = std::numeric_limits<float>::epsilon();
    const std::vector<ObjectMeasure> expected =
        cpu::measure<double>(model, {{model.positions.begin(), model.positions.end()},
                                     {model.velocities.begin(), model.velocities.end()}});
    double worst = 0.0;
    for (std::size_t o = 0; o < expected.size(); ++o) {
        const Range& tets = model.objects[o].neo_hookean_tets;
        double bound = 1e-3 * expected[o].elastic_energy;  // springs, and the sums
        for (std::uint32_t t = tets.first; t < tets.end(); ++t) {
            const NeoHookeanTet& tet = model.neo_hookean_tets[t];
            bound +=
                16.0 * kEps * static_cast<double>(tet.gradient_1.w * (tet.gradient_2.w + tet.gradient_3.w));
        }
        for (std::uint32_t n = model.objects[o].nodes.first; n < model.objects[o].nodes.end(); ++n) {
            if (model.volume_term.is_empty()) break;
            const glm::dvec2 rest(model.volume_term.nodes[n]);
            bound += 16.0 * kEps * rest.x * std::abs(rest.y);
        }
        const double error = std::abs(actual[o].elastic_energy - expected[o].elastic_energy) / bound;
        if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, error);
    }
    return worst;
}

}  // namespace gelatin::test
