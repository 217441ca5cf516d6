#include "gpu/support/contact_scenarios.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <random>
#include <utility>

#include "cpu/descent/node_sweep.h"
#include "gpu/descent/limited_sweeps.h"
#include "support/contact_scenes.h"
#include "support/parity.h"

namespace gelatin::test {
namespace {

constexpr double kFriction = 0.4;

// Blocks on a plane and against a wall, one of which slides, one is pressed by another, and one flies by.
// @param gravity [m/s^2]
std::shared_ptr<const Model> make_crowded(MaterialModel kind, double gravity) {
    ColliderDescription floor, wall;
    floor.shape = PlaneCollider{{0.1, 1.0, 0.0}, 0.0};
    floor.friction = 0.2;
    wall.shape = BoxShape{{0.2, 2.0, 2.0}};
    wall.position = {-0.46, 0.0, 0.0};
    const double ratio = kind == MaterialModel::mass_spring ? 0.25 : 0.4;
    const auto block = [&](const glm::dvec3& place, const glm::dvec3& velocity) {
        return Block{.place = place, .velocity = velocity, .poisson_ratio = ratio, .model = kind};
    };
    return make_blocks({block({-0.33, 0.04, 0.0}, {-1.0, 0.0, 0.0}), block({-0.3, 0.37, 0.05}, {0, -2, 0.5}),
                        block({0.05, 0.03, 0.1}, {-3.0, 0.0, 0.0}), block({0.4, 0.5, 0.0}, {0.0, 1.0, 3.0})},
                       {0.0, -gravity, 0.0}, {floor, wall});
}

template <class To, class From>
std::vector<To> converted(const std::vector<From>& values) {
    return {values.begin(), values.end()};
}

// What a step of block descent has before its sweeps, with numbers that single precision has as well.
struct BeforeSweeps {
    std::shared_ptr<const Model> model;
    cpu::Contacts<double> contacts;
    cpu::StepObjective<double> objective;
    std::vector<glm::dvec4> positions;

    // @param frames that the bodies go on first
    BeforeSweeps(const std::shared_ptr<const Model>& of, int frames)
        : model(of),
          contacts(model, {.self_collision = true, .friction = kFriction}),
          objective(model, cpu::BlockDescent<double>::kNodesABatch) {
        cpu::ImplicitSolver<double> solver = make_solver<double>(model, kFriction);
        for (int frame = 0; frame < frames; ++frame) solver.advance({kFrame});
        const cpu::Nodes<double>& nodes = solver.nodes();
        const std::vector<glm::dvec4> start = rounded(nodes.positions);
        contacts.restart(start);
        std::vector<glm::dvec4> flat = start;
        for (glm::dvec4& p : flat) p.y *= 1e-3;
        contacts.stay_clear(flat, nullptr);  // bodies may touch themselves: displacement bounds count
        for (std::uint32_t n = 0; n < model->node_count(); ++n) {
            const glm::dvec3 at(start[n]), velocity(nodes.velocities[n]), gravity(model->gravity);
            const double stiffness = start[n].w > 0.0 ? 1.0 / (start[n].w * kFrame * kFrame) : 0.0;
            objective.step.starts[n] = glm::dvec4(glm::vec4(glm::vec3(at), nodes.velocities[n].w));
            objective.step.targets[n] = glm::dvec4(glm::vec4(
                start[n].w > 0.0 ? glm::dvec4(at + kFrame * (velocity + kFrame * gravity), stiffness)
                                 : glm::dvec4(at, 0.0)));
        }
        objective.begin(kFrame, &contacts);
        for (std::uint32_t n = 0; n < model->node_count(); ++n)
            positions.emplace_back(glm::dvec3(objective.step.targets[n]), start[n].w);
        contacts.begin(kFrame, objective.step.targets, objective.step.starts, positions, nullptr);
        positions = rounded(positions);
        contacts.renew(positions, nullptr);
    }

    void throw_nodes(double far, unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(-far, far);
        for (glm::dvec4& target : objective.step.targets) {
            const double x = unit(random), y = unit(random), z = unit(random);
            if (target.w > 0.0) target = glm::dvec4(glm::vec4(glm::dvec4(target) + glm::dvec4(x, y, z, 0.0)));
        }
    }

