#include "gelatin/recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <utility>

#include "gelatin/error.h"
#include "sim/checkpoint.h"
#include "sim/recording/recording_file.h"
#include "sim/recording/recording_internals.h"

namespace gelatin {

struct Recording::Impl {
    explicit Impl(const std::filesystem::path& file) : input(file), scene(scene_of(input)) {}

    static Scene scene_of(const RecordingInput& input) {
        try {
            return restored_scene(input.head().scene);
        } catch (const InvalidInput& error) {
            if (!error.problem().file.empty()) throw;
            throw InvalidInput({input.file().string(), 0, {}, {}, error.problem().problem});
        }
    }

    RecordingInput input;
    Scene scene;
    EarlierNeighbours neighbours;  // of the model
    // Read last.
    RecordedFrame frame;
    std::optional<std::size_t> index;
};

Recording::Recording(const std::filesystem::path& file) : impl_(std::make_unique<Impl>(file)) {}
Recording::~Recording() = default;

const std::filesystem::path& Recording::file() const {
    return impl_->input.file();
}
const Scene& Recording::scene() const {
    return impl_->scene;
}
std::size_t Recording::frame_count() const {
    return impl_->input.entries().size();
}
int Recording::frame(std::size_t index) const {
    return impl_->input.entries()[index].frame;
}
double Recording::time(std::size_t index) const {
    return impl_->input.entries()[index].time;
}
bool Recording::is_cut_off() const {
    return impl_->input.is_cut_off();
}

std::size_t Recording::index_of(int frame) const {
    const std::vector<RecordingEntry>& entries = impl_->input.entries();
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const RecordingEntry& entry) { return entry.frame == frame; });
    if (found == entries.end())
        throw InvalidInput({file().string(), 0, "frame", std::to_string(frame),
                            fmt::format("is not recorded; there are {} from {} to {}", entries.size(),
                                        entries.front().frame, entries.back().frame)});
    return static_cast<std::size_t>(found - entries.begin());
}

void RecordingInternals::require_fits(const Recording& recording, const Model& model) {
    if (recording.impl_->input.head().topology != topology_hash(model))
        throw InvalidInput(
            {recording.file().string(), 0, {}, {}, "was made from other meshes than those of this scene"});
}

const RecordedFrame& RecordingInternals::frame(const Recording& recording, const Model& model,
                                               std::size_t index) {
    Recording::Impl& d = *recording.impl_;
    const std::vector<RecordingEntry>& entries = d.input.entries();
    const auto refuse = [&](const std::string& problem) {
        throw InvalidInput({recording.file().string(), 0, {}, {}, problem});
    };
    if (d.neighbours.empty()) d.neighbours = earlier_neighbours(model);
    std::size_t first = index;
    while (!entries[first].is_key) --first;
    if (d.index && *d.index >= first && *d.index <= index) first = *d.index + 1;
    for (std::size_t k = first; k <= index; ++k) {
        const bool is_key = entries[k].is_key;
        d.index.reset();
        try {
            d.frame =
                decoded_frame(d.input.read(entries[k]), model, d.neighbours, is_key ? nullptr : &d.frame);
        } catch (const InvalidInput& error) {
            if (!error.problem().file.empty()) throw;
            refuse(fmt::format("frame {} {}", entries[k].frame, error.problem().problem));
        }
        d.index = k;
    }
    return d.frame;
}

bool is_recording(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    char magic[8] = {};
    stream.read(magic, sizeof(magic));
    return stream && std::equal(magic, magic + sizeof(magic), "GELATREC");
}

}  // namespace gelatin
