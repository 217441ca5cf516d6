#include "gpu/support/end_of_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cpu/contact/tuning.h"
#include "cpu/elasticity/elastic_energy.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/implicit/part_end.h"
#include "gpu/support/end_reference.h"
#include "gpu/support/end_values.h"
#include "model/shared_constants.h"
#include "support/converted.h"
#include "support/parity.h"
#include "support/random_maker.h"

namespace gelatin::test {
namespace {

using Outcome = EndReference::Outcome;

StepRow end_row(const cpu::ContactRow<double>& row) {
    StepRow result{};
    const std::array<std::uint32_t*, 4> nodes{&result.node_0, &result.node_1, &result.node_2, &result.node_3};
    for (std::uint32_t k = 0; k < row.count; ++k) {
        *nodes[k] = row.nodes[k];
        result.weights[static_cast<int>(k)] = static_cast<float>(row.weights[k]);
    }
    result.normal = glm::vec4(row.normal, row.gap);
    result.reach = static_cast<float>(row.reach);
    result.stiffness = static_cast<float>(row.stiffness);
    result.damping = static_cast<float>(row.damping);
    result.friction = static_cast<float>(row.friction);
    result.hold = glm::vec4(row.hold, row.limit);
    result.object = row.object;
    result.other = row.other;
    result.plane = row.object == kNoNode ? row.plane() : 0;
    result.ease = static_cast<float>(row.ease);
    return result;
}

// In the order of tables.
std::vector<cpu::ContactRow<double>> sorted_rows(const EndReference& reference) {
    std::vector<cpu::ContactRow<double>> rows = reference.system.rows;
    const auto key = [&](const cpu::ContactRow<double>& row) {
        const bool is_second = reference.model->is_body(row.other);
        return std::array{reference.islands.of_bodies[is_second ? row.other : row.object], row.object,
                          row.other};
    };
    std::stable_sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    return rows;
}

// Of the first body with itself.
cpu::ContactRow<double> own_row(std::uint32_t k) {
    cpu::ContactRow<double> row;
    row.nodes = {k, 40 + k, 20 + 2 * k, 0};
    row.weights = {-1.0, 0.25, 0.75, 0.0};
    row.count = 3;
    row.normal = glm::dvec3(glm::vec3(glm::normalize(glm::dvec3(0.2 * k, 1.0, 0.5))));
    row.gap = 2e-3 + 1e-3 * k;
    row.reach = 6e-3;
    row.stiffness = 500.0;
    row.friction = 0.3;
    row.limit = 0.5;
    row.key = std::uint64_t(1) << 63 | k;
    return row;
}

// Of a system for a case.
gpu::RowCapacity capacity_for(const EndCase& at) {
    const Model& model = *at.model;
    const std::size_t planes = model.colliders.size() * model.body_node_count();
    if (!at.contacts) return {std::max<std::size_t>(planes, 1), model.body_count()};
    return {planes + 4096, model.body_count() + 64};
}

std::vector<glm::vec4> as_floats(const std::vector<glm::dvec4>& values) {
    return {values.begin(), values.end()};
}

// Both ways to end parts, of a case.
class EndOfParts {
public:
    explicit EndOfParts(const EndCase& at)
        : at_(at),
          model_(*at.model),
          buffers_(model_),
          surface_(make_contact_surface(model_, CollisionSettings{.restitution = at.restitution})),
          state_(model_, surface_),
          system_(model_, state_.tries, capacity_for(at), 0),  // solves of all islands end alike
          end_(model_, state_, system_, at.contacts ? &surface_ : nullptr),
          reference_(at.model, at.restitution, at.contacts),
          pulls_(model_.node_count()) {
        if (!model_.loads.empty()) {
            loads_.emplace(model_);
            loads_->run(state_.from);
            for (const glm::vec4& force : read(loads_->forces())) reference_.loads.emplace_back(force);
        }
        if (at.is_pulled) hold();
        for (int k = 0; k < at.own_rows; ++k)
            reference_.own_rows.push_back(own_row(static_cast<std::uint32_t>(k)));
        system_.set_iterations(0);
        clock_.size = clock_.left = static_cast<float>(kStepSize);
        clock_.goes_on = 1;
        std::vector<glm::vec4> poison = poisoned(model_.node_count());
        poison.resize(model_.node_count());
        state_.to.positions.upload(poison);
        state_.to.velocities.upload(poison);
    }

