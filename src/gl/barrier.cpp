#include "gl/barrier.h"

#include <epoxy/gl.h>

#include "gl/hazards.h"

namespace gelatin::gl {

void barrier(Barrier next_use, CallSite where) {
    if (hazard_probe != nullptr) hazard_probe->makes_barrier(next_use, where);
    const auto asks = [next_use](Barrier use) { return (next_use & use) != Barrier::none; };
    GLbitfield bits = 0;
    if (asks(Barrier::storage)) bits |= GL_SHADER_STORAGE_BARRIER_BIT;
    if (asks(Barrier::texture_fetch)) bits |= GL_TEXTURE_FETCH_BARRIER_BIT;
    if (asks(Barrier::vertex_pull)) bits |= GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT;
    if (asks(Barrier::buffer_update)) bits |= GL_BUFFER_UPDATE_BARRIER_BIT;
    if (asks(Barrier::command)) bits |= GL_COMMAND_BARRIER_BIT;
    if (asks(Barrier::pixel_unpack)) bits |= GL_PIXEL_BUFFER_BARRIER_BIT;
    glMemoryBarrier(bits);
}

}  // namespace gelatin::gl
