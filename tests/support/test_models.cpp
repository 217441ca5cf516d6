#include "support/test_models.h"

#include <cmath>
#include <random>

#include "mesh/topology.h"
#include "model/spring_packing.h"
#include "support/draw_vector.h"

namespace gelatin::test {

TetMesh make_block(glm::ivec3 cells, glm::dvec3 size, double jitter, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offset(-jitter, jitter);
    const glm::dvec3 cell = size / glm::dvec3(cells);
    TetMesh mesh;
    for (int z = 0; z <= cells.z; ++z) {
        for (int y = 0; y <= cells.y; ++y) {
            for (int x = 0; x <= cells.x; ++x) {
                const bool inner = x > 0 && y > 0 && z > 0 && x < cells.x && y < cells.y && z < cells.z;
                const glm::dvec3 move = inner ? draw_vector<glm::dvec3>(offset, random) : glm::dvec3(0);
                mesh.positions.push_back((glm::dvec3(x, y, z) + move) * cell);
            }
        }
    }
    const auto index = [&](int x, int y, int z) {
        return static_cast<std::uint32_t>((z * (cells.y + 1) + y) * (cells.x + 1) + x);
    };
    // Kuhn's subdivision: one tet for each order in which a path from corner to corner takes the three axes.
    constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int z = 0; z < cells.z; ++z) {
        for (int y = 0; y < cells.y; ++y) {
            for (int x = 0; x < cells.x; ++x) {
                for (int o = 0; o < 6; ++o) {
                    glm::ivec3 corner(x, y, z);
                    glm::uvec4 tet;
                    tet[0] = index(corner.x, corner.y, corner.z);
                    for (int k = 0; k < 3; ++k) {
                        ++corner[kOrders[o][k]];
                        tet[k + 1] = index(corner.x, corner.y, corner.z);
                    }
                    if (o >= 3) std::swap(tet[2], tet[3]);
                    mesh.tets.push_back(tet);
                }
            }
        }
    }
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

TetMesh without(const TetMesh& mesh, const std::function<bool(const glm::dvec3&)>& leaves_out) {
    TetMesh rest;
    std::vector<std::uint32_t> numbers(mesh.positions.size(), kNoNode);
    for (const glm::uvec4& tet : mesh.tets) {
        glm::dvec3 middle(0.0);
        for (int k = 0; k < 4; ++k) middle += 0.25 * mesh.positions[tet[k]];
        if (leaves_out(middle)) continue;
        glm::uvec4 kept;
        for (int k = 0; k < 4; ++k) {
            std::uint32_t& number = numbers[tet[k]];
            if (number == kNoNode) {
                number = static_cast<std::uint32_t>(rest.positions.size());
                rest.positions.push_back(mesh.positions[tet[k]]);
            }
            kept[k] = number;
        }
        rest.tets.push_back(kept);
    }
    rest.faces = boundary_faces(rest.tets);
    return rest;
}

Material structural_material() {
    Material material;
    material.springs = SpringKinds{};
    return material;
}

Body make_body(TetMesh mesh, const Material& material) {
    Body body;
    body.name = "body";
    body.mesh = std::move(mesh);
    body.material = material;
    return body;
}

Model make_model(const Body& body, glm::dvec3 gravity) {
    return pack_bodies({body}, {}, gravity);
}

namespace {

Body lively_body(unsigned seed) {
    Material material;
    material.damping = 2e-3;
    material.springs = SpringKinds{true, true, true};
    Body body = make_body(make_block({9, 10, 10}, {0.9, 1.0, 1.0}, 0.2, seed), material);
    for (glm::dvec3& p : body.mesh.positions) p += glm::dvec3(0.4, -0.02, -0.3);
    body.pins = {HalfSpaceRegion{{-1.0, 0.0, 0.0}, -1.29}};
    return body;
}

Model enlivened(const Body& body, unsigned seed) {
    ColliderDescription sphere;
    sphere.shape = SphereShape{0.3};
    sphere.position = {0.3, 0.5, 0.2};
    Model model = pack_bodies({body}, {ColliderDescription{}, sphere}, {0.0, -9.81, 0.0});

    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        if (model.positions[n].w == 0.0f) continue;
        for (int k = 0; k < 3; ++k) {
            model.positions[n][k] += 0.01f * normal(random);
            model.velocities[n][k] += normal(random);
        }
    }
    for (const HandleNode& held : model.handle_nodes) {
        if (model.handles[held.handle].is_pin) continue;
        for (int k = 0; k < 3; ++k) model.velocities[held.node][k] = normal(random);
    }
    return model;
}

}  // namespace