    /// @return the greatest error over its bound
    double run() {
        RandomMaker random(5);
        end_.begin_step(buffers_);
        std::vector<Outcome> outcomes;
        for (const PartChange& part : at_.parts) {
            if (part.sets_velocities) set_velocities(random);
            reference_.is_apart = part.is_apart;
            if (part.strikes) reference_.paces.struck()[0] = 1;
            if (part.forgets || part.goes_on) forget(part.goes_on, random);
            reference_.begin();
            bool damps = false;
            for (double step = part.step;;) {
                const Outcome outcome = try_part(part, step, damps, random);
                outcomes.push_back(outcome);
                if (outcome == Outcome::made || outcome == Outcome::stood_still) break;
                damps = outcome == Outcome::damped;
                if (!damps) step *= 0.5;
                if (outcomes.size() > 60) return std::numeric_limits<double>::infinity();
            }
        }
        for (const Outcome wanted : at_.outcomes)
            error_.fail_if(std::find(outcomes.begin(), outcomes.end(), wanted) == outcomes.end());
        error_.fail_if((at_.bounces && !reference_.has_bounced) || (at_.is_struck && !was_struck_) ||
                       (at_.is_guarded && !was_guarded_));
        error_.fail_if(largest_island_ < at_.island || (at_.is_torn && !was_torn_));
        return error_.worst();
    }

    void use_programs() {
        end_.begin_step(buffers_);
        reference_.begin();
        reference_.solve(kStepSize, false);
        begin_on_gpu(kStepSize, false);
        end_on_gpu();
        end_.forget();
        end_on_gpu();
        velocities();
    }

    std::vector<glm::vec4> velocities() { return read(state_.from.velocities); }

private:
    void hold() {
        Pull pull;
        pull.target = {0.3, 0.8, 0.1};
        pull.damping_time = 0.02;
        const Range& nodes = model_.objects[0].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); n += 4)
            pull.nodes.push_back({n, glm::vec3(0.05f, 0.0f, 0.02f), 800.0f * model_.masses[n]});
        std::vector<glm::vec3> forces(model_.node_count(), glm::vec3(0.0f));
        for (std::uint32_t n = nodes.first; n < nodes.end(); n += 5)
            forces[n] = model_.masses[n] * glm::vec3(20.0f, -30.0f, 10.0f);
        buffers_.pulls.set_pulls({pull});
        buffers_.pulls.set_forces(forces);
        pulls_.set_pulls({pull});
        pulls_.set_forces(forces);
        reference_.pulls = &pulls_;
    }

    void set_velocities(RandomMaker& random) {
        for (std::size_t n = 0; n < reference_.from.velocities.size(); ++n)
            reference_.from.velocities[n] += glm::dvec4(glm::vec4(random.point(0.1), 0.0));
        reference_.energy.change();
        gl::barrier(gl::Barrier::buffer_update);
        state_.from.velocities.upload(as_floats(reference_.from.velocities));
        end_.begin_step(buffers_);
    }

    void forget(bool goes_on, RandomMaker& random) {
        reference_.energy.forget();
        reference_.rows.forget();
        reference_.scheme.forget();
        reference_.restitution.forget();
        reference_.paces.forget();
        if (goes_on) {
            std::vector<glm::dvec4> earlier = reference_.from.velocities;
            for (glm::dvec4& v : earlier) v += glm::dvec4(glm::vec4(random.point(0.01), 0.0));
            reference_.scheme.go_on(reference_.from, earlier, kStepSize);
            end_.go_on(as_floats(reference_.from.positions), as_floats(reference_.from.velocities),
                       as_floats(earlier), kStepSize);
        } else {
            end_.forget();
        }
        end_.begin_step(buffers_);
    }

    Outcome try_part(const PartChange& part, double step, bool damps, RandomMaker& random) {
        reference_.solve(step, damps);
        for (std::size_t n = 0; n < reference_.system.displacements.size(); ++n) {
            glm::dvec3& d = reference_.system.displacements[n];
            const bool is_last = n >= model_.objects[model_.body_count() - 1].nodes.first;
            if (reference_.from.positions[n].w > 0.0)
                d += step * (part.push + (is_last ? part.last_push : glm::dvec3(0.0)) +
                             random.point(std::max(part.noise, 1e-9)));
            d = glm::dvec3(glm::vec3(d));
        }
        if (part.breaks) reference_.system.displacements[3].x = std::numeric_limits<double>::quiet_NaN();
        rounding_ = 3e-6 * (1.0 + glm::length(part.push) + glm::length(part.last_push)) / step;
        begin_on_gpu(step, damps);
        const std::vector<cpu::ContactRow<double>> rows = reference_.system.rows;
        const double shortest = kStepSize / cpu::tuning::kMostParts;
        const Outcome outcome = reference_.end(shortest);
        end_on_gpu();
        was_guarded_ = was_guarded_ || reference_.is_guarded;
        compare_clock(outcome, step, shortest);
        compare_paces(outcome);
        compare_nodes();
        if (outcome == Outcome::made) compare_memories(rows);
        if (outcome == Outcome::made || outcome == Outcome::stood_still) compare_state();
        return outcome;
    }

