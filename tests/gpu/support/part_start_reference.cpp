#include "gpu/support/part_start_reference.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "core/archive.h"
#include "cpu/contact/tuning.h"
#include "cpu/drive/pulls.h"
#include "cpu/drive/sum_loads.h"
#include "cpu/implicit/contact_rows.h"
#include "cpu/implicit/islands.h"
#include "cpu/implicit/paces.h"
#include "cpu/implicit/step_system.h"
#include "cpu/implicit/time_scheme.h"
#include "gpu/support/pull_on_gpu.h"
#include "model/contact/contact_surface.h"
#include "support/converted.h"
#include "support/elastic_cases.h"

namespace gelatin::test {
namespace {

using cpu::ContactRow;
using Field = std::vector<glm::dvec3>;
namespace tuning = cpu::tuning;

class Reference {
public:
    explicit Reference(const StartCase& at)
        : case_(at),
          model_(*at.model),
          surface_(std::make_shared<ContactSurface>(make_contact_surface(model_, {}))),
          pairs_of_(at.model, surface_, true),
          rows_of_(at.model, surface_),
          scheme_(at.model),
          paces_(at.model),
          system_(at.model),
          pulls_(model_.node_count()),
          previous_{converted<double>(model_.positions), converted<double>(model_.velocities)} {
        inputs_.memories.resize(model_.colliders.size() * model_.body_node_count());
        for (const cpu::Vec3<float>& v : random_field<float>(model_.node_count(), 5))
            inputs_.earlier_velocities.push_back(
                glm::vec4(glm::vec3(model_.velocities[inputs_.earlier_velocities.size()]) + 0.05f * v, 0.0f));
        if (at.has_pulls) inputs_.pulls = make_pulls(model_);
        pulls_.set_pulls(inputs_.pulls);
        if (!model_.loads.empty()) {
            loads_.assign(model_.node_count(), glm::dvec4(0.0));
            cpu::sum_loads<double>(model_.loads, std::vector<float>(model_.loads.spans.size(), 1.0f),
                                   previous_.positions, loads_);
        }
        std::string bytes(at.paces.begin(), at.paces.end());
        bytes.append(at.struck.begin(), at.struck.end());
        Archive archive = Archive::that_reads(bytes);
        paces_.archive(archive);
        if (at.last_step > 0.0f)
            scheme_.go_on(previous_, converted<double>(inputs_.earlier_velocities),
                          static_cast<double>(at.last_step));
        if (at.has_memory) remember();
    }

    const StartInputs& inputs() const { return inputs_; }

    StartResult run() {
        const auto size = static_cast<double>(case_.size);
        double step = size;
        if (case_.left > 0.0f) {
            step = 0.6 * static_cast<double>(case_.left);
            for (std::uint32_t n = 0; n < model_.node_count(); ++n)
                if (previous_.positions[n].w == 0.0)
                    previous_.velocities[n] *= size / static_cast<double>(case_.left);
        }
        StartResult result;
        StepClock& clock = result.clock;
        bool damps = case_.damps;
        for (;;) {
            clock.tries += 1;
            const bool is_shortest = step < 2.0 * size / tuning::kMostParts;
            predict(step);
            const NearPairs& near = result.near.emplace_back(find_pairs(previous_.positions, is_shortest));
            const bool is_found = is_shortest || near.fastest <= static_cast<float>(tuning::kFastest);
            if (is_found)
                rows_of_.make({previous_.positions, predicted_, compliances_, step,
                               static_cast<double>(case_.last_step)},
                              near.pairs, cpu::AttachmentRows<double>(case_.model), system_.rows);
            clock.parts = paces_.count_parts(system_.rows);
            if (is_found && case_.divides && step >= 1.01 * size / clock.parts) {
                step = size / clock.parts;
                continue;
            }
            if (is_found && (is_shortest || deepest() <= tuning::kDeepest)) {
                choose(step, damps || is_shortest, result);
                break;
            }
            step *= 0.5;
            damps = false;
        }
        clock.step = static_cast<float>(step);
        clock.row_count = static_cast<std::uint32_t>(system_.rows.size());
        find_targets(step);
        find_enough(step);
        linearise(step);
        result.rows = system_.rows;
        result.islands = islands_.of_bodies;
        for (const glm::dvec4& v : previous_.velocities) result.velocities.emplace_back(v);
        result.predicted = predicted_;
        result.compliances = compliances_;
        result.loads = system_.loads;
        result.guesses = system_.displacements;
        result.inertia = system_.inertia;
        result.enough = system_.enough;
        for (double& enough : system_.enough) enough *= 1e-3;
        system_.iterations = kStartIterations;
        system_.solve(islands_.of_bodies);
        result.solved = system_.displacements;
        return result;
    }

private:
    bool acts() const { return !loads_.empty() || !pulls_.nodes().empty(); }

