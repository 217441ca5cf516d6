#include "support/mixed_bodies.h"

#include <random>
#include <utility>

#include "support/test_models.h"

namespace gelatin::test {

Model make_mixed_bodies(double damping_time, double poisson_ratio, MaterialModel model_of_most, bool driven) {
    constexpr unsigned kSeed = 1;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    Material jelly;
    jelly.youngs_modulus = 2e4;
    jelly.damping = damping_time;
    jelly.model = model_of_most;
    jelly.poisson_ratio = poisson_ratio;
    std::vector<Body> bodies;
    const auto add = [&](glm::ivec3 cells, glm::dvec3 place) -> Body& {
        Body body = make_body(make_block(cells, 0.1 * glm::dvec3(cells), 0.2, kSeed), jelly);
        for (glm::dvec3& p : body.mesh.positions) p += place;
        body.velocity = {unit(random), unit(random), unit(random)};
        return bodies.emplace_back(std::move(body));
    };
    Body& large = add({5, 6, 7}, {0.0, 1.0, 0.0});
    if (driven) {
        large.loads = {{HalfSpaceRegion{{0.0, 1.0, 0.0}, 1.2}, ForceLoad{{500.0, 2000.0, 0.0}}},
                       {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01}, PressureLoad{2e3}}};
    }
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 1.05};
    Body& small = add({3, 2, 2}, {1.0, 1.0, 0.0});
    small.material.model = MaterialModel::mass_spring;
    if (driven) small.handles = {handle};
    add({4, 2, 2}, {0.0, 1.0, 1.0}).pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.05}};
    Body& landing = add({3, 3, 3}, {-1.0, -0.01, 0.0});
    landing.velocity = {2.0, -1.0, 0.5};
    landing.spin = {5.0, -20.0, 8.0};
    ColliderDescription floor, ball;
    floor.shape = PlaneCollider{};
    floor.friction = 0.2;
    floor.restitution = 0.9;
    ball.shape = SphereShape{0.3};
    ball.position = {-0.85, 0.4, 0.0};
    Model model = pack_bodies(bodies, {floor, ball}, {0.0, -9.81, 0.0});
    for (const std::size_t shaken : {0, 1}) {
        const Range& nodes = model.objects[shaken].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const float x = unit(random), y = unit(random), z = unit(random);
            model.positions[n] += 0.06f * glm::vec4(x, y, z, 0.0f);
        }
    }
    for (const HandleNode& held : model.handle_nodes) {
        if (!model.handles[held.handle].is_pin)
            model.velocities[held.node] += glm::vec4(0.5f, -1.0f, 0.7f, 0.0f);
    }
    return model;
}

}  // namespace gelatin::test
