#include "model/elasticity/wave_times.h"

#include <cmath>

namespace gelatin {

std::vector<double> wave_times(const Model& model) {
    std::vector<double> times;
    for (const ModelObject& body : model.bodies()) {
        double volume = 0.0, stiffness = 0.0;  // of bulk moduli, times volumes [J]
        for (std::uint32_t t = body.tets.first; t < body.tets.end(); ++t) {
            const TetRest& rest = model.tet_rests[t];
            volume += static_cast<double>(rest.volume);
            stiffness += static_cast<double>(rest.volume) * static_cast<double>(rest.bulk);
        }
        times.push_back(body.is_rigid ? 0.0 : std::cbrt(volume) * std::sqrt(body.mass / stiffness));
    }
    return times;
}

}  // namespace gelatin
