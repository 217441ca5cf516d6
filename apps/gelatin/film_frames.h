#pragma once

#include <filesystem>
#include <optional>

#include "gelatin/recording.h"
#include "gelatin/simulator.h"

namespace gelatin {

/// The frames of a film until all are known and its camera can be chosen: a recording beside the film, which
/// goes with this object.
class FilmFrames {
public:
    /// @throws SystemError
    FilmFrames(const std::filesystem::path& film, const Simulator& simulator);
    FilmFrames(const FilmFrames&) = delete;
    FilmFrames& operator=(const FilmFrames&) = delete;
    ~FilmFrames();

    /// The simulator's present frame. @throws as RecordingWriter::write
    void add(const Simulator& simulator);

    /// Plays them, in the context of the simulator, which is current. @throws SystemError
    Simulator play(const Simulator& simulator);

    bool is_empty() const { return is_empty_; }

private:
    std::filesystem::path file_;
    std::optional<RecordingWriter> writer_;
    bool is_empty_ = true;
};

}  // namespace gelatin
