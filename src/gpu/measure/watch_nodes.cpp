#include "gpu/measure/watch_nodes.h"

#include <cstring>

namespace gelatin::gpu {

WatchNodes::WatchNodes()
    : program_(gl::Program::compute("sim/measure/watch_nodes.comp")),
      alarm_(std::span<const Alarm>(&kNoAlarm, 1)) {}

void WatchNodes::run(const ModelBuffers& model, const NodeBuffers& nodes, std::uint32_t step_number,
                     double most_energy) const {
    program_.bind("positions", nodes.position_texels);
    program_.bind("velocities", nodes.velocity_texels);
    program_.bind("Alarms", alarm_);
    program_.set("node_count", model.node_count);
    program_.set("step_number", step_number);
    program_.set("most_energy", static_cast<float>(most_energy));
    program_.dispatch(model.node_count);
}

Alarm WatchNodes::alarm(bool wait) {
    constexpr std::size_t kMostUnderWay = 2;  // no new query if a GPU is far behind
    if (wait || readback_.pending() < kMostUnderWay) readback_.begin(alarm_.id(), sizeof(Alarm));
    while (readback_.pending() > 0 && (wait || readback_.ready()))
        std::memcpy(&known_, readback_.take().data(), sizeof(Alarm));
    return known_;
}

void WatchNodes::forget() {
    alarm(true);  // so that no old result is pending
    alarm_.upload(std::span<const Alarm>(&kNoAlarm, 1));
    known_ = kNoAlarm;
}

}  // namespace gelatin::gpu
