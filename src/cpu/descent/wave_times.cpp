#include "cpu/descent/wave_times.h"

#include <cmath>

namespace gelatin::cpu {

std::vector<double> wave_times(const Model& model) {
    std::vector<double> times;
    for (const ModelObject& object : model.bodies()) {
        double bulk = 0.0, volume = 0.0;
        for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t) {
            const TetRest& rest = model.tet_rests[t];
            bulk += static_cast<double>(rest.bulk) * static_cast<double>(rest.volume);
            volume += static_cast<double>(rest.volume);
        }
        times.push_back(std::cbrt(volume) * std::sqrt(object.mass / bulk));  // bulk is of the volume [J]
    }
    times.resize(model.objects.size());
    return times;
}

}  // namespace gelatin::cpu
