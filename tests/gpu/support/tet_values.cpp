#include "gpu/support/tet_values.h"

#include <epoxy/gl.h>

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "gpu/view/tet_values.h"
#include "support/draw_vector.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

constexpr double kValueEps = std::numeric_limits<float>::epsilon();

Eigen::Vector3d place_of(const std::vector<glm::vec4>& nodes, std::uint32_t node) {
    return glm::dvec3(nodes[node]).x * Eigen::Vector3d::UnitX() +
           glm::dvec3(nodes[node]).y * Eigen::Vector3d::UnitY() +
           glm::dvec3(nodes[node]).z * Eigen::Vector3d::UnitZ();
}

Eigen::Matrix3d edges_of(const std::vector<glm::vec4>& nodes, const glm::uvec4& tet) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = place_of(nodes, tet[k + 1]) - place_of(nodes, tet[0]);
    return edges;
}

struct TetValue {
    double value, bound;
};

TetValue value_of(const Deformed& bodies, std::size_t t, Quantity quantity) {
    const glm::uvec4& tet = bodies.model.tets[t];
    if (quantity == Quantity::speed) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) sum += place_of(bodies.velocities, tet[k]).norm();
        return {0.25 * sum, 8.0 * kValueEps * sum};
    }
    const Eigen::Matrix3d ds = edges_of(bodies.positions, tet), dm = edges_of(bodies.model.positions, tet);
    const Eigen::Matrix3d f = ds * dm.inverse();
    Eigen::Vector3d stretches = Eigen::JacobiSVD<Eigen::MatrixXd>(f).singularValues();
    if (f.determinant() < 0.0) stretches.z() = -stretches.z();

    const double of_f = 16.0 * kValueEps * ds.norm() * dm.inverse().norm() * dm.norm() * dm.inverse().norm();
    if (quantity == Quantity::stretch) return {stretches.x(), of_f};
    const auto error = [&](double stretch) {
        const double size = stretches.x();
        return of_f + std::min(16.0 * kValueEps * size * size / std::max(std::abs(stretch), 1e-300),
                               std::sqrt(16.0 * kValueEps) * size);
    };
    const double mu = static_cast<double>(bodies.model.shear_moduli[t]);
    const Eigen::Vector3d differences(stretches.x() - stretches.y(), stretches.y() - stretches.z(),
                                      stretches.z() - stretches.x());
    // The third is found by the second.
    const double all = of_f + error(stretches.y()) + 2.0 * error(stretches.y());
    return {mu * std::sqrt(2.0) * differences.norm(), mu * 2.0 * all};
}

double volume_of(const Deformed& bodies, std::size_t t) {
    return static_cast<double>(bodies.model.tet_rests[t].volume);
}

// By node, weighted by volume.
std::vector<double> averaged(const Deformed& bodies, const std::vector<double>& tets) {
    std::vector<double> sums(bodies.positions.size()), volumes(bodies.positions.size());
    for (std::size_t t = 0; t < tets.size(); ++t) {
        for (int k = 0; k < 4; ++k) {
            sums[bodies.model.tets[t][k]] += volume_of(bodies, t) * tets[t];
            volumes[bodies.model.tets[t][k]] += volume_of(bodies, t);
        }
    }
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n] /= volumes[n];
    return sums;
}

std::vector<double> speeds_of(const Deformed& bodies) {
    std::vector<double> speeds;
    for (std::uint32_t n = 0; n < bodies.velocities.size(); ++n)
        speeds.push_back(place_of(bodies.velocities, n).norm());
    return speeds;
}

std::vector<std::uint32_t> histogram_of(const std::vector<float>& tets, float least) {
    std::vector<std::uint32_t> histogram(gpu::TetValues::kBins);
    for (const float value : tets) {
        const auto bits = std::bit_cast<std::uint32_t>(std::max(value - least, 0.0f));
        ++histogram[bits >> gpu::TetValues::kBinShift];
    }
    return histogram;
}

void poison(const gl::Buffer<float>& buffer) {
    const std::vector<float> nan(buffer.size(), std::numeric_limits<float>::quiet_NaN());
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
    glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(nan.size() * sizeof(float)), nan.data());
}

template <class T>
std::vector<T> contents_of(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    buffer.download(values);
    return values;
}

}  // namespace

