#include "gpu/support/skin_on_gpu.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "gpu/support/scenario.h"
#include "gpu/view/carry_skin.h"
#include "support/parity.h"
#include "support/random_maker.h"

namespace gelatin::test {
namespace {

constexpr int kNodes = 300, kPoints = 1234;

std::vector<SkinPoint> random_points(RandomMaker& random) {
    std::vector<SkinPoint> points;
    for (int p = 0; p < kPoints; ++p) {
        const auto node = [&] { return static_cast<std::uint32_t>(random.integer(0, kNodes - 1)); };
        const glm::dvec3 w = random.point(1.5);
        SkinPoint point{node(), node(), node(), node(), glm::vec4(1.0 - w.x - w.y - w.z, w)};
        if (p % 10 == 1) point = {point.a, point.a, point.a, point.a, {1.0f, 0.0f, 0.0f, 0.0f}};
        if (p % 10 == 2) point.d = point.c;
        points.push_back(point);
    }
    return points;
}

double error_over_bound(const SkinPoint& point, const std::vector<glm::vec4>& nodes,
                        const glm::vec4& actual) {
    constexpr double kSkinEps = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
    const auto at = [&](std::uint32_t node) { return glm::dvec3(nodes[node]); };
    const glm::dvec3 a = at(point.a), b = at(point.b) - a, c = at(point.c) - a, d = at(point.d) - a;
    const glm::dvec4 w(point.weights);
    const glm::dvec3 expected = a + w.y * b + w.z * c + w.w * d;
    const glm::dvec3 parts = glm::abs(w.y * b) + glm::abs(w.z * c) + glm::abs(w.w * d);
    double worst = error_if(actual.w != 1.0f);
    for (int k = 0; k < 3; ++k) {
        const double bound = 1.01 * kSkinEps * (std::abs(expected[k]) + 8.0 * parts[k]);
        const double error = std::abs(static_cast<double>(actual[k]) - expected[k]);
        worst = std::max(worst, error <= bound ? error / bound : error_if(true));
    }
    return worst;
}

}  // namespace

double carry_skin_error(double distance) {
    RandomMaker random(11);
    std::vector<glm::vec4> nodes;
    for (int n = 0; n < kNodes; ++n)
        nodes.emplace_back(glm::vec3(glm::dvec3(distance, -distance, 0.5 * distance) + random.point(0.1)),
                           7.0f);
    const std::vector<SkinPoint> points = random_points(random);
    const gl::Buffer<glm::vec4> node_buffer{std::span<const glm::vec4>(nodes)};
    const gl::BufferTexture texels(node_buffer, gl::TexelFormat::rgba32f);
    std::vector<glm::vec4> actual = poisoned(points.size());
    const gl::Buffer<glm::vec4> out{std::span<const glm::vec4>(actual)};
    gpu::CarrySkin(points).run(texels, out);
    gl::barrier(gl::Barrier::buffer_update);
    out.download(actual);
    double worst = error_if(!guard_is_untouched(actual, points.size()));
    for (std::size_t p = 0; p < points.size(); ++p)
        worst = std::max(worst, error_over_bound(points[p], nodes, actual[p]));
    return worst;
}

}  // namespace gelatin::test
