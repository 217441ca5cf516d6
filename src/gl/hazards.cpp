#include "gl/hazards.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/current_stage.h"
#include "core/log.h"
#include "gl/program_access.h"

namespace gelatin::gl {
namespace {

// Text that lives as long as the process, so that trackers and recordings may point at it.
std::string_view keep(const std::string& text) {
    static std::unordered_set<std::string> kept;
    return *kept.insert(text).first;
}

struct ContextState {
    HazardTracker tracker;
    std::unordered_map<unsigned, ProgramAccess> programs;
    std::optional<std::vector<GpuEvent>> recording;
};

std::mutex mutex;
std::map<const void*, ContextState> contexts;
std::vector<std::string> found_hazards;

// A context that EGL does not know, such as a host application's by GLX, is the only one of its kind.
ContextState& current_context() {
    return contexts[epoxy_has_egl() ? eglGetCurrentContext() : nullptr];
}

void apply(ContextState& context, const GpuEvent& event) {
    if (context.recording) context.recording->push_back(event);
    context.tracker.apply(event);
    for (std::string& hazard : context.tracker.take_hazards()) {
        if (std::find(found_hazards.begin(), found_hazards.end(), hazard) != found_hazards.end()) continue;
        log_warning("hazard: " + hazard);
        found_hazards.push_back(std::move(hazard));
    }
}

void apply(const GpuEvent& event) {
    const std::lock_guard lock(mutex);
    apply(current_context(), event);
}

void transfer(GpuCommand::Kind kind, std::string_view name, bool replaces_all,
              std::vector<BufferAccess> accesses) {
    apply(GpuCommand{kind, name, CurrentStage::name(), replaces_all, std::move(accesses)});
}

void run_shaders(unsigned program, std::vector<BufferAccess> fixed_function) {
    const std::lock_guard lock(mutex);
    ContextState& context = current_context();
    const auto [entry, is_new] = context.programs.try_emplace(program);
    if (is_new) entry->second = reflect_accesses(program, fmt::format("program {}", program), {});
    std::vector<BufferAccess> accesses = std::move(fixed_function);
    for (const BoundBuffer& bound : bound_buffers(program, entry->second))
        accesses.push_back({bound.buffer, bound.use, bound.reads, bound.writes, keep(bound.through)});
    apply(context, GpuCommand{GpuCommand::Kind::shader, keep(entry->second.name), CurrentStage::name(), false,
                              std::move(accesses)});
}

BufferAccess indirect_arguments(unsigned buffer) {
    return {buffer, Barrier::command, true, false, "indirect arguments"};
}

}  // namespace

void enable_hazard_tracking() {
    static HazardProbe probe;
    hazard_probe = &probe;
}

std::vector<std::string> take_hazards() {
    const std::lock_guard lock(mutex);
    return std::exchange(found_hazards, {});
}

std::vector<HazardTracker::BarrierSite> barrier_sites() {
    const std::lock_guard lock(mutex);
    return current_context().tracker.barrier_sites();
}

std::vector<std::string> unneeded_barriers() {
    const std::lock_guard lock(mutex);
    std::map<CallSite, HazardTracker::BarrierSite> all;
    for (const auto& [id, context] : contexts) {
        for (const HazardTracker::BarrierSite& site : context.tracker.barrier_sites()) {
            HazardTracker::BarrierSite& sum = all[site.where];
            sum.bits = sum.bits | site.bits;
            sum.needed = sum.needed | site.needed;
        }
    }
    std::vector<std::string> lines;
    for (const auto& [where, site] : all) {
        const Barrier unneeded = without(site.bits, site.needed);
        if (unneeded != Barrier::none)
            lines.push_back(fmt::format("{}: barrier({}) is not needed for {}", to_string(where),
                                        to_string(site.bits), to_string(unneeded)));
    }
    return lines;
}

void suppress_barrier(CallSite where) {
    const std::lock_guard lock(mutex);
    current_context().tracker.suppress_barrier(where);
}

void count_all_barriers() {
    const std::lock_guard lock(mutex);
    current_context().tracker.count_all_barriers();
}

void record_gpu_events() {
    const std::lock_guard lock(mutex);
    current_context().recording.emplace();
}

std::vector<GpuEvent> take_gpu_events() {
    const std::lock_guard lock(mutex);
    return std::exchange(current_context().recording, {}).value_or(std::vector<GpuEvent>());
}

void HazardProbe::linked(unsigned program, const std::string& name, const std::string& source) {
    const std::lock_guard lock(mutex);
    current_context().programs[program] = reflect_accesses(program, name, source);
}

void HazardProbe::dispatches(unsigned program) {
    run_shaders(program, {});
}

void HazardProbe::dispatches_indirectly(unsigned program, unsigned arguments) {
    run_shaders(program, {indirect_arguments(arguments)});
}

void HazardProbe::draws(bool has_elements, unsigned arguments) {
    std::vector<BufferAccess> fixed_function;
    if (arguments != 0) fixed_function.push_back(indirect_arguments(arguments));
    for (const BoundBuffer& bound : bound_vertex_buffers(has_elements))
        fixed_function.push_back({bound.buffer, bound.use, true, false, keep(bound.through)});
    GLint program = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    run_shaders(static_cast<unsigned>(program), std::move(fixed_function));
}

void HazardProbe::uploads(unsigned buffer, bool all) {
    transfer(GpuCommand::Kind::transfer, "an upload", all,
             {{buffer, Barrier::buffer_update, false, true, "its target"}});
}

void HazardProbe::clears(unsigned buffer) {
    transfer(GpuCommand::Kind::transfer, "a clear", true,
             {{buffer, Barrier::buffer_update, false, true, "its target"}});
}

void HazardProbe::downloads(unsigned buffer) {
    transfer(GpuCommand::Kind::download, "a download", false,
             {{buffer, Barrier::buffer_update, true, false, "its source"}});
}

void HazardProbe::copies(unsigned source, unsigned target) {
    transfer(GpuCommand::Kind::transfer, "a copy", false,
             {{source, Barrier::buffer_update, true, false, "its source"},
              {target, Barrier::buffer_update, false, true, "its target"}});
}

void HazardProbe::uploads_to_texture(unsigned buffer) {
    transfer(GpuCommand::Kind::transfer, "an upload to a texture", false,
             {{buffer, Barrier::pixel_unpack, true, false, "its source"}});
}

void HazardProbe::makes_barrier(Barrier bits, CallSite where) {
    apply(BarrierCall{bits, where});
}

void HazardProbe::resets(unsigned buffer) {
    apply(BufferReset{buffer});
}

}  // namespace gelatin::gl