Deformed make_deformed() {
    Material soft = structural_material(), stiff = soft;
    soft.youngs_modulus = 1e4;
    stiff.youngs_modulus = 3e6;
    stiff.poisson_ratio = 0.4;
    stiff.model = MaterialModel::neo_hookean;
    stiff.springs.reset();
    TetMesh beside = make_block({3, 3, 2}, {0.4, 0.4, 0.3}, 0.2, 5);
    for (glm::dvec3& p : beside.positions) p += glm::dvec3(2.0, -1.0, 0.5);
    Deformed deformed{.model = pack_bodies({make_body(make_block({5, 4, 3}, {1.0, 0.8, 0.6}, 0.2, 3), soft),
                                            make_body(std::move(beside), stiff),
                                            make_body(make_block({3, 2, 2}, {0.3, 0.2, 0.2}, 0.2), soft)},
                                           {}, glm::dvec3(0.0)),
                      .positions = {},
                      .velocities = {}};

    std::mt19937 random(11);
    std::uniform_real_distribution<float> some(-1.0f, 1.0f);
    const auto some_vector = [&] { return test::draw_vector<glm::vec3>(some, random); };
    for (const glm::vec4& rest : deformed.model.positions) {
        const float angle = 1.5f * rest.x;  // bent and twisted
        const glm::vec3 turned(rest.x + 0.3f * std::sin(rest.y),
                               std::cos(angle) * rest.y - std::sin(angle) * rest.z,
                               std::sin(angle) * rest.y + std::cos(angle) * rest.z);
        deformed.positions.emplace_back(turned + 0.05f * some_vector(), rest.w);
        deformed.velocities.emplace_back(3.0f * some_vector(), 0.0f);
    }
    // All of the last body is drawn out to a line, and nothing but rounding is left of its width.
    const Range& line = deformed.model.objects[2].nodes;
    for (std::uint32_t n = line.first; n < line.end(); ++n) {
        glm::vec4& p = deformed.positions[n];
        p = glm::vec4(p.x * glm::vec3(1.0f, 0.7f, -0.3f), p.w);
    }
    // Tets far from one another are flattened and shrunk to a point.
    const auto& tets = deformed.model.tets;
    for (std::size_t t = 7; t < deformed.model.objects[2].tets.first; t += 61) {
        for (int k = 1; k < 4; ++k) {
            glm::vec4& p = deformed.positions[tets[t][k]];
            const glm::vec4& first = deformed.positions[tets[t][0]];
            p = t % 2 == 0 ? glm::vec4(glm::vec3(first), p.w) : glm::vec4(p.x, p.y, first.z, p.w);
        }
    }
    return deformed;
}

Values expected_values(const Deformed& bodies, Quantity quantity) {
    Values values;
    for (std::size_t t = 0; t < bodies.model.tets.size(); ++t)
        values.tets.push_back(value_of(bodies, t, quantity).value);
    values.nodes = quantity == Quantity::speed ? speeds_of(bodies) : averaged(bodies, values.tets);
    return values;
}

GpuValues values_on_gpu(const Deformed& bodies, Quantity quantity) {
    gpu::TetValues stage(bodies.model, quantity);
    const gl::Buffer<glm::vec4> positions(std::span<const glm::vec4>(bodies.positions));
    const gl::Buffer<glm::vec4> velocities(std::span<const glm::vec4>(bodies.velocities));
    poison(stage.tet_values());
    poison(stage.node_values());
    // What is counted is counted anew each time.
    for (int run = 0; run < 2; ++run)
        stage.run({positions, gl::TexelFormat::rgba32f}, {velocities, gl::TexelFormat::rgba32f});
    return {contents_of(stage.tet_values()), contents_of(stage.node_values()),
            contents_of(stage.histogram())};
}

double worst_value_error(const Deformed& bodies, Quantity quantity, const GpuValues& actual) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const Values expected = expected_values(bodies, quantity);
    std::vector<double> bounds;
    for (std::size_t t = 0; t < bodies.model.tets.size(); ++t) {
        const TetValue tet = value_of(bodies, t, quantity);
        bounds.push_back(tet.bound + 8.0 * kValueEps * std::abs(tet.value));
    }
    std::vector<double> node_bounds = averaged(bodies, bounds);
    double worst = 0.0;
    const auto look = [&](double value, double right, double bound) {
        const double error = std::abs(value - right) / bound;
        worst = std::isfinite(value) ? std::max(worst, error) : kInfinity;
        return std::isfinite(value);
    };
    for (std::size_t t = 0; t < bounds.size(); ++t) {
        if (!look(static_cast<double>(actual.tets[t]), expected.tets[t], bounds[t])) return kInfinity;
    }
    for (std::size_t n = 0; n < node_bounds.size(); ++n) {
        const double bound = node_bounds[n] + 64.0 * kValueEps * std::abs(expected.nodes[n]);
        if (!look(static_cast<double>(actual.nodes[n]), expected.nodes[n], bound)) return kInfinity;
    }
    const float least = quantity == Quantity::stretch ? 1.0f : 0.0f;
    return actual.histogram == histogram_of(actual.tets, least) ? worst : kInfinity;
}

}  // namespace gelatin::test
