#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "gelatin/export.h"
#include "gelatin/scene.h"
#include "gelatin/simulator.h"

namespace gelatin {

/// Writes a scene with its meshes, and frames of a run, to a file, from which it can be drawn, exported and
/// continued without simulating again. Frames are kept to the last bit, and compressed on a thread of their
/// own. Each one is in the file once it is written: what a process has recorded until it is killed can be
/// opened.
class GELATIN_API RecordingWriter {
public:
    /// Creates the file; an older one is replaced. @throws SystemError
    RecordingWriter(const std::filesystem::path& file, const Simulator& simulator);
    RecordingWriter(RecordingWriter&&) noexcept;
    RecordingWriter& operator=(RecordingWriter&&) noexcept;
    /// As finish(), but problems go to the log.
    ~RecordingWriter();

    /// Appends the simulator's present frame. Frames ascend: after a reset, or an earlier checkpoint, another
    /// recording begins. @pre it is the simulator of the constructor
    /// @throws InvalidInput unless the frame is later than those written before; Diverged as
    ///   Simulator::check; SystemError if this or an earlier frame could not be written
    void write(const Simulator& simulator);

    /// Waits until all frames are written. @throws SystemError
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// A file of a RecordingWriter. A Simulator plays it.
class GELATIN_API Recording {
public:
    /// @throws InvalidInput if it cannot be read, is no recording, or is damaged before its first frame
    explicit Recording(const std::filesystem::path& file);
    ~Recording();

    const std::filesystem::path& file() const;
    /// What was simulated. It has its meshes: a Simulator can be made of it without their files.
    const Scene& scene() const;

    std::size_t frame_count() const;       ///< at least 1
    int frame(std::size_t index) const;    ///< number of the frame in its run; ascending
    double time(std::size_t index) const;  ///< [s]
    /// The index of a frame by its number. @throws InvalidInput naming those that there are
    std::size_t index_of(int frame) const;
    /// Whether a frame follows that was not written completely, as of a process that was killed.
    bool is_cut_off() const;

private:
    friend struct RecordingInternals;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Whether a file begins as recordings do.
GELATIN_API bool is_recording(const std::filesystem::path& file);

}  // namespace gelatin
