#include "film_frames.h"

#include <fmt/core.h>
#include <unistd.h>

#include <memory>

#include "core/file_writer.h"
#include "sim/simulator_internals.h"

namespace gelatin {

FilmFrames::FilmFrames(const std::filesystem::path& film, const Simulator& simulator)
    : file_((scratch_folder(film) / fmt::format("{}.frames-{}.gel", film.filename().string(), ::getpid()))
                .lexically_normal()) {
    writer_.emplace(file_, simulator);
}

FilmFrames::~FilmFrames() {
    writer_.reset();
    std::error_code error;  // somebody else removed it
    std::filesystem::remove(file_, error);
}

void FilmFrames::add(const Simulator& simulator) {
    writer_->write(simulator);
    is_empty_ = false;
}

Simulator FilmFrames::play(const Simulator& simulator) {
    writer_->finish();
    writer_.reset();
    SimulatorOptions options;
    options.use_current_context = true;
    return SimulatorInternals::make(std::make_shared<const Recording>(file_),
                                    SimulatorInternals::share_model(simulator), options);
}

}  // namespace gelatin
