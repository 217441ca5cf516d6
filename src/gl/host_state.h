#pragma once

#include <memory>

namespace gelatin::gl {

/// Keeps the state of OpenGL of an application in whose context this library works: the constructor saves all
/// that the library touches or depends on and sets OpenGL's defaults, the destructor restores it. That is
/// (docs/embedding.md lists the same):
/// - the program, the vertex array, the framebuffers, the renderbuffer;
/// - bindings of buffers: array, copies, indirect draws and dispatches, pixels, shader storage (also the
/// first
///   16 indexed ones);
/// - of the first 32 texture units: 2D and buffer textures, and samplers; the active unit;
/// - viewports, scissors, depth ranges; the switches, functions and masks of all tests of fragments, per
///   draw buffer where they are; polygon mode, front face, provoking vertex, clip control; clear depth;
/// - pixel storage.
/// Errors of the application that are still pending would look like this library's: they go to the log.
///
/// Needs the context to be current. Not touched, and so neither saved: queries, conditional rendering,
/// transform feedback, uniform buffers, images. The application must not call within one of the first three.
class HostState {
public:
    HostState();
    HostState(const HostState&) = delete;
    HostState& operator=(const HostState&) = delete;
    ~HostState();

private:
    struct Saved;
    std::unique_ptr<Saved> saved_;
};

}  // namespace gelatin::gl