    // What the other stages of a try find.
    void begin_on_gpu(double step, bool damps) {
        const cpu::StepSystem<double>& solved = reference_.system;
        std::vector<StepRow> rows;
        std::vector<glm::vec4> slips, loads, displacements;
        for (const cpu::ContactRow<double>& row : sorted_rows(reference_)) {
            rows.push_back(end_row(row));
            slips.emplace_back(cpu::relative<double>(row, solved.displacements), row.limit);
        }
        for (std::size_t n = 0; n < solved.inertia.size(); ++n) {
            loads.emplace_back(glm::vec3(0.0f), solved.inertia[n]);
            displacements.emplace_back(solved.displacements[n], 0.0);
        }
        std::vector<BodyPace> paces = read(state_.paces.values);
        for (std::size_t o = 0; o < model_.body_count(); ++o) {
            const std::uint32_t island = reference_.islands.of_bodies[o];
            paces[o].past = static_cast<float>(reference_.scheme.of(o).past);
            paces[o].is_held = reference_.islands.are_held[island];
            paces[o].velocity.w = static_cast<float>(model_.objects[o].mass);
            was_torn_ = was_torn_ || reference_.scheme.of(o).is_whole;
            const auto count =
                std::count(reference_.islands.of_bodies.begin(), reference_.islands.of_bodies.end(), island);
            largest_island_ = std::max(largest_island_, static_cast<std::uint32_t>(count));
        }
        state_.paces.values.upload(paces);
        clock_.step = static_cast<float>(step);
        clock_.goes_on = 1;
        state_.tries.set_clock(clock_);
        std::vector<float> times;
        for (const glm::vec4& velocity : model_.velocities) times.push_back(velocity.w);
        const gl::TexelTable<float> damping_times(times, gl::TexelFormat::r32f);
        // Where there is no contact, as the beginning of a part leaves it.
        state_.plane_notes.upload(std::vector<PlaneMemory>(state_.plane_notes.size()));
        system_.elastic.linearise(buffers_, state_.from, damping_times.texels(), state_.tries);
        system_.loads().upload(loads);
        system_.displacements().upload(std::vector<glm::vec4>(loads.size(), glm::vec4(0.0f)));
        system_.set_rows(rows, reference_.islands.of_bodies);
        system_.begin_bodies(state_.from);
        system_.solve(state_.from);
        gl::barrier(gl::Barrier::buffer_update);
        system_.displacements().upload(displacements);
        system_.buffers().slips.values.upload(slips);
        clock_.step = static_cast<float>(step);
        clock_.last_step = static_cast<float>(reference_.scheme.last_step());
        clock_.damps = damps ? 1 : 0;
        clock_.has_past = reference_.has_past ? 1 : 0;
        clock_.is_over = 0;
        state_.tries.set_clock(clock_);
    }

    // With contacts the reference's guard moves nodes.
    void end_on_gpu() {
        const gpu::SumLoads* const loads = loads_ ? &*loads_ : nullptr;
        if (!at_.contacts) return end_.run(buffers_, loads);
        end_.finish(buffers_, loads);
        std::vector<glm::vec4> positions = read(state_.to.positions);
        for (std::size_t n = 0; n < reference_.guarded.size(); ++n)
            if (reference_.guarded[n].w >= 0.0) positions[n] = reference_.guarded[n];
        state_.to.positions.upload(positions);
        end_.settle(buffers_);
    }

    void compare_clock(Outcome outcome, double step, double shortest) {
        const StepClock now = state_.tries.clock();
        const bool is_made = outcome == Outcome::made || outcome == Outcome::stood_still;
        error_.fail_if(now.goes_on != (is_made ? 1u : 0u) || now.made != clock_.made + (is_made ? 1u : 0u));
        error_.fail_if(now.damps != (outcome == Outcome::damped ? 1u : 0u));
        error_.fail_if((now.is_guarded != 0) != reference_.is_guarded);
        if (std::isfinite(reference_.gained)) {
            error_.add(static_cast<double>(now.gained), reference_.gained, 1e-2);
        } else {
            error_.fail_if(!std::isinf(now.gained));
        }
        const double left = static_cast<double>(clock_.left) - (is_made ? step : 0.0);
        error_.add(static_cast<double>(now.left), left, 1e-6);
        error_.add(static_cast<double>(now.step), outcome == Outcome::divided ? 0.5 * step : step, 1e-8);
        if (is_made) {
            error_.add(static_cast<double>(now.longest), 2.0 * step, 1e-8);
            error_.add(static_cast<double>(now.last_step), step, 1e-8);
            error_.fail_if((now.is_over != 0) == (left > 0.5 * shortest));
        }
        clock_ = now;
        if (!(clock_.left > 0.0f)) clock_.left = static_cast<float>(kStepSize);
    }

