#include "gl/readback.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "gelatin/error.h"
#include "gl/barrier.h"
#include "gl/debug.h"
#include "gl/hazards.h"

namespace gelatin::gl {

Readback::~Readback() {
    for (const Copy& copy : pending_) glDeleteBuffers(1, &copy.staging);
    for (const Staging& staging : free_) glDeleteBuffers(1, &staging.id);
}

void Readback::begin(unsigned source, std::size_t bytes) {
    const auto fits = [bytes](const Staging& staging) { return staging.bytes == bytes; };
    auto found = std::find_if(free_.begin(), free_.end(), fits);
    Staging staging{0, bytes};
    if (found != free_.end()) {
        staging = *found;
        free_.erase(found);
    } else {
        glGenBuffers(1, &staging.id);
        if (hazard_probe != nullptr) hazard_probe->resets(staging.id);
        glBindBuffer(GL_COPY_WRITE_BUFFER, staging.id);
        glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
    }
    if (bytes > 0) {
        barrier(Barrier::buffer_update);
        if (hazard_probe != nullptr) hazard_probe->copies(source, staging.id);
        glBindBuffer(GL_COPY_READ_BUFFER, source);
        glBindBuffer(GL_COPY_WRITE_BUFFER, staging.id);
        glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, static_cast<GLsizeiptr>(bytes));
    }
    pending_.push_back({staging.id, bytes, Fence::insert()});
    check_errors("a copy to the host");
}

bool Readback::ready() const {
    return !pending_.empty() && pending_.front().fence.is_passed();
}

std::vector<std::byte> Readback::take() {
    pending_.front().fence.wait();
    const Copy copy = std::move(pending_.front());
    pending_.pop_front();
    free_.push_back({copy.staging, copy.bytes});
    std::vector<std::byte> data(copy.bytes);
    if (data.empty()) return data;
    glBindBuffer(GL_COPY_READ_BUFFER, copy.staging);
    const void* mapped =
        glMapBufferRange(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(copy.bytes), GL_MAP_READ_BIT);
    if (mapped == nullptr) throw GlError("a copy to the host cannot be mapped");
    std::memcpy(data.data(), mapped, copy.bytes);
    glUnmapBuffer(GL_COPY_READ_BUFFER);
    return data;
}

}  // namespace gelatin::gl
