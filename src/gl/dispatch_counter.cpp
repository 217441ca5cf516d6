#include "gl/dispatch_counter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "core/current_stage.h"

namespace gelatin::gl {

DispatchCounter::DispatchCounter() {
    assert(dispatch_counter == nullptr);
    dispatch_counter = this;
}

DispatchCounter::~DispatchCounter() {
    dispatch_counter = nullptr;
}

DispatchCounter::Counts DispatchCounter::take() {
    return std::exchange(counts_, {});
}

void DispatchCounter::count(const std::string& program, bool has_groups) {
    counts_[CurrentStage::name()][program] += {1, has_groups ? std::size_t{1} : 0};
}

// The barrier is not this layer's own: who only counts must not stand in for one that is missing.
void DispatchCounter::count_indirect(const std::string& program, unsigned arguments, std::size_t offset) {
    std::array<GLuint, 3> groups{};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, arguments);
    glGetBufferSubData(GL_DISPATCH_INDIRECT_BUFFER, static_cast<GLintptr>(offset), sizeof(groups),
                       groups.data());
    count(program, std::find(groups.begin(), groups.end(), 0u) == groups.end());
}

}  // namespace gelatin::gl
