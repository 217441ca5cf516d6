#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "model/drive/handles.h"
#include "model/model.h"

namespace gelatin {

/// Where a run's handles have their nodes, relative to their pivots: as animations and programs move them.
class HandleArms {
public:
    /// A movement that a program wants: from where nodes are to where they are to be.
    struct Programmed {
        double from = 0.0, until = 0.0;      ///< [s]
        std::vector<glm::dvec3> begin, end;  ///< arms [m]
    };

    /// @param programmed by object
    explicit HandleArms(std::shared_ptr<const Model> model,
                        std::map<std::size_t, Programmed> programmed = {});

    /// Forgets what programs wanted.
    void restart() { programmed_.clear(); }

    /// The nodes of a handle go from where they are at `from` to where vertices have them at `until` [s].
    /// @pre the handle is a collider's, and has an animation without a motion
    void move(std::size_t handle, const std::vector<glm::dvec3>& vertices, double from, double until);

    /// What programs wanted.
    const std::map<std::size_t, Programmed>& programmed() const { return programmed_; }
    /// Whether a program moves nodes after this time.
    bool is_under_way(double time) const;

    /// Of a handle's nodes at its time [m], in the order of Model::handle_nodes.
    std::vector<glm::dvec3> at(std::size_t handle, double time) const;

    /// Their mean at that time [m].
    glm::dvec3 middle(std::size_t handle, double time) const;

    /// The places of all handles' nodes [m], shape [Model::handle_nodes].
    std::vector<glm::dvec3> places(std::span<const HandlePose> poses, std::span<const double> times) const;

    /// How the nodes of animated handles move over a step between times of theirs, by HandleNode::animated.
    /// @param before and after the drags at both ends
    std::vector<NodeMotion> motions(std::span<const Drag> before, std::span<const Drag> after,
                                    const HandleTimes& times, double step) const;

    /// Writes or reads what programs wanted. @return whether that fits this model
    bool archive(Archive& archive);

private:
    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> first_;  // of each handle's in Model::handle_nodes
    std::map<std::size_t, Programmed> programmed_;
};

}  // namespace gelatin
