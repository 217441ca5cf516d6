#include "sim/made_attachments.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/archive.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "model/assembly/attachments.h"
#include "model/scene/parse_scene.h"
#include "model/scene/scene_writer.h"
#include "sim/carry_over.h"

namespace gelatin {
namespace {

// As an archive has it.
struct Memory {
    std::vector<std::uint8_t> is_broken;  // by attachment
    std::vector<char> text;               // of a scene file, with the tables of those that programs have made
    std::vector<std::uint32_t> sets;      // by these, in which of the next
    std::vector<glm::vec4> positions;     // of all nodes, one set after the other

    void archive(Archive& archive) {
        archive.list(is_broken);
        archive.list(text);
        archive.list(sets);
        archive.list(positions);
    }
};

}  // namespace

MadeAttachments::MadeAttachments(const Scene& scene, const Model& model, std::span<const glm::vec4> positions)
    : all(make_attachments(scene, model, positions)), of_scene(all.size()) {}

void MadeAttachments::add(const AttachmentDescription& description, std::span<const glm::vec4> positions,
                          Scene& scene, const Model& model) {
    Scene next = scene;
    const std::optional<std::size_t> broken = find_broken(description.name, scene);
    if (broken) next.attachments[*broken].name.clear();
    next.attachments.push_back(description);
    validate(next);
    all.push_back(make_attachment(description, all.size(), next, model, positions));
    if (broken) all[*broken].name = name_of_attachment(next.attachments[*broken], *broken);
    scene.attachments = std::move(next.attachments);
}

std::optional<std::size_t> MadeAttachments::find_broken(const std::string& name, const Scene& scene) const {
    for (std::size_t a = of_scene; a < all.size(); ++a)
        if (all[a].is_broken && scene.attachments[a].name == name) return a;
    return {};
}

std::string MadeAttachments::memory(const Scene& scene) const {
    Memory memory;
    for (const Attachment& attachment : all) memory.is_broken.push_back(attachment.is_broken ? 1 : 0);
    const bool any_broken =
        std::find(memory.is_broken.begin(), memory.is_broken.end(), 1) != memory.is_broken.end();
    if (!any_broken && all.size() == of_scene) return {};
    std::vector<AttachmentDescription> added;
    std::uint32_t count = 0;
    for (std::size_t a = of_scene; a < all.size(); ++a) {
        added.push_back(scene.attachments[a]);
        if (a == of_scene || all[a].positions != all[a - 1].positions) {
            memory.positions.insert(memory.positions.end(), all[a].positions->begin(),
                                    all[a].positions->end());
            ++count;
        }
        memory.sets.push_back(count - 1);
    }
    const std::string text = to_toml(added);
    memory.text.assign(text.begin(), text.end());
    std::string bytes;
    Archive archive = Archive::that_writes(bytes);
    memory.archive(archive);
    return bytes;
}

void MadeAttachments::reset(Scene& scene) {
    all.resize(of_scene);
    scene.attachments.resize(of_scene);
    for (Attachment& attachment : all) attachment.is_broken = false;
}

void MadeAttachments::restore(const std::string& bytes, Scene& scene, const Model& model) {
    if (bytes.empty()) return reset(scene);
    Memory memory;
    Archive archive = Archive::that_reads(bytes);
    memory.archive(archive);
    std::vector<AttachmentDescription> added;
    if (archive.is_complete()) added = parse_attachments({memory.text.begin(), memory.text.end()});
    const std::size_t nodes = model.positions.size();
    const bool fits = archive.is_complete() && memory.sets.size() == added.size() &&
                      memory.is_broken.size() == of_scene + added.size() &&
                      std::all_of(memory.sets.begin(), memory.sets.end(), [&](std::uint32_t set) {
                          return (set + std::size_t(1)) * nodes <= memory.positions.size();
                      });
    if (!fits) throw InvalidInput("it has other attachments");
    MadeAttachments made = *this;
    Scene next = scene;
    made.reset(next);
    for (std::size_t k = 0; k < added.size(); ++k) {
        added[k].line = 0;  // of no file
        made.add(added[k], std::span(memory.positions).subspan(memory.sets[k] * nodes, nodes), next, model);
    }
    for (std::size_t a = 0; a < made.all.size(); ++a) made.all[a].is_broken = memory.is_broken[a] != 0;
    *this = std::move(made);
    scene.attachments = std::move(next.attachments);
}

void MadeAttachments::go_on_from(const MadeAttachments& from, const Scene& from_scene,
                                 const Model& from_model, const State& start, Scene& scene,
                                 const Model& model) {
    reset(scene);
    for (std::size_t a = 0; a < from.all.size(); ++a) {
        const AttachmentDescription& description = from_scene.attachments[a];
        if (a < from.of_scene) {
            const auto same = find_same(from_scene, a, scene);
            if (same) all[*same].is_broken = from.all[a].is_broken;
            continue;
        }
        try {  // also what is broken, so that others keep their places
            const State when_made{*from.all[a].positions, from_model.velocities, {}};
            add(description, carried_over(from_model, when_made, model, start).positions, scene, model);
            all.back().is_broken = from.all[a].is_broken;
        } catch (const InvalidInput& error) {
            log_warning(std::string("no longer attached: ") + error.what());
        }
    }
}

}  // namespace gelatin
