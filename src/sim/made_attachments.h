#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/drive/attachment.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// The attachments of a run: those of the scene, then those that programs have made, which Scene::attachments
/// has, too.
struct MadeAttachments {
    std::vector<Attachment> all;
    std::size_t of_scene = 0;

    MadeAttachments() = default;
    /// Those of a scene. @throws InvalidInput as make_attachments
    MadeAttachments(const Scene& scene, const Model& model, std::span<const glm::vec4> positions);
    /// Another one, which takes its name from a broken one that a program has made.
    /// @param scene output: has it, too @throws InvalidInput as validate() and make_attachment
    void add(const AttachmentDescription& description, std::span<const glm::vec4> positions, Scene& scene,
             const Model& model);
    /// Which are broken, and what programs have made, where nodes were then; empty: nothing.
    std::string memory(const Scene& scene) const;
    /// As at the start. @param scene output: its attachments
    void reset(Scene& scene);
    /// Goes back to that. @param scene output: its attachments
    /// @throws InvalidInput if it does not fit; then nothing has changed
    void restore(const std::string& bytes, Scene& scene, const Model& model);
    /// Takes over from another simulation what is broken of attachments that have the name, the object and
    /// the kind of one there; and what programs have made there, as far as it can be made here.
    /// @param start of this simulation @param scene output: its attachments
    void go_on_from(const MadeAttachments& from, const Scene& from_scene, const Model& from_model,
                    const State& start, Scene& scene, const Model& model);

private:
    // That a program has made.
    std::optional<std::size_t> find_broken(const std::string& name, const Scene& scene) const;
};

}  // namespace gelatin
