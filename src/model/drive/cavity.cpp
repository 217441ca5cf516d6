#include "model/drive/cavity.h"

#include <algorithm>
#include <cmath>

namespace gelatin {

double Cavity::drive_at(double time, const std::optional<CavityGas>& set) const {
    const auto of_law = [&](const auto& from) {
        return gas.law == GasLaw::constant ? *from.pressure : *from.amount;
    };
    if (set) return of_law(*set);
    const std::vector<CavityKeyframe>& keys = gas.keyframes;
    if (keys.empty()) return gas.law == GasLaw::constant ? gas.pressure : gas.amount;
    const auto next =
        std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.time > time; });
    if (next == keys.begin()) return of_law(keys.front());
    const CavityKeyframe& last = *std::prev(next);
    if (next == keys.end()) return of_law(last);
    return std::lerp(of_law(last), of_law(*next), (time - last.time) / (next->time - last.time));
}

double Cavity::sealed(double drive) const {
    return drive * (gas.ambient + gas.pressure) * rest_volume;
}

double Cavity::pressure(double drive, double volume) const {
    return gas.law == GasLaw::constant ? drive : sealed(drive) / volume - gas.ambient;
}

double Cavity::stiffness(double drive, double volume) const {
    return gas.law == GasLaw::constant ? 0.0 : sealed(drive) / (volume * volume);
}

double Cavity::energy(double drive, double volume) const {
    if (gas.law == GasLaw::constant) return -drive * volume;
    return gas.ambient * (volume - rest_volume) - sealed(drive) * std::log(volume / rest_volume);
}

}  // namespace gelatin
