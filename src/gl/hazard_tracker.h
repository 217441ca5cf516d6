#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "gl/barrier.h"

namespace gelatin::gl {

/// How one command uses one buffer. Text must outlive the tracker.
struct BufferAccess {
    unsigned buffer = 0;
    Barrier use = Barrier::none;  ///< one bit: the one a barrier needs for this use
    bool reads = false;
    bool writes = false;
    std::string_view through;  ///< what reaches the buffer: "block Positions", "indirect arguments"
};

/// What runs on the GPU: a dispatch, a draw, a copy.
struct GpuCommand {
    enum class Kind {
        shader,    ///< its storage blocks are written by shaders: GL does not order them
        transfer,  ///< GL itself reads and writes: copy, clear, upload
        download,  ///< a transfer that has ended when the call returns
    };
    Kind kind = Kind::shader;
    std::string_view name;      ///< the program's file, or "upload"
    std::string_view stage;     ///< of the simulation step; may be empty
    bool replaces_all = false;  ///< a transfer that leaves nothing of what was in the buffers that it writes
    std::vector<BufferAccess> accesses;
};

struct BarrierCall {
    Barrier bits = Barrier::none;
    CallSite where;
};

/// A buffer was made or deleted: nothing is known about its name any more.
struct BufferReset {
    unsigned buffer = 0;
};

using GpuEvent = std::variant<GpuCommand, BarrierCall, BufferReset>;

/// Finds accesses to buffers that no glMemoryBarrier orders. Pure bookkeeping, without OpenGL: it is given
/// the commands and barriers of one context in the order of their calls.
///
/// Rules (OpenGL 4.6 core, 7.13.2 "Shader Memory Access Synchronization"; 7.12.2 in 4.3):
///
/// 1. Read after write, write after write. What a shader stored is visible to a later command only if a
/// barrier with the bit of that command's use lies between. This holds for dispatches, draws, vertex and
/// index fetches, indirect arguments, copies, clears, uploads, downloads and uploads to textures alike.
///
/// 2. Write after read. A shader's store waits for earlier accesses (loads, texture and vertex fetches) only
/// if a barrier with SHADER_STORAGE lies between. Other bits do not hold stores back.
///
/// 3. What GL itself writes (copies, clears, uploads) it orders before all later commands and after all
/// earlier reads: no barrier is needed. It is not ordered after earlier stores of shaders: see rule 1.
///
/// 4. A framebuffer's attachments that are sampled later are written by GL, not by shader stores: no barrier.
///
/// 5. A command that has a buffer in two places (a samplerBuffer and a block) orders them itself, or has no
/// need to.
///
/// A buffer is one thing: two commands that write different elements of it need a barrier between, too.
/// Barriers count as a set of bits; fences and glFinish order nothing here.
class HazardTracker {
public:
    void apply(const GpuEvent& event);

    /// What was found since the last call, each once.
    std::vector<std::string> take_hazards();

    /// Barriers made there are not counted, as if the call were removed.
    void suppress_barrier(CallSite where) { suppressed_.insert(where); }
    void count_all_barriers() { suppressed_.clear(); }

    /// A call of barrier() and what it was good for.
    struct BarrierSite {
        CallSite where;
        Barrier bits = Barrier::none;  ///< that it was called with
        /// Bits without which an access would have been a hazard; those that a barrier made elsewhere stands
        /// in for are not among them.
        Barrier needed = Barrier::none;
    };
    /// Of all barriers so far.
    std::vector<BarrierSite> barrier_sites() const;

private:
    using Time = std::uint64_t;  // counts commands and barriers; 0 is never

    // The last of its kind: earlier ones are ordered wherever it is.
    struct PastAccess {
        Time time = 0;
        std::string_view command, stage, through;
    };
    struct BufferState {
        PastAccess store;  // by a shader
        PastAccess read;
    };
    // The latest barrier with a certain bit, and the latest with it from another line.
    struct LatestBarrier {
        Time time = 0;
        Time elsewhere = 0;
        CallSite where;
    };

    void run(const GpuCommand& command);
    void check(const GpuCommand& command, const BufferAccess& access);
    void record(const GpuCommand& command, const BufferAccess& access);
    void note_barrier(const BarrierCall& call);
    bool is_ordered(Time past, Barrier use);
    void report(const GpuCommand& command, const BufferAccess& access, const PastAccess& past,
                std::string_view verb, std::string_view past_verb, Barrier missing);

    Time now_ = 0;
    std::unordered_map<unsigned, BufferState> buffers_;
    std::map<Barrier, LatestBarrier> latest_;
    std::map<CallSite, BarrierSite> sites_;
    std::set<CallSite> suppressed_;
    std::set<std::string> known_;
    std::vector<std::string> hazards_;
};

/// "storage | command"
std::string to_string(Barrier bits);

/// "src/gpu/collision/respond.cpp:31", whatever path the compiler was called with.
std::string to_string(CallSite where);

}  // namespace gelatin::gl