    glm::dvec3 acceleration(std::uint32_t n) const {
        const glm::dvec3 gravity(model_.gravity);
        return loads_.empty() ? gravity : gravity + previous_.positions[n].w * glm::dvec3(loads_[n]);
    }

    void predict(double step) {
        predicted_.clear();
        compliances_.clear();
        const double least = std::max(step, tuning::kFrame);
        for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
            const double w = previous_.positions[n].w, h = surface_->stiffness[n] / 3.0;
            predicted_.push_back(step * glm::dvec3(previous_.velocities[n]) +
                                 (w > 0.0 ? step * step * acceleration(n) : glm::dvec3(0.0)));
            compliances_.push_back(w > 0.0 ? 1.0 / (1.0 / (w * least * least) + h) : 0.0);
        }
    }

    double deepest() const {
        double deepest = 0.0;
        for (const ContactRow<double>& row : system_.rows) {
            const double most = row.object == kNoNode ? surface_->thicknesses[row.other]
                                                      : surface_->reach(row.object, row.other);
            deepest = std::max(deepest, -row.gap_at(cpu::relative<double>(row, predicted_)) / most);
        }
        return deepest;
    }

    // On the way from there to where nodes are predicted.
    NearPairs find_pairs(const std::vector<glm::dvec4>& from, bool is_shortest) {
        NearPairs near;
        if (!case_.has_pairs) return near;
        std::vector<glm::dvec4> to = from;
        for (std::size_t n = 0; n < to.size(); ++n) to[n] += glm::dvec4(predicted_[n], 0.0);
        const cpu::Paths<double> paths{from, to};
        pairs_of_.begin(paths);
        near.fastest = static_cast<float>(pairs_of_.fastest_approach(paths));
        if (near.fastest > static_cast<float>(tuning::kFastest) && !is_shortest) return near;
        pairs_of_.run(paths);
        near.pairs = pairs_of_.pairs();
        for (cpu::NearPair<double>& pair : near.pairs) {
            pair.normal = glm::dvec3(glm::vec3(pair.normal));
            // Of a side they miss 1 by more than rounding does: rows have to mend that.
            pair.weights = glm::dvec4(glm::vec4(1.0001 * pair.weights));
            pair.gap = static_cast<double>(static_cast<float>(pair.gap));
        }
        std::stable_sort(near.pairs.begin(), near.pairs.end(), [](const auto& a, const auto& b) {
            return std::pair(a.pair.object, a.pair.other) < std::pair(b.pair.object, b.pair.other);
        });
        return near;
    }

    // Contacts of nodes near where they are now; a part of them is not known.
    void remember() {
        predict(static_cast<double>(case_.last_step));
        std::vector<glm::dvec4> positions = previous_.positions;
        for (std::size_t n = 0; n < positions.size(); ++n)
            positions[n] += (n % 2 == 0 ? 1.0 : -1.0) * glm::dvec4(1e-4, 2e-4, -1e-4, 0.0);
        for (std::size_t n = 0; n < compliances_.size(); n += 3) compliances_[n] = 0.0;
        std::vector<ContactRow<double>> rows;
        std::vector<cpu::NearPair<double>> near = find_pairs(positions, true).pairs;
        for (std::size_t p = near.size(); p-- > 0;)
            if (p % 5 == 0) near.erase(near.begin() + static_cast<std::ptrdiff_t>(p));
        rows_of_.make({positions, predicted_, compliances_, static_cast<double>(case_.last_step), 0.0}, near,
                      cpu::AttachmentRows<double>(case_.model), rows);
        Field moved;
        for (const cpu::Vec3<double>& d : random_field<double>(model_.node_count(), 8))
            moved.push_back(1e-3 * d);
        for (ContactRow<double>& row : rows) row.limit = 1.0;
        rows_of_.note(rows, moved, std::vector<std::uint8_t>(model_.body_count()));
        rows_of_.remember();
        for (ContactRow<double> row : rows) {
            const glm::dvec3 s = cpu::relative<double>(row, moved);
            row.limit = row.friction * row.pressing(s);
            const glm::vec3 hold(row.limit > 0.0 ? row.held(s) : glm::dvec3(0.0));
            if (row.object != kNoNode) {
                row.hold = glm::dvec3(hold);
                inputs_.known.push_back(row);
                continue;
            }
            inputs_.memories[row.plane() * model_.body_node_count() + row.nodes[0]] = {
                glm::vec4(hold, row.limit), static_cast<float>(row.reach), static_cast<float>(row.ease), 0,
                0};
        }
    }

