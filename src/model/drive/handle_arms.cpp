#include "model/drive/handle_arms.h"

#include <algorithm>
#include <glm/common.hpp>
#include <tuple>
#include <utility>

#include "model/drive/handle_animation.h"

namespace gelatin {

HandleArms::HandleArms(std::shared_ptr<const Model> model, std::map<std::size_t, Programmed> programmed)
    : model_(std::move(model)), first_(model_->handles.size()), programmed_(std::move(programmed)) {
    const std::vector<HandleNode>& nodes = model_->handle_nodes;
    for (std::size_t h = nodes.size(); h-- > 0;) first_[nodes[h].handle] = static_cast<std::uint32_t>(h);
}

void HandleArms::move(std::size_t handle, const std::vector<glm::dvec3>& vertices, double from,
                      double until) {
    const Handle& moved = model_->handles[handle];
    programmed_[moved.object] = {from, until, at(handle, from), moved.animation->arms(vertices)};
}

bool HandleArms::is_under_way(double time) const {
    return std::any_of(programmed_.begin(), programmed_.end(),
                       [&](const auto& each) { return time < each.second.until; });
}

std::vector<glm::dvec3> HandleArms::at(std::size_t handle, double time) const {
    const Handle& of = model_->handles[handle];
    if (of.animation && of.animation->motion) return of.animation->arms(of.animation->motion->at(time));
    std::vector<glm::dvec3> arms;
    if (const auto found = programmed_.find(of.object); found != programmed_.end()) {
        const Programmed& programmed = found->second;
        const double share =
            std::clamp((time - programmed.from) / (programmed.until - programmed.from), 0.0, 1.0);
        for (std::size_t k = 0; k < programmed.end.size(); ++k)
            arms.push_back(glm::mix(programmed.begin[k], programmed.end[k], share));
        return arms;
    }
    for (std::size_t k = 0; k < of.count; ++k)
        arms.emplace_back(model_->handle_nodes[first_[handle] + k].arm);
    return arms;
}

glm::dvec3 HandleArms::middle(std::size_t handle, double time) const {
    if (!model_->handles[handle].animation) return model_->handles[handle].middle;
    const std::vector<glm::dvec3> arms = at(handle, time);
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& arm : arms) sum += arm / static_cast<double>(arms.size());
    return sum;
}

std::vector<glm::dvec3> HandleArms::places(std::span<const HandlePose> poses,
                                           std::span<const double> times) const {
    std::vector<glm::dvec3> places;
    for (std::size_t h = 0; h < poses.size(); ++h)
        for (const glm::dvec3& arm : at(h, times[h])) places.push_back(poses[h].place(arm));
    return places;
}

std::vector<NodeMotion> HandleArms::motions(std::span<const Drag> before, std::span<const Drag> after,
                                            const HandleTimes& times, double step) const {
    std::vector<NodeMotion> motions;
    for (std::size_t h = 0; h < model_->handles.size(); ++h) {
        const Handle& handle = model_->handles[h];
        if (!handle.animation) continue;
        const HandlePose start = pose_at(handle, times.begin[h], before[h]),
                         end = pose_at(handle, times.end[h], after[h]);
        const std::vector<glm::dvec3> from = at(h, times.begin[h]), to = at(h, times.end[h]);
        for (std::size_t k = 0; k < from.size(); ++k) {
            const glm::dvec3 place = start.place(from[k]);
            motions.push_back({glm::vec4(glm::vec3(place), 0.0f),
                               glm::vec4(glm::vec3((end.place(to[k]) - place) / step), 0.0f)});
        }
    }
    return motions;
}

bool HandleArms::archive(Archive& archive) {
    const auto written = std::exchange(programmed_, {});
    auto next = written.begin();
    std::size_t count = written.size();
    archive.value(count);
    for (; count > 0; --count) {
        std::size_t object = 0;
        Programmed programmed;
        if (next != written.end()) std::tie(object, programmed) = *next++;
        archive.value(object);
        archive.value(programmed.from);
        archive.value(programmed.until);
        archive.list(programmed.begin);
        archive.list(programmed.end);
        const bool fits =
            std::any_of(model_->handles.begin(), model_->handles.end(), [&](const Handle& handle) {
                return handle.object == object && handle.animation &&
                       handle.count == programmed.begin.size() && handle.count == programmed.end.size();
            });
        if (!fits) return false;
        programmed_.emplace(object, std::move(programmed));
    }
    return true;
}

}  // namespace gelatin
