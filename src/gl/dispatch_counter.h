#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace gelatin::gl {

/// How often something was dispatched, and how often with work groups.
struct DispatchCount {
    std::size_t launched = 0, working = 0;

    bool operator==(const DispatchCount&) const = default;
    DispatchCount& operator+=(const DispatchCount& more) {
        launched += more.launched;
        working += more.working;
        return *this;
    }
};

/// Counts the dispatches of this thread while it lives, by stage (CurrentStage) and by the program's file.
/// Where arguments are the device's, each dispatch waits for the device to read them: not for what is timed.
/// One may live on a thread at a time.
class DispatchCounter {
public:
    DispatchCounter();
    DispatchCounter(const DispatchCounter&) = delete;
    DispatchCounter& operator=(const DispatchCounter&) = delete;
    ~DispatchCounter();

    /// Stages, and their programs. Dispatches outside of stages are those of "".
    using Counts = std::map<std::string, std::map<std::string, DispatchCount>>;
    /// Those since the last call.
    Counts take();

    /// @name For Program
    /// @{
    void count(const std::string& program, bool has_groups = true);
    /// @param offset of the three numbers of work groups in GL buffer `arguments` [bytes]
    void count_indirect(const std::string& program, unsigned arguments, std::size_t offset);
    /// @}

private:
    Counts counts_;
};

/// This thread's; null while dispatches are not counted.
inline thread_local DispatchCounter* dispatch_counter = nullptr;

}  // namespace gelatin::gl