    // The schemes of bodies, and what these have in common.
    void choose(double step, bool damps, StartResult& result) {
        islands_.find<double>(model_, system_.rows, previous_, acts());
        for (std::uint32_t o = 0; o < model_.body_count(); ++o) {
            BodyPace pace{};
            for (std::uint32_t n = model_.objects[o].nodes.first; n < model_.objects[o].nodes.end(); ++n)
                pace.held_count += previous_.positions[n].w == 0.0 ? 1 : 0;
            pace.pace = case_.paces[o];
            pace.is_struck = case_.struck[o] != 0 || pace.held_count > 0 ? 1 : 0;
            paces_.struck()[o] = static_cast<std::uint8_t>(pace.is_struck);
            const std::uint32_t island = islands_.of_bodies[o];
            pace.is_held = islands_.are_held[island];
            pace.velocity = glm::vec4(islands_.velocities[island], model_.objects[o].mass);
            result.paces.push_back(pace);
        }
        result.clock.has_past = paces_.choose(islands_, step, damps, system_.rows, scheme_) ? 1 : 0;
        for (std::uint32_t o = 0; o < model_.body_count(); ++o) {
            result.paces[o].past = static_cast<float>(scheme_.of(o).past);
            result.paces[o].damping = static_cast<float>(scheme_.of(o).damping);
        }
    }

    void find_targets(double step) {
        const std::vector<std::uint32_t> object_of = model_.node_objects;
        for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
            const glm::dvec4 x = previous_.positions[n];
            const double h = scheme_.of(object_of[n]).step;
            system_.inertia[n] = x.w > 0.0 ? 1.0 / (x.w * h * h) : 0.0;
            system_.displacements[n] =
                x.w > 0.0 ? scheme_.target(previous_, n, acceleration(n)) : predicted_[n];
        }
        for (const std::uint32_t n : pulls_.nodes()) {
            if (system_.inertia[n] == 0.0) continue;
            const glm::dvec3 x(previous_.positions[n]);
            const glm::dvec4 both =
                pulls_.with_target(n, glm::dvec4(x + system_.displacements[n], system_.inertia[n]), x, step);
            system_.displacements[n] = glm::dvec3(both) - x;
            system_.inertia[n] = both.w;
        }
    }

    void find_enough(double step) {
        const double fall = tuning::kHardly * step * glm::length(glm::dvec3(model_.gravity));
        const double rounding = tuning::kRoundings * std::numeric_limits<float>::epsilon() / step;
        std::vector<double> energies(model_.body_count()), of_islands = energies;
        for (std::uint32_t o = 0; o < model_.body_count(); ++o) {
            const Range& nodes = model_.objects[o].nodes;
            const std::uint32_t island = islands_.of_bodies[o];
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
                const glm::dvec3 v = glm::dvec3(previous_.velocities[n]) - islands_.velocities[island],
                                 x(previous_.positions[n]);
                energies[o] += 0.5 * static_cast<double>(model_.masses[n]) *
                               (glm::dot(v, v) + fall * fall + rounding * rounding * glm::dot(x, x));
            }
            of_islands[island] += energies[o];
        }
        for (std::uint32_t o = 0; o < model_.body_count(); ++o) {
            const std::uint32_t island = islands_.of_bodies[o];
            const double share = model_.objects[o].mass / islands_.masses[island];
            system_.enough[o] =
                tuning::kTolerance * (energies[o] + tuning::kNearly * share * of_islands[island]);
        }
    }

    void linearise(double step) {
        const std::vector<std::uint32_t> object_of = model_.node_objects;
        std::vector<glm::dvec4> velocities = previous_.velocities;
        for (std::uint32_t n = 0; n < model_.node_count(); ++n)
            velocities[n].w = std::max(velocities[n].w, scheme_.of(object_of[n]).damping);
        system_.elastic.linearise(previous_.positions, velocities, 1.0 / step);
        system_.rigid.begin(previous_.positions, system_.inertia);
        system_.loads = system_.elastic.forces();
        system_.rigid.follow_rotation(previous_.positions, system_.inertia, system_.displacements,
                                      system_.loads);
        for (std::uint32_t n = 0; n < model_.node_count(); ++n) {
            system_.loads[n] += system_.inertia[n] * system_.displacements[n];
            if (system_.inertia[n] > 0.0 && !system_.rigid.is_free(object_of[n]))
                system_.displacements[n] = step * glm::dvec3(previous_.velocities[n]);
        }
    }

    const StartCase& case_;
    const Model& model_;
    std::shared_ptr<const ContactSurface> surface_;
    cpu::FindPairs<double> pairs_of_;
    cpu::ContactRows<double> rows_of_;
    cpu::TimeScheme<double> scheme_;
    cpu::Paces<double> paces_;
    cpu::StepSystem<double> system_;
    cpu::Pulls<double> pulls_;
    cpu::Islands islands_;
    cpu::Nodes<double> previous_;
    std::vector<glm::dvec4> loads_;
    StartInputs inputs_;
    Field predicted_;
    std::vector<double> compliances_;
};

}  // namespace

std::pair<StartInputs, StartResult> part_start_reference(const StartCase& at) {
    Reference reference(at);
    return {reference.inputs(), reference.run()};
}

}  // namespace gelatin::test