    void compare_paces(Outcome outcome) {
        const std::vector<BodyPace> paces = read(state_.paces.values);
        StateReader reader(reference_.paces);
        const auto expected = reader.take<std::uint8_t>(model_.body_count()),
                   struck = reader.take<std::uint8_t>(model_.body_count());
        for (std::size_t o = 0; o < expected.size(); ++o) {
            was_struck_ = was_struck_ || struck[o] != 0;
            error_.fail_if(paces[o].pace != expected[o]);
            if (outcome == Outcome::made || outcome == Outcome::stood_still)
                error_.fail_if(paces[o].is_struck != struck[o]);
        }
    }

    void compare_nodes() {
        const std::vector<glm::vec4> positions = read(state_.from.positions),
                                     velocities = read(state_.from.velocities);
        for (std::size_t n = 0; n < positions.size(); ++n) {
            const glm::dvec4 &x = reference_.from.positions[n], &v = reference_.from.velocities[n];
            error_.add(glm::dvec3(positions[n]), glm::dvec3(x), 2e-6);
            error_.add(glm::dvec3(velocities[n]), glm::dvec3(v), 2e-4);
            error_.fail_if(positions[n].w != static_cast<float>(x.w));
            error_.fail_if(velocities[n].w != static_cast<float>(v.w));
        }
    }

    void compare_memories(const std::vector<cpu::ContactRow<double>>& rows) {
        const std::vector<PlaneMemory> memories = read(state_.plane_memories);
        std::vector<std::uint8_t> are_known(memories.size());
        for (const cpu::ContactRow<double>& row : rows) {
            if (row.object != kNoNode) continue;
            const std::size_t at = row.plane() * model_.body_node_count() + row.nodes[0];
            are_known[at] = 1;
            error_.add(static_cast<double>(memories[at].reach), row.reach, 1e-5 * row.reach);
            error_.add(static_cast<double>(memories[at].ease), row.ease, 1e-7);
        }
        for (std::size_t k = 0; k < memories.size(); ++k)
            if (are_known[k] == 0) error_.fail_if(memories[k].reach != 0.0f);
        // Of friction: key, object, other, hold, limit, reach, ease each.
        struct Memory {
            std::uint64_t key;
            std::uint32_t object, other;
            glm::dvec3 hold;
            double limit, reach, ease;
        };
        StateReader reader(reference_.rows);
        for (const Memory& memory : reader.take<Memory>(reader.take<std::size_t>())) {
            if (memory.object != kNoNode) continue;
            const std::size_t plane = memory.key >> 31 & 0x7FFFFFFFu, node = memory.key & 0x7FFFFFFFu;
            const PlaneMemory& actual = memories[plane * model_.body_node_count() + node];
            const double bound = 1e-3 * (1.0 + memory.limit);
            error_.add(static_cast<double>(actual.hold.w), memory.limit, bound);
            error_.add(glm::dvec3(actual.hold), memory.hold, bound);
        }
    }

