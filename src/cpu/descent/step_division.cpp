#include "cpu/descent/step_division.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cpu/contact/planes.h"
#include "model/lumped_masses.h"

namespace gelatin::cpu {
namespace {

constexpr int kMostParts = 16;
// A part for each of these that bodies meet with: some of what gravity adds in a step of a frame [m/s].
constexpr double kLivelySpeed = 0.125;
// Parts of the time that a pressure wave takes through a body, of whose impact they leave 85%.
constexpr double kPartsAWave = 48.0;
// An impact takes so many of these times. Where that is less than two of the shortest parts, they are no
// help.
constexpr double kWavesAnImpact = 8.0, kLeastParts = 2.0;
// Contacts of all parts cost up to so much of what sweeps do: by nodes and pairs.
constexpr double kPairsASweptNode = 1.3;
constexpr double kMeetsNothing = -1.0;

}  // namespace

template <class Real>
StepDivision<Real>::StepDivision(std::shared_ptr<const Model> model, std::span<const double> wave_times)
    : model_(std::move(model)),
      wave_times_(wave_times),
      masses_(free_lumped_masses(*model_)),
      velocities_(model_->body_count()),
      speeds_(model_->body_count()),
      liveliness_(model_->body_count()) {}

template <class Real>
void StepDivision<Real>::restart() {
    std::fill(liveliness_.begin(), liveliness_.end(), 0.0);
}

template <class Real>
int StepDivision<Real>::parts(double step, const Nodes<Real>& nodes,
                              std::span<const std::uint8_t> touched_colliders, const Contacts<Real>* contacts,
                              int sweeps) {
    find_velocities(nodes.velocities);
    find_speeds(step, nodes.positions, touched_colliders, contacts);
    double parts = 1.0;
    for (std::size_t o = 0; o < speeds_.size(); ++o) {
        const double wave = wave_times_[o], impact = kWavesAnImpact * wave;
        // Bodies that are most compressed stand still: what they met with fades by half while an impact
        // takes.
        const double left = std::exp2(-step / impact) * liveliness_[o];
        liveliness_[o] = speeds_[o] != kMeetsNothing ? std::max(speeds_[o], left) : 0.0;
        if (impact < kLeastParts * step / kMostParts) continue;
        parts = std::max(parts, std::min(liveliness_[o] / kLivelySpeed, kPartsAWave * step / wave));
    }
    if (contacts != nullptr && !contacts->list().pairs.empty()) {
        const double swept = static_cast<double>(sweeps) * static_cast<double>(model_->node_count());
        parts =
            std::min(parts, kPairsASweptNode * swept / static_cast<double>(contacts->list().pairs.size()));
    }
    return std::clamp(static_cast<int>(std::ceil(parts)), 1, kMostParts);
}

template <class Real>
void StepDivision<Real>::find_velocities(std::span<const Vec4<Real>> velocities) {
    for (std::size_t o = 0; o < velocities_.size(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        glm::dvec3 momentum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            if (model_->positions[n].w > 0.0f)
                momentum += static_cast<double>(model_->masses[n]) * glm::dvec3(velocities[n]);
        }
        velocities_[o] = masses_[o] > 0.0 ? momentum / masses_[o] : glm::dvec3(0.0);
    }
}

// With planes, along their normals: what slides meets nothing by that. Of what meets others all its speed
// counts: over edges between faces friction is better in short steps.
template <class Real>
void StepDivision<Real>::find_speeds(double step, std::span<const Vec4<Real>> positions,
                                     std::span<const std::uint8_t> touched_colliders,
                                     const Contacts<Real>* contacts) {
    const bool has_planes_only = std::all_of(model_->colliders.begin(), model_->colliders.end(),
                                             [](const Collider& collider) { return collider.kind == 0; });
    for (std::size_t o = 0; o < speeds_.size(); ++o) {
        speeds_[o] = plane_speed(step, positions, o);
        if (touched_colliders[o] != 0)
            speeds_[o] = has_planes_only ? std::max(speeds_[o], 0.0) : glm::length(velocities_[o]);
    }
    if (contacts == nullptr || !contacts->list().is_valid) return;
    const std::vector<glm::dvec3> relative = find_relative(*contacts);
    std::vector<Vec3<Real>> motions(model_->objects.size());
    for (std::size_t o = 0; o < speeds_.size(); ++o) motions[o] = Vec3<Real>(step * velocities_[o]);
    const std::vector<std::uint8_t> meets = contacts->find_meeting(motions);
    for (std::size_t o = 0; o < speeds_.size(); ++o)
        if (meets[o] != 0) speeds_[o] = std::max(speeds_[o], glm::length(relative[o]));
}

// Velocities of bodies besides the mean of their island; where something is held, or a plane is met, whole.
template <class Real>
std::vector<glm::dvec3> StepDivision<Real>::find_relative(const Contacts<Real>& contacts) const {
    const ContactList<Real>& list = contacts.list();
    std::vector<glm::dvec3> momenta(list.shifts.size(), glm::dvec3(0.0));
    std::vector<double> masses(list.shifts.size());
    std::vector<std::uint8_t> is_held(list.shifts.size());
    for (std::size_t o = 0; o < speeds_.size(); ++o) {
        const std::size_t i = list.islands[o];
        momenta[i] += masses_[o] * velocities_[o];
        masses[i] += masses_[o];
        if (speeds_[o] != kMeetsNothing || contacts.is_held(o) || list.is_fixed[i] != 0) is_held[i] = 1;
    }
    std::vector<glm::dvec3> relative = velocities_;
    for (std::size_t o = 0; o < speeds_.size(); ++o) {
        const std::size_t i = list.islands[o];
        if (is_held[i] == 0 && masses[i] > 0.0) relative[o] -= momenta[i] / masses[i];
    }
    return relative;
}

// With planes that the body touches, or will within this step, as it goes on average.
template <class Real>
double StepDivision<Real>::plane_speed(double step, std::span<const Vec4<Real>> positions,
                                       std::size_t object) const {
    const Range& nodes = model_->objects[object].nodes;
    double fastest = kMeetsNothing;
    for (const Collider& collider : model_->colliders) {
        if (collider.kind != 0) continue;
        const double speed = std::abs(glm::dot(glm::dvec3(collider.center), velocities_[object]));
        const auto least =
            least_height<Real>(positions.subspan(nodes.first, nodes.count), Vec3<Real>(collider.center));
        const double height = static_cast<double>(least) - static_cast<double>(collider.center.w);
        if (height < step * speed) fastest = std::max(fastest, speed);
    }
    return fastest;
}

template class StepDivision<float>;
template class StepDivision<double>;

}  // namespace gelatin::cpu
