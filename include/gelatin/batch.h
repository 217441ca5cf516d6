#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gelatin/export.h"
#include "gelatin/scene.h"
#include "gelatin/simulator.h"

namespace gelatin {

/// Copies of a scene, called worlds, that cannot see each other. They share what never changes: meshes,
/// springs and tets are made once. Each has the same bits as a Simulator of the scene alone.
///
/// Worlds are advanced beside each other on all threads, with the CPU backend. Use it from one thread.
/// Move-only.
class GELATIN_API Batch {
public:
    /// @param worlds >= 1
    /// @throws InvalidInput as Simulator, without worlds, and for a scene that needs OpenGL.
    Batch(const Scene& scene, std::size_t worlds);
    Batch(Batch&&) noexcept;
    Batch& operator=(Batch&&) noexcept;
    ~Batch();

    std::size_t size() const;

    /// One world, to read and to set. Valid as long as the batch is. @pre world < size()
    Simulator& operator[](std::size_t world);
    const Simulator& operator[](std::size_t world) const;

    /// Advances every world by `count` steps. Worlds that have diverged stand still.
    /// @throws Diverged for worlds that diverge in these steps, naming the first of them, after all others
    /// have made theirs.
    void step(std::size_t count = 1);

    /// Advances every world by `frames` frames. @throws as step
    void advance(std::size_t frames = 1);

    /// Returns these worlds to their start. @param mask not 0 for worlds to be reset; shape [worlds]
    void reset(std::span<const std::uint8_t> mask);
    /// The same for all worlds.
    void reset();

    /// Not 0 for worlds that have diverged since they were reset; shape [worlds].
    const std::vector<std::uint8_t>& diverged() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gelatin
