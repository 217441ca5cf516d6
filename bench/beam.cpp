#include "bench/beam.h"

#include <algorithm>
#include <array>

#include "mesh/topology.h"
#include "model/assembly/build_model.h"
#include "model/springs/spring_cache.h"

namespace gelatin {
namespace {

const glm::dvec3 kSize(16.0, 4.0, 4.0);  // [m]
constexpr double kVolume = 16.0 * 4.0 * 4.0;
const glm::dvec3 kGravity(0.0, -9.0, 0.0);

// SOFA's repository, applications/plugins/SofaCUDA: SofaCUDA_benchmarks.csv.
constexpr PublishedRate kPublished[] = {{"tets", "Ryzen 3800X", 31.0},   {"tets", "i7-10750H", 29.8},
                                        {"tets", "RTX 2070", 357.0},     {"springs", "Ryzen 3800X", 112.0},
                                        {"springs", "i7-10750H", 108.0}, {"springs", "RTX 2070", 434.0}};

// Six tets for each cell (Kuhn's subdivision): one for each order in which a path from the cell's first
// corner to its last takes the three axes.
TetMesh make_grid(glm::ivec3 nodes, const glm::dvec3& size) {
    TetMesh mesh;
    const auto index = [&](glm::ivec3 n) {
        return static_cast<std::uint32_t>((n.x * nodes.y + n.y) * nodes.z + n.z);
    };
    const auto add_cell = [&](const glm::ivec3& first) {
        std::array<int, 3> axes{0, 1, 2};
        do {
            glm::ivec3 corner = first;
            glm::uvec4 tet(index(corner));
            for (int k = 0; k < 3; ++k) {
                ++corner[axes[k]];
                tet[k + 1] = index(corner);
            }
            if (tet_volume(mesh, tet) < 0.0) std::swap(tet.z, tet.w);
            mesh.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
    };
    const auto for_each = [](glm::ivec3 counts, const auto& work) {
        for (int x = 0; x < counts.x; ++x)
            for (int y = 0; y < counts.y; ++y)
                for (int z = 0; z < counts.z; ++z) work(glm::ivec3(x, y, z));
    };
    for_each(nodes,
             [&](glm::ivec3 n) { mesh.positions.push_back(size * (glm::dvec3(n) / glm::dvec3(nodes - 1))); });
    for_each(nodes - 1, add_cell);
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

}  // namespace

std::vector<BeamCase> beam_cases(glm::ivec3 nodes) {
    Body beam;
    beam.name = "beam";
    beam.mesh = make_grid(nodes, kSize);
    beam.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 1e-6}};
    beam.material.youngs_modulus = 2000.0;
    const auto make_model = [&] { return std::make_shared<const Model>(pack_bodies({beam}, {}, kGravity)); };
    beam.material.model = MaterialModel::neo_hookean;
    beam.material.poisson_ratio = 0.3;
    beam.material.damping = 0.1;
    beam.material.density = 50.0 / kVolume;
    const auto tets = make_model();
    beam.fitted = std::make_shared<const FittedSprings>(SpringCache().fit(beam.mesh));
    beam.material.model = MaterialModel::mass_spring;
    beam.material.poisson_ratio = 0.25;
    beam.material.damping = 0.0;
    beam.material.density = 100.0 / kVolume;
    return {{"tets", tets}, {"springs", make_model()}};
}

std::span<const PublishedRate> published_beam_rates() {
    return kPublished;
}

}  // namespace gelatin
