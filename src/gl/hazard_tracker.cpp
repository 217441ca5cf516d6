#include "gl/hazard_tracker.h"

#include <fmt/format.h>

#include <utility>

namespace gelatin::gl {
namespace {

struct Bit {
    Barrier bit;
    std::string_view name;
};
constexpr std::array kBits = {
    Bit{Barrier::storage, "storage"},         Bit{Barrier::texture_fetch, "texture_fetch"},
    Bit{Barrier::vertex_pull, "vertex_pull"}, Bit{Barrier::buffer_update, "buffer_update"},
    Bit{Barrier::command, "command"},         Bit{Barrier::pixel_unpack, "pixel_unpack"}};

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::string in_stage(std::string_view stage) {
    return stage.empty() ? std::string() : fmt::format(" ({})", stage);
}

}  // namespace

void HazardTracker::apply(const GpuEvent& event) {
    std::visit(Overloaded{[this](const GpuCommand& command) { run(command); },
                          [this](const BarrierCall& call) { note_barrier(call); },
                          [this](const BufferReset& reset) { buffers_.erase(reset.buffer); }},
               event);
}

void HazardTracker::run(const GpuCommand& command) {
    ++now_;
    for (const BufferAccess& access : command.accesses) check(command, access);
    for (const BufferAccess& access : command.accesses) record(command, access);
}

void HazardTracker::check(const GpuCommand& command, const BufferAccess& access) {
    const auto found = buffers_.find(access.buffer);
    if (found == buffers_.end()) return;
    const BufferState& past = found->second;
    if (past.store.time != 0 && !is_ordered(past.store.time, access.use)) {
        report(command, access, past.store, access.reads ? "reads" : "overwrites", "wrote", access.use);
        return;
    }
    const bool stores = access.writes && command.kind == GpuCommand::Kind::shader;
    if (stores && past.read.time != 0 && !is_ordered(past.read.time, Barrier::storage)) {
        report(command, access, past.read, "overwrites", "reads", Barrier::storage);
    }
}

void HazardTracker::record(const GpuCommand& command, const BufferAccess& access) {
    BufferState& state = buffers_[access.buffer];
    const PastAccess now{now_, command.name, command.stage, access.through};
    if (access.writes && command.kind == GpuCommand::Kind::shader) {
        state.store = now;
    } else if (access.writes && command.replaces_all) {
        state = {};
    }
    if (access.reads && command.kind != GpuCommand::Kind::download) state.read = now;
}

void HazardTracker::note_barrier(const BarrierCall& call) {
    if (suppressed_.contains(call.where)) return;
    ++now_;
    BarrierSite& site = sites_[call.where];
    site.where = call.where;
    site.bits = site.bits | call.bits;
    for (const Bit& each : kBits) {
        if ((call.bits & each.bit) == Barrier::none) continue;
        LatestBarrier& latest = latest_[each.bit];
        if (latest.where != call.where) latest.elsewhere = latest.time;
        latest.time = now_;
        latest.where = call.where;
    }
}

bool HazardTracker::is_ordered(Time past, Barrier use) {
    const LatestBarrier& latest = latest_[use];
    if (latest.time < past) return false;
    if (latest.elsewhere < past) {
        BarrierSite& site = sites_[latest.where];
        site.needed = site.needed | use;
    }
    return true;
}

void HazardTracker::report(const GpuCommand& command, const BufferAccess& access, const PastAccess& past,
                           std::string_view verb, std::string_view past_verb, Barrier missing) {
    std::string text =
        fmt::format("{}{} {} {} (buffer {}), which {}{} {} as {}: no barrier({}) between", command.name,
                    in_stage(command.stage), verb, access.through, access.buffer, past.command,
                    in_stage(past.stage), past_verb, past.through, to_string(missing));
    if (known_.insert(text).second) hazards_.push_back(std::move(text));
}

std::vector<std::string> HazardTracker::take_hazards() {
    known_.clear();
    return std::exchange(hazards_, {});
}

std::vector<HazardTracker::BarrierSite> HazardTracker::barrier_sites() const {
    std::vector<BarrierSite> all;
    for (const auto& [where, site] : sites_) all.push_back(site);
    return all;
}

std::string to_string(Barrier bits) {
    std::string text;
    for (const Bit& each : kBits) {
        if ((bits & each.bit) == Barrier::none) continue;
        if (!text.empty()) text += " | ";
        text += each.name;
    }
    return text;
}

std::string to_string(CallSite where) {
    std::string_view file = where.file;
    for (const std::string_view root : {"src/", "apps/", "tests/", "bench/"}) {
        const std::size_t start = file.rfind(root);
        if (start != std::string_view::npos && (start == 0 || file[start - 1] == '/')) {
            file.remove_prefix(start);
            break;
        }
    }
    return fmt::format("{}:{}", file, where.line);
}

}  // namespace gelatin::gl
