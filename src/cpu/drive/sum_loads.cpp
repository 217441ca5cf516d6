#include "cpu/drive/sum_loads.h"

#include <tbb/parallel_for.h>

#include <glm/geometric.hpp>

namespace gelatin::cpu {

template <class Real>
void sum_loads(const Loads& loads, std::span<const float> factors, const std::vector<Vec4<Real>>& positions,
               std::vector<Vec4<Real>>& forces) {
    tbb::parallel_for(std::size_t(0), loads.nodes.size(), [&](std::size_t k) {
        const LoadedNode& loaded = loads.nodes[k];
        const Vec3<Real> position(positions[loaded.node]);
        Vec3<Real> sum(0);
        for (std::uint32_t e = loaded.first; e < loaded.end; ++e) {
            const NodeLoad& load = loads.entries[e];
            const Vec3<Real> twice_area = glm::cross(Vec3<Real>(positions[load.b]) - position,
                                                     Vec3<Real>(positions[load.c]) - position);
            sum += static_cast<Real>(factors[load.load]) *
                   (Vec3<Real>(load.force) - static_cast<Real>(load.force.w) * twice_area);
        }
        forces[loaded.node] = Vec4<Real>(sum, 0);
    });
}

template void sum_loads<float>(const Loads&, std::span<const float>, const std::vector<Vec4<float>>&,
                               std::vector<Vec4<float>>&);
template void sum_loads<double>(const Loads&, std::span<const float>, const std::vector<Vec4<double>>&,
                                std::vector<Vec4<double>>&);

}  // namespace gelatin::cpu
