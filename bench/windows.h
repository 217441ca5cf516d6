#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/paper_cases.h"
#include "gelatin/scene.h"

namespace gelatin {

/// Frames that are timed together.
struct BenchWindow {
    std::filesystem::path start;  ///< checkpoint of the state before the first frame
    int frames;
};

/// The frames of a scene that a benchmark times: a whole run, or windows distributed evenly over it, so that
/// frames in contact have the same share as in the whole.
///
/// The windows' first states are saved by a run of the fastest system, because the slow ones would take
/// hours.
class BenchWindows {
public:
    /// Simulates `scene` up to `frames`. Needs a context.
    /// @param folder for the states; must outlive this
    BenchWindows(const Scene& scene, int frames, int windows, int window_frames,
                 const std::filesystem::path& folder);

    /// Length of a part; 0 if the bodies touch from the start.
    int frames(BenchPart part) const { return part == BenchPart::whole_run ? frames_ : contact_free_frames_; }

    BenchWindow whole(BenchPart part) const { return {state_file(0), frames(part)}; }
    std::vector<BenchWindow> sample(BenchPart part) const;

private:
    int count_contact_free_frames(const Scene& scene) const;
    void save_states(const Scene& scene) const;
    std::filesystem::path state_file(int frame) const;

    int frames_, windows_, window_frames_;
    int contact_free_frames_;
    std::filesystem::path folder_;
};

/// The first frames of `count` windows of `length` frames that divide `frames` evenly, each in the centre of
/// its part; fewer if there is not enough room.
std::vector<int> window_starts(int frames, int count, int length);

}  // namespace gelatin
