#include "gpu/support/watched_runs.h"

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cpu/measure/watch_nodes.h"
#include "gpu/measure/watch_nodes.h"
#include "support/parity.h"

namespace gelatin::test {
namespace {

constexpr float kMostEnergy = 1e3f;  // far beyond what the model has [J]

NodeArrays start_of(const Model& model) {
    NodeArrays arrays{poisoned(model.node_count()), poisoned(model.node_count())};
    std::copy(model.positions.begin(), model.positions.end(), arrays.positions.begin());
    std::copy(model.velocities.begin(), model.velocities.end(), arrays.velocities.begin());
    return arrays;
}

// Gives a node a part of the speed that is allowed.
void hurl(NodeArrays& arrays, std::uint32_t node, float part) {
    const float speed = part * std::sqrt(2.0f * kMostEnergy * arrays.positions[node].w);
    const glm::vec3 direction = glm::normalize(glm::vec3(1.0f, -2.0f, 0.5f));
    arrays.velocities[node] = glm::vec4(speed * direction, arrays.velocities[node].w);
}

std::uint32_t a_pinned_node(const Model& model) {
    std::uint32_t node = 0;
    while (model.positions[node].w != 0.0f) ++node;
    return node;
}

std::uint32_t free_from(const Model& model, std::uint32_t node) {
    while (model.positions[node].w == 0.0f) ++node;
    return node;
}

}  // namespace

std::vector<WatchedRun> watched_runs(const Model& model) {
    const std::uint32_t last = model.node_count() - 1, some = free_from(model, 300),
                        other = free_from(model, 700);
    std::vector<WatchedRun> runs;

    NodeArrays sound = start_of(model);
    hurl(sound, some, 0.999f);
    hurl(sound, last, 0.999f);
    sound.velocities[a_pinned_node(model)] = glm::vec4(1e6f, 0.0f, 0.0f, 0.0f);
    runs.push_back({{sound, sound}, kMostEnergy});
    runs.push_back({{sound}, std::numeric_limits<float>::infinity()});

    NodeArrays fast = sound;
    hurl(fast, other, 1.001f);
    hurl(fast, some, 2.0f);
    hurl(fast, last, 3.0f);
    NodeArrays faster = fast;
    hurl(faster, free_from(model, 5), 9.0f);
    runs.push_back({{sound, fast, faster}, kMostEnergy});

    const float infinity = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 6; ++k) {
        NodeArrays broken = sound;
        std::vector<glm::vec4>& values = k < 3 ? broken.positions : broken.velocities;
        values[last][k % 3] = k % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : -infinity;
        hurl(broken, other, 1.5f);
        runs.push_back({{sound, broken, faster}, kMostEnergy});
    }
    return runs;
}

Alarm watch_on_cpu(const Model& model, const WatchedRun& run) {
    Alarm alarm = kNoAlarm;
    std::uint32_t step = kFirstStep;
    for (NodeArrays nodes : run.steps) {
        nodes.positions.resize(model.node_count());
        nodes.velocities.resize(model.node_count());
        cpu::watch_nodes<float>({nodes.positions, nodes.velocities}, step++, run.most_energy, alarm);
    }
    return alarm;
}

Alarm watch_on_gpu(const Model& model, const WatchedRun& run) {
    const gpu::ModelBuffers buffers(model);
    gpu::WatchNodes watch;
    std::uint32_t step = kFirstStep;
    for (const NodeArrays& nodes : run.steps) {
        gl::barrier(gl::Barrier::storage);  // as a step has
        watch.run(buffers, gpu::NodeBuffers(nodes.positions, nodes.velocities), step++,
                  static_cast<double>(run.most_energy));
    }
    return watch.alarm(true);
}

bool agree(const Alarm& a, const Alarm& b) {
    const auto speed_a = std::bit_cast<float>(a.speed), speed_b = std::bit_cast<float>(b.speed);
    const bool same_speed =
        std::isnan(speed_a) ? std::isnan(speed_b) : std::abs(speed_a - speed_b) <= 1e-6f * speed_b;
    return a.step == b.step && a.node == b.node && a.count == b.count && same_speed;
}

}  // namespace gelatin::test
