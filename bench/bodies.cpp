#include "bench/bodies.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/shapes.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

constexpr double kInnerRadius = 0.8;  // of the outer one

// A multiple of 2^-32 in [-1, 1), the same for every standard library, whose distributions differ.
double next_offset(std::mt19937& random) {
    return static_cast<double>(random()) * 0x1p-31 - 1.0;
}

}  // namespace

TetMesh make_hollow_ball(double radius, int frequency) {
    const SurfaceMesh sphere = make_sphere({radius, frequency});
    const auto count = static_cast<std::uint32_t>(sphere.positions.size());
    TetMesh mesh;
    mesh.positions = sphere.positions;
    for (const glm::dvec3& p : sphere.positions) mesh.positions.push_back(kInnerRadius * p);
    for (glm::uvec3 f : sphere.faces) {
        mesh.faces.push_back(f);
        mesh.faces.emplace_back(f.x + count, f.z + count, f.y + count);
        // With its corners in ascending order, a prism divides its sides in the same way as its neighbours.
        std::sort(&f[0], &f[0] + 3);
        const glm::uvec3 inner = f + count;
        for (glm::uvec4 tet : {glm::uvec4(f.x, f.y, f.z, inner.z), glm::uvec4(f.x, f.y, inner.y, inner.z),
                               glm::uvec4(f.x, inner.x, inner.y, inner.z)}) {
            if (tet_volume(mesh, tet) < 0.0) std::swap(tet.z, tet.w);
            mesh.tets.push_back(tet);
        }
    }
    return mesh;
}

std::shared_ptr<const Model> make_copies(const Body& body, const std::vector<glm::dvec3>& places) {
    std::vector<Body> bodies(places.size(), body);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        bodies[b].name = "body " + std::to_string(b);
        for (glm::dvec3& p : bodies[b].mesh.positions) p += places[b];
    }
    return std::make_shared<const Model>(pack_bodies(bodies, {}, glm::dvec3(0.0)));
}

std::shared_ptr<const Model> make_copies(const TetMesh& mesh, const std::vector<glm::dvec3>& places) {
    Body body;
    body.mesh = mesh;
    body.material.springs = SpringKinds{};
    return make_copies(body, places);
}

std::vector<glm::dvec3> jittered_lattice(std::size_t count, double spacing, double jitter) {
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count)) - 1e-9));
    std::mt19937 random(1);
    std::vector<glm::dvec3> places;
    for (std::size_t n = 0; n < count; ++n) {
        const glm::dvec3 cell(n % side, n / side % side, n / side / side);
        const double x = next_offset(random), y = next_offset(random), z = next_offset(random);
        places.push_back(spacing * cell + jitter * glm::dvec3(x, y, z));
    }
    return places;
}

}  // namespace gelatin
