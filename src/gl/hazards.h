#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gl/hazard_tracker.h"

namespace gelatin::gl {

/// Watches what the GL layer does for accesses to buffers that no barrier orders (hazard_tracker.h). Software
/// drivers forgive a missing barrier, GPUs do not; this finds it on any driver. Which buffers a command uses
/// is asked of OpenGL itself: what is bound where the program's active blocks, samplerBuffers and attributes
/// look.
///
/// Programs linked before are taken to read and write all their blocks. Stays on for the rest of the process;
/// each context is watched by itself.
void enable_hazard_tracking();

/// What was found since the last call, in all contexts. Each is in the log, too.
std::vector<std::string> take_hazards();

/// The barriers so far of the current context, and which of their bits were needed.
std::vector<HazardTracker::BarrierSite> barrier_sites();

/// One line for each barrier of all contexts that has bits that no access needed, sorted. Any one of them may
/// go; two that stand in for each other may not both.
std::vector<std::string> unneeded_barriers();

/// Barriers made there are not counted in the current context, until count_all_barriers().
void suppress_barrier(CallSite where);
void count_all_barriers();

/// Keeps what the current context does from now on; take_gpu_events() ends it.
void record_gpu_events();
std::vector<GpuEvent> take_gpu_events();

/// What the GL layer reports of its calls, before it makes them.
class HazardProbe {
public:
    void linked(unsigned program, const std::string& name, const std::string& source);
    void dispatches(unsigned program);
    void dispatches_indirectly(unsigned program, unsigned arguments);
    /// With the program and the vertex array in use. `arguments` is 0 for a draw that is not indirect.
    void draws(bool has_elements, unsigned arguments = 0);
    void uploads(unsigned buffer, bool all);
    void clears(unsigned buffer);
    void downloads(unsigned buffer);
    void copies(unsigned source, unsigned target);
    void uploads_to_texture(unsigned buffer);
    void makes_barrier(Barrier bits, CallSite where);
    /// A name that was given to a new buffer, or is given back.
    void resets(unsigned buffer);
};

/// Null while hazards are not tracked.
inline HazardProbe* hazard_probe = nullptr;

}  // namespace gelatin::gl