    void compare_state() {
        struct Rates {
            glm::dvec3 linear, angular;
        };
        StateReader schemes(reference_.scheme);
        schemes.take<double>();
        const auto accelerations = schemes.take<glm::dvec3>(schemes.take<std::size_t>());
        const auto rates = schemes.take<Rates>(model_.body_count());
        const auto tied = schemes.take<std::uint32_t>(model_.body_count());
        const std::vector<glm::vec4> actual = read(state_.accelerations.values);
        double most = 10.0;
        for (const glm::dvec3& a : accelerations) most = std::max(most, glm::length(a));
        // Only free nodes' are ever read (find_targets.comp, finish.comp); those of colliders never are free.
        for (std::size_t n = 0; n < std::min<std::size_t>(accelerations.size(), model_.body_node_count());
             ++n)
            error_.add(glm::dvec3(actual[n]), accelerations[n], 2e-3 * most + rounding_);
        const std::vector<BodyPace> paces = read(state_.paces.values);
        const std::vector<BodyEnergy> energies = read(end_.energies());
        StateReader accounts(reference_.energy);
        const auto contacts = accounts.take<double>(model_.body_count()),
                   debts = accounts.take<double>(model_.body_count());
        for (std::size_t o = 0; o < model_.body_count(); ++o) {
            const bool is_free = reference_.system.rigid.is_free(o);
            const double force = model_.objects[o].mass * (10.0 + 1e-3 * most + 1e3 * rounding_);
            if (is_free) {
                error_.add(glm::dvec3(paces[o].force), rates[o].linear, 1e-3 * force);
                error_.add(glm::dvec3(paces[o].moment), rates[o].angular, 1e-3 * force);
            }
            const double energy = reference_.energy.after()[o];
            const double bound = std::isfinite(energy) ? 2e-5 * (1.0 + std::abs(energy)) : 2e-5;
            const double elastic =
                cpu::body_energy<double>(model_, model_.objects[o], reference_.from.positions);
            error_.add(energies[o].elastic, elastic, 2e-4 * (0.1 + elastic));  // of stiff blocks, in floats
            error_.add(energies[o].contacts, contacts[o], bound);
            error_.add(energies[o].debt, debts[o], bound);
            error_.fail_if(energies[o].tied != tied[o]);
            error_.fail_if((energies[o].is_whole != 0) != reference_.scheme.of(o).is_whole);
        }
        compare_meetings();
    }

    void compare_meetings() {
        struct Meeting {
            double speed, time, energy, size;
            glm::dvec3 impulse, arm, held, pressing;
        };
        std::vector<double> actual = read(end_.meetings()), of_pairs = read(end_.pair_meetings());
        std::size_t pair_count = 0;
        StateReader reader(reference_.restitution);
        const auto count = reader.take<std::size_t>();
        const std::size_t objects = model_.objects.size();
        for (std::size_t k = 0; k < count; ++k) {
            const auto first = reader.take<std::size_t>(), object = reader.take<std::size_t>();
            const auto meeting = reader.take<Meeting>();
            const bool is_pair = first < objects;
            double* const at = is_pair ? &of_pairs[std::min(1 + end_sums::kPairMeeting * pair_count++,
                                                            of_pairs.size() - end_sums::kPairMeeting)]
                                       : &actual[((first - objects) * objects + object) * end_sums::kMeeting];
            const double bound = 1e-3 * (0.1 + meeting.size);
            error_.add(at[end_sums::kMetTime], meeting.time, 1e-7);
            error_.add(at[end_sums::kMetSpeed], meeting.speed, 1e-3);
            error_.add(at[end_sums::kMetEnergy], meeting.energy, 1e-3 * (1.0 + std::abs(meeting.energy)));
            error_.add(at[end_sums::kMetSize], meeting.size, bound);
            for (int i = 0; i < 3; ++i) {
                error_.add(at[end_sums::kMetImpulse + static_cast<unsigned>(i)], meeting.impulse[i], bound);
                error_.add(at[end_sums::kMetArm + static_cast<unsigned>(i)], meeting.arm[i], bound);
            }
            if (is_pair) {
                error_.fail_if(at[end_sums::kMetFirst] != static_cast<double>(first) ||
                               at[end_sums::kMetSecond] != static_cast<double>(object));
                for (int i = 0; i < 3; ++i)
                    error_.add(at[end_sums::kMetHeld + static_cast<unsigned>(i)], meeting.held[i], bound);
            }
            at[end_sums::kMetTime] = 0.0;
        }
        error_.fail_if(of_pairs[0] != static_cast<double>(pair_count));
        for (std::size_t m = 0; m < actual.size() / end_sums::kMeeting; ++m)
            error_.fail_if(actual[m * end_sums::kMeeting + end_sums::kMetTime] != 0.0);
    }

    const EndCase& at_;
    const Model& model_;
    gpu::ModelBuffers buffers_;
    ContactSurface surface_;
    gpu::StepState state_;
    gpu::StepSystem system_;
    gpu::PartEnd end_;
    EndReference reference_;
    cpu::Pulls<double> pulls_;
    std::optional<gpu::SumLoads> loads_;
    StepClock clock_{};
    bool was_struck_ = false, was_guarded_ = false, was_torn_ = false;
    std::uint32_t largest_island_ = 0;
    double rounding_ = 0.0;  // of accelerations [m/s^2]
    WorstError error_;
};

}  // namespace

double end_error(const EndCase& at) {
    return EndOfParts(at).run();
}

std::vector<glm::vec4> velocities_after(const EndCase& at) {
    EndOfParts ends(at);
    ends.run();
    return ends.velocities();
}

void use_programs(const EndCase& at) {
    EndOfParts(at).use_programs();
}

}  // namespace gelatin::test
