#include "sim/watch.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "cpu/measure/measure.h"
#include "gelatin/error.h"
#include "sim/divergence.h"

namespace gelatin {
namespace {

EnergyBudget::Account add_up(const std::vector<ObjectMeasure>& objects, double time) {
    EnergyBudget::Account sum{time, 0.0, 0.0};
    for (const ObjectMeasure& object : objects) {
        sum.energy += object.kinetic_energy + object.elastic_energy;
        sum.potential += object.potential_energy;
    }
    return sum;
}

// The object with the most energy. One whose energy is not finite has more than any other.
std::size_t most_lively(const std::vector<ObjectMeasure>& objects) {
    const auto energy = [](const ObjectMeasure& object) {
        const double sum = object.kinetic_energy + object.elastic_energy + object.potential_energy;
        return std::isfinite(sum) ? object.kinetic_energy + object.elastic_energy : HUGE_VAL;
    };
    const auto most = std::max_element(objects.begin(), objects.end(),
                                       [&](const auto& a, const auto& b) { return energy(a) < energy(b); });
    return static_cast<std::size_t>(most - objects.begin());
}

}  // namespace

Watch::Watch(const Scene& scene, std::shared_ptr<const Model> model, int substeps)
    : scene_(scene), model_(std::move(model)), substeps_(substeps), budget_(*model_, {}) {
    begin({model_->positions, model_->velocities, {}}, {});
}

void Watch::begin(const State& state, const Moment& moment) {
    const auto objects = cpu::measure<float>(*model_, {state.positions, state.velocities});
    budget_.restart(add_up(objects, moment.time));
    handled_until_ = -HUGE_VAL;  // time may have gone back
}

void Watch::check(const Alarm& alarm, const Moment& until, const Moment& now) const {
    if (alarm.count == 0) return;
    const std::uint32_t ago = static_cast<std::uint32_t>(now.steps) - alarm.step;
    const std::uint64_t step = now.steps - ago;
    if (step <= until.steps) fail(alarm, step, now);
}

void Watch::fail(const Alarm& alarm, std::uint64_t step, const Moment& now) const {
    const auto object = std::find_if(model_->objects.begin(), model_->objects.end(),
                                     [&](const ModelObject& o) { return alarm.node < o.nodes.end(); });
    const auto substeps = static_cast<std::uint64_t>(substeps_);
    Divergence where;
    where.step = step;
    where.frame = static_cast<int>((step - 1) / substeps) + 1;
    where.time = now.time - static_cast<double>(now.steps - step) * step_size();
    where.object = object->name;
    where.node = alarm.node - object->nodes.first;

    const auto speed = std::bit_cast<float>(alarm.speed);
    const std::string symptom =
        std::isfinite(speed)
            ? fmt::format("moved at up to {:.3g} m/s, more than the energy of the whole scene allows", speed)
            : "got positions or velocities that are not finite";
    const std::string others = alarm.count > 1 ? fmt::format(" and {} more", alarm.count - 1) : "";
    const glm::vec4& rest = model_->positions[alarm.node];
    throw Diverged(
        fmt::format("the simulation diverged in step {} (of frame {}, {:.6g} s): node {} of "
                    "object '{}', at ({:.4g}, {:.4g}, {:.4g}) at rest,{} {}; likely cause: {}",
                    where.step, where.frame, where.time, where.node, where.object, rest.x, rest.y, rest.z,
                    others, symptom, likely_cause(*model_, scene_, alarm.node, step_size())),
        where);
}

void Watch::check(const std::vector<ObjectMeasure>& objects, const Moment& moment) {
    const EnergyBudget::Account now = add_up(objects, moment.time);
    const bool is_moved = somebody_acts(now.time);
    const double most = is_moved ? kAnyEnergy : budget_.most_for(now);
    // A comparison with NaN is false, too.
    if (now.energy <= most && std::isfinite(now.potential))
        return is_moved ? budget_.restart(now) : budget_.note(now);
    const ModelObject& object = model_->objects[most_lively(objects)];
    throw Diverged(
        fmt::format(
            "the simulation diverged before frame {} ({:.6g} s): the bodies' kinetic and elastic energy is "
            "{:.3g} J, most of it in object '{}', but start, gravity and loads explain at most {:.3g} J; "
            "likely "
            "cause: {}",
            moment.frame, moment.time, now.energy, object.name, most,
            likely_cause(*model_, scene_, stiffest_node(*model_, object), step_size())),
        {0, moment.frame, moment.time, object.name, 0});
}

}  // namespace gelatin