    static std::vector<glm::dvec4> rounded(const std::vector<glm::dvec4>& values) {
        return converted<glm::dvec4>(converted<glm::vec4>(values));
    }
};

std::vector<glm::vec4> sweep_on_gpu(const BeforeSweeps& before, int sweeps, DeviceContacts& touched) {
    const gpu::ModelBuffers buffers(*before.model);
    gpu::LimitedSweeps device(*before.model, buffers, {});
    ContactLimits limits;
    before.contacts.write_limits(limits);
    device.begin(kFrame, converted<glm::vec4>(before.objective.step.starts),
                 converted<glm::vec4>(before.objective.step.targets));
    device.start(sweeps, TetUpdate::all, limits, converted<glm::vec4>(before.positions));
    std::vector<glm::vec4> positions(before.positions.size(),
                                     glm::vec4(std::numeric_limits<float>::quiet_NaN()));
    device.finish(positions, touched);
    return positions;
}

// How far nodes are beyond what limits them [m]: planes between bodies, displacement bounds, planes among the
// colliders.
double worst_excess(const BeforeSweeps& before, const std::vector<glm::vec4>& positions) {
    ContactLimits limits;
    before.contacts.write_limits(limits);
    double worst = 0.0;
    for (std::size_t s = 0; s < limits.nodes.size(); ++s) {
        const std::uint32_t n = before.model->surface_parts.nodes[s];
        const NodeLimits& own = limits.nodes[s];
        const glm::dvec3 position(positions[n]), moved = position - glm::dvec3(own.aimed_at);
        if (positions[n].w == 0.0f) continue;
        for (std::uint32_t k = own.first_plane; k < own.first_plane + own.plane_count; ++k) {
            const glm::dvec4 plane(limits.planes[k]);
            worst = std::max(worst, glm::dot(glm::dvec3(plane), moved) - std::max(plane.w, 0.0));
        }
        const glm::dvec3 in_own_room = position - glm::dvec3(own.own_room);
        worst = std::max(worst, glm::length(in_own_room) - static_cast<double>(own.own_room.w));
        const glm::dvec3 in_room = position - glm::dvec3(own.room), way(own.way);
        const double along = glm::dot(way, way) > 0.0 ? glm::dot(in_room, way) / glm::dot(way, way) : 0.0;
        worst = std::max(worst, glm::length(in_room - std::clamp(along, 0.0, 1.0) * way) -
                                    static_cast<double>(own.room.w));
        for (const Collider& plane : before.model->colliders) {
            const auto depth = [&](const glm::dvec3& p) {
                return glm::dot(glm::dvec3(plane.center), p) - static_cast<double>(plane.center.w);
            };
            worst = std::max(worst, std::min(depth(glm::dvec3(before.positions[n])), 0.0) - depth(position));
        }
    }
    return worst;
}

void sweep(BeforeSweeps& before, int sweeps, cpu::ColliderContacts<double>& colliders) {
    const cpu::NodeSweep<double> nodes(before.model);
    for (int i = 0; i < sweeps; ++i)
        for (std::size_t batch = 0; batch < before.objective.rows().batches.size(); ++batch)
            nodes.run(batch, before.objective, &before.contacts, colliders, before.positions);
}

// Where one sweep leads the nodes of each colour after the device has moved those of the colours before. So
// each node's step is compared by itself: where one ends elsewhere, its neighbours' do not.
void sweep_along(BeforeSweeps& before, const std::vector<glm::vec4>& moved,
                 cpu::ColliderContacts<double>& colliders) {
    const DescentRows& rows = before.objective.rows();
    std::vector<glm::dvec4>& targets = before.objective.step.targets;
    std::vector<glm::dvec4> now = before.positions, held = targets;
    for (glm::dvec4& target : held) target.w = 0.0;
    std::swap(targets, held);  // nodes whose targets have no stiffness do not move
    for (std::size_t batch = 0; batch < rows.batches.size(); ++batch) {
        for (const Range& color : rows.batches[batch].colors) {
            std::vector<std::uint32_t> nodes(&rows.nodes[color.first],
                                             &rows.nodes[color.first] + color.count);
            std::erase(nodes, kNoNode);
            for (const std::uint32_t n : nodes) std::swap(targets[n], held[n]);
            cpu::ColliderContacts<double> touched(*before.model);
            cpu::NodeSweep<double>(before.model).run(batch, before.objective, &before.contacts, touched, now);
            for (const std::uint32_t n : nodes) {
                std::swap(targets[n], held[n]);
                before.positions[n] = std::exchange(now[n], glm::dvec4(moved[n]));
                colliders.nodes[n] = touched.nodes[n];
            }
            for (std::size_t o = 0; o < touched.objects.size(); ++o)
                colliders.objects[o] |= touched.objects[o];
        }
    }
    std::swap(targets, held);
}

// Of values, the one that all but a part are below.
double quantile(std::vector<double> values, double part) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

double sweep_error(MaterialModel kind, int frames, int sweeps, double far = 0.0, unsigned seed = 0,
                   double gravity = 9.81) {
    BeforeSweeps before(make_crowded(kind, gravity), frames);
    if (far > 0.0) before.throw_nodes(far, seed);
    const std::vector<glm::dvec4> start = before.positions;
    DeviceContacts touched;
    const std::vector<glm::vec4> actual = sweep_on_gpu(before, sweeps, touched);
    const double excess = worst_excess(before, actual);

    cpu::ColliderContacts<double> colliders(*before.model);
    for (std::size_t batch = 0; batch < before.objective.rows().batches.size(); ++batch)
        before.objective.update(batch, TetUpdate::all, before.positions);
    if (sweeps == 1) {
        sweep_along(before, actual, colliders);
    } else {
        sweep(before, sweeps, colliders);
    }

    std::vector<double> off, forces_off;
    double longest = 0.0;
    for (std::uint32_t n = 0; n < before.model->node_count(); ++n) {
        const glm::dvec3 expected(before.positions[n]), force(colliders.nodes[n].force);
        off.push_back(glm::length(glm::dvec3(actual[n]) - expected));
        if (!(off.back() < 1.0) || actual[n].w != static_cast<float>(before.positions[n].w))
            return error_if(true);
        longest = std::max(longest, glm::length(expected - glm::dvec3(start[n])));
        const double force_off = glm::length(glm::dvec3(touched.nodes[n].force) - force);
        if (force_off > 0.0) forces_off.push_back(force_off / (2e-4 * glm::length(force) + 0.02));  // [N]
    }
    for (std::size_t o = 0; o < before.model->objects.size(); ++o)
        if ((touched.objects[o] != 0) != (colliders.objects[o] != 0)) return error_if(true);
    // Where a node's step ends is found by a line search of few steps, whose result may change with the last
    // bit near the kinks of the law: a few nodes are off by a part of their motion. In a second sweep their
    // neighbours are, too, and forces.
    constexpr double kUnit = 1.2e-7;  // in the last place of the largest coordinates
    constexpr double kPartOfMotion = 0.5;
    if (sweeps > 1)
        return std::max({quantile(off, 0.75) / (25.0 * kUnit), quantile(off, 1.0) / (kPartOfMotion * longest),
                         excess / kUnit});
    return std::max({quantile(off, 0.8) / (3.0 * kUnit), quantile(off, 1.0) / (kPartOfMotion * longest),
                     quantile(forces_off, 0.8), excess / kUnit});
}

// Of nodes that are thrown in all directions from between three others: some have three planes in
// their way.
double limit_error(MaterialModel kind, unsigned seed) {
    const auto block = [&](const glm::dvec3& place) { return Block{.place = place, .model = kind}; };
    const std::vector<Block> blocks{block({0, 0, 0}), block({0.32, 0, 0}), block({0, 0.32, 0}),
                                    block({0, 0, 0.32})};
    BeforeSweeps before(make_blocks(blocks), 0);
    before.throw_nodes(0.3, seed);
    DeviceContacts touched;
    return worst_excess(before, sweep_on_gpu(before, 1, touched)) / 1.2e-7;
}

}  // namespace

Scenarios limited_sweep_scenarios() {
    Scenarios scenarios;
    for (const MaterialModel kind : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        const char* name = kind == MaterialModel::mass_spring ? "springs" : "tets";
        for (const int frames : {2, 4, 12}) {
            scenarios.push_back({fmt::format("{}_after_{}_frames", name, frames),
                                 [=] { return sweep_error(kind, frames, 2); }});
        }
        for (const int frames : {6, 9, 12, 15}) {  // pressed to far less than half of the reach
            scenarios.push_back({fmt::format("{}_pressed_after_{}_frames", name, frames),
                                 [=] { return sweep_error(kind, frames, 1, 0.0, 0, 200.0); }});
        }
        for (const double far : {0.01, 0.03, 0.1, 0.3}) {
            for (const unsigned seed : {1u, 3u, 4u, 5u, 6u}) {
                scenarios.push_back({fmt::format("{}_thrown_by_{:.0f}_cm_{}", name, 100.0 * far, seed),
                                     [=] { return sweep_error(kind, 6, 1, far, seed); }});
            }
        }
        for (unsigned seed = 1; seed <= 4; ++seed)
            scenarios.push_back(
                {fmt::format("{}_keep_to_limits_{}", name, seed), [=] { return limit_error(kind, seed); }});
    }
    return scenarios;
}

}  // namespace gelatin::test
