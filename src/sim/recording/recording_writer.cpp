#include <fmt/core.h>

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "sim/recording/recorded_frame.h"
#include "sim/recording/recording_file.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

// From one that is not predicted to the next: what has to be read for a frame in between.
constexpr std::size_t kKeyInterval = 32;
// Frames that wait for being written: then the simulation waits, too.
constexpr std::size_t kMostWaiting = 4;

RecordingHead head_of(const Simulator& simulator) {
    const Model& model = model_of(simulator);
    return {recorded_scene(SimulatorInternals::own_scene(simulator), model.meshes.get()),
            topology_hash(model)};
}

}  // namespace

struct RecordingWriter::Impl {
    Impl(const std::filesystem::path& of, const RecordingHead& head, const Model& model)
        : file(of),
          output(file, head),
          neighbours(earlier_neighbours(model)),
          writer([this](const std::stop_token& stop) { run(stop); }) {}

    void add(RecordedFrame frame) {
        const int number = frame.moment.frame;
        if (number <= newest)
            throw InvalidInput({file.string(), 0, "frame", std::to_string(number),
                                fmt::format("must be after frame {}, which is recorded: after a reset, or an "
                                            "earlier checkpoint, another recording begins",
                                            newest)});
        newest = number;
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return waiting.size() < kMostWaiting || problem; });
        if (problem) std::rethrow_exception(problem);
        waiting.push_back(std::move(frame));
        changed.notify_all();
    }

    void finish() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return (waiting.empty() && !is_writing) || problem; });
        if (problem) std::rethrow_exception(problem);
    }

    // All that waits is written, also when it is asked to stop.
    void run(const std::stop_token& stop) {
        for (;;) {
            std::unique_lock lock(mutex);
            changed.wait(lock, stop, [&] { return !waiting.empty(); });
            if (waiting.empty() || problem) return;
            RecordedFrame frame = std::move(waiting.front());
            waiting.pop_front();
            is_writing = true;
            changed.notify_all();
            lock.unlock();
            std::exception_ptr failed;
            try {
                append(std::move(frame));
            } catch (...) {
                failed = std::current_exception();
            }
            lock.lock();
            is_writing = false;
            problem = failed;
            changed.notify_all();
        }
    }

    void append(RecordedFrame frame) {
        const bool is_key = count++ % kKeyInterval == 0;
        const std::string bytes = encoded_frame(frame, neighbours, is_key ? nullptr : &last);
        RecordingEntry entry;
        entry.frame = frame.moment.frame;
        entry.time = frame.moment.time;
        entry.is_key = is_key;
        output.append(entry, bytes);
        last = std::move(frame);
    }

    const std::filesystem::path file;
    int newest = -1;  // of the frames that were added
    RecordingOutput output;
    EarlierNeighbours neighbours;
    std::size_t count = 0;
    RecordedFrame last;  // written
    std::mutex mutex;
    std::condition_variable_any changed;
    std::deque<RecordedFrame> waiting;
    bool is_writing = false;
    std::exception_ptr problem;
    std::jthread writer;  // last: it uses all others
};

RecordingWriter::RecordingWriter(const std::filesystem::path& file, const Simulator& simulator)
    : impl_(std::make_unique<Impl>(file, head_of(simulator), model_of(simulator))) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;

RecordingWriter::~RecordingWriter() {
    if (!impl_) return;
    try {
        impl_->finish();
    } catch (const std::exception& error) {
        log_warning(error.what());
    }
}

void RecordingWriter::write(const Simulator& simulator) {
    simulator.check();
    impl_->add(SimulatorInternals::recorded_frame(simulator));
}

void RecordingWriter::finish() {
    impl_->finish();
}

}  // namespace gelatin