Model make_lively_model(unsigned seed) {
    return enlivened(lively_body(seed), seed);
}

Model make_driven_model(unsigned seed) {
    Body body = lively_body(seed);
    HandleDescription top, bottom;
    top.region = HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.97};
    top.keyframes = {{0.0}, {0.5, {0.1, 0.2, -0.3}, {100.0, -40.0, 720.0}, 1.5}, {2.0}};
    bottom.region = BoxRegion{{0.39, -0.1, -0.4}, {0.7, -0.01, 0.1}};
    bottom.pivot = {1.0, 2.0, -0.5};
    bottom.interpolation = Interpolation::smooth;
    bottom.release = 1.0;
    bottom.keyframes = {{0.2}, {1.5, {-0.5, 0.0, 0.0}, {0.0, 90.0, 0.0}, 0.7}};
    body.handles = {top, bottom};
    const Region left = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.41}, half = HalfSpaceRegion{{0.0, 0.0, 1.0}, 0.2};
    body.loads = {{left, PressureLoad{3e5}},
                  {half, ForceLoad{{8e5, 4e5, -2e5}}},
                  {half, TractionLoad{{-1e5, 2e5, 5e4}}},
                  {left, ForceLoad{{0.0, 3e4, 0.0}}}};
    body.pins.clear();
    return enlivened(body, seed);
}

Model make_lively_tets(double damping_time, unsigned seed) {
    Material springs = structural_material(), tets;
    tets.model = MaterialModel::neo_hookean;
    tets.poisson_ratio = 0.4;
    springs.poisson_ratio = 0.3;
    springs.damping = tets.damping = damping_time;
    // Of 150 nodes, so that SIMD has nodes of both in one group.
    Body one = make_body(make_block({4, 5, 4}, {0.4, 0.5, 0.4}, 0.2, seed), springs),
         two = make_body(make_block({8, 7, 7}, {0.8, 0.7, 0.7}, 0.2, seed), tets);
    for (glm::dvec3& p : one.mesh.positions) p += glm::dvec3(1.0, -0.02, 0.0);
    for (glm::dvec3& p : two.mesh.positions) p.y -= 0.02;
    two.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.05}};
    Model model = pack_bodies({one, two}, {ColliderDescription{}}, {0.0, -9.81, 0.0});

    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        if (model.positions[n].w == 0.0f) continue;
        for (int k = 0; k < 3; ++k) {
            model.positions[n][k] += 0.03f * normal(random);
            model.velocities[n][k] += normal(random);
        }
    }
    return model;
}

Model make_model(const Net& net) {
    Model model;
    for (std::size_t n = 0; n < net.positions.size(); ++n) {
        const double mass = net.masses[n];
        model.positions.emplace_back(glm::vec3(net.positions[n]),
                                     std::isinf(mass) ? 0.0f : static_cast<float>(1.0 / mass));
        model.velocities.emplace_back(glm::vec3(net.velocities[n]), static_cast<float>(net.damping_time));
        model.masses.push_back(static_cast<float>(mass));
    }
    model.springs = net.springs;
    model.colliders = net.colliders;
    model.gravity = glm::vec3(net.gravity);
    ModelObject object;
    object.name = "net";
    object.nodes = {0, model.node_count()};
    object.springs = {0, static_cast<std::uint32_t>(model.springs.size())};
    object.rest_volume = 1.0;
    model.objects.push_back(object);
    model.node_objects = objects_of_nodes(model);
    model.half_springs = pack_half_springs(model.node_count(), model.springs);
    model.incidence = make_incidence(model.node_count(), model.springs);
    return model;
}

Net make_oscillator(double stiffness, double rest_length, double stretch) {
    Net net;
    const double half = 0.5 * (rest_length + stretch);
    net.positions = {{-half, 0.0, 0.0}, {half, 0.0, 0.0}};
    net.velocities = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    net.masses = {1.0, 1.0};
    net.springs = {{0, 1, static_cast<float>(rest_length), static_cast<float>(stiffness)}};
    return net;
}

}  // namespace gelatin::test
