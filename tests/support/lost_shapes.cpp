#include "support/lost_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "cpu/recovery/match_shapes.h"
#include "gpu/recovery/match_shapes.h"
#include "support/test_models.h"

namespace gelatin::test {

Model make_bodies_to_lose(double scale) {
    std::vector<Body> bodies;
    const auto add = [&](glm::ivec3 cells, glm::dvec3 size, glm::dvec3 place) -> Body& {
        Body body = make_body(make_block(cells, size, 0.2));
        for (glm::dvec3& p : body.mesh.positions) p = scale * (p + place);
        return bodies.emplace_back(std::move(body));
    };
    add({7, 6, 6}, {0.7, 0.6, 0.5}, {0.0, 0.0, 0.0});
    add({20, 1, 1}, {2.0, 0.1, 0.1}, {0.0, 1.0, 0.0});
    add({4, 3, 3}, {0.4, 0.3, 0.3}, {1.0, 0.0, 0.0}).pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 1.01 * scale}};
    add({3, 3, 3}, {0.3, 0.3, 0.3}, {1.0, 0.0, 1.0});
    return pack_bodies(bodies, {}, {0.0, 0.0, 0.0});
}

cpu::Nodes<float> lose_shapes(const Model& model, bool bar_is_lost, float scale) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    cpu::Nodes<float> nodes{model.positions, model.velocities};
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        for (std::uint32_t n = model.objects[o].nodes.first; n < model.objects[o].nodes.end(); ++n) {
            const float x = unit(random), y = unit(random), z = unit(random);
            const float u = unit(random), v = unit(random), w = unit(random);
            glm::vec4& p = nodes.positions[n];
            nodes.velocities[n] += scale * glm::vec4(u + 0.5f, v, w - p.x / scale, 0.0f);
            if (p.w == 0.0f) continue;
            p = glm::vec4(glm::vec3(p) / scale, p.w);
            if (o == 1 && !bar_is_lost) {
                const float angle = std::numbers::pi_v<float> * p.x, radius = 0.32f - (p.y - 1.05f);
                p = glm::vec4(radius * std::sin(angle), -radius * std::cos(angle), p.z, p.w);
            } else if (o == 3) {
                p.y = -p.y;
            } else {
                p = glm::vec4(0.5f * x + 0.3f, 0.4f * y, 0.4f * z, p.w);
            }
            p = glm::vec4(scale * glm::vec3(p), p.w);
        }
    }
    return nodes;
}

void match_on_gpu(const Model& model, std::vector<cpu::Nodes<float>>& runs) {
    gpu::ShapeMatcher matcher(model);
    for (cpu::Nodes<float>& run : runs) {
        const gpu::NodeBuffers nodes(run.positions, run.velocities);
        matcher.run(nodes, kElapsed);
        gl::barrier(gl::Barrier::buffer_update);
        nodes.positions.download(run.positions);
        nodes.velocities.download(run.velocities);
    }
}

double worst_matching_error(double scale) {
    const Model model = make_bodies_to_lose(scale);
    const auto factor = static_cast<float>(scale);
    std::vector<cpu::Nodes<float>> runs = {lose_shapes(model, true, factor),
                                           lose_shapes(model, false, factor)};
    std::vector<cpu::Nodes<double>> expected;
    for (const cpu::Nodes<float>& run : runs) {
        cpu::ShapeMatcher<double> matcher(std::make_shared<const Model>(model));
        matcher.run(expected.emplace_back(cpu::Nodes<double>{{run.positions.begin(), run.positions.end()},
                                                             {run.velocities.begin(), run.velocities.end()}}),
                    kElapsed);
    }
    match_on_gpu(model, runs);
    double worst = 0.0;
    const auto compare = [&](const glm::vec4& actual, const glm::dvec4& wanted, double bound) {
        const double error = glm::distance(glm::dvec4(actual), wanted) / bound;
        worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
    };
    for (std::size_t k = 0; k < runs.size(); ++k) {
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            compare(runs[k].positions[n], expected[k].positions[n], 1e-5 * scale);
            compare(runs[k].velocities[n], expected[k].velocities[n], 1e-4 * scale);
        }
    }
    return worst;
}

}  // namespace gelatin::test
