#include "gelatin/batch.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <utility>

#include "gelatin/error.h"
#include "sim/simulator_internals.h"

namespace gelatin {

struct Batch::Impl {
    std::vector<Simulator> worlds;
    std::vector<std::uint8_t> diverged;

    // Also what has diverged by steps of its own.
    bool has_diverged(std::size_t world) const {
        try {
            worlds[world].check();
        } catch (const Diverged&) {
            return true;
        }
        return false;
    }
    // Runs work(world) for each world, beside each other. A thread that waits within a world must not begin
    // another one meanwhile: it would keep the first one waiting.
    template <class Work>
    void for_each_world(const Work& work) {
        tbb::parallel_for(std::size_t(0), worlds.size(),
                          [&](std::size_t w) { tbb::this_task_arena::isolate([&] { work(w); }); });
    }
};

namespace {

[[noreturn]] void throw_with_world(const std::exception_ptr& error, std::size_t world) {
    try {
        std::rethrow_exception(error);
    } catch (const Diverged& diverged) {
        throw Diverged(fmt::format("world {}: {}", world, diverged.what()), diverged.where());
    }
}

}  // namespace

Batch::Batch(const Scene& scene, std::size_t worlds) : impl_(std::make_unique<Impl>()) {
    if (worlds == 0) throw InvalidInput({{}, 0, "worlds", "0", "must be 1 or more"});
    SimulatorOptions options;
    options.backend = Backend::cpu;
    impl_->worlds.emplace_back(scene, options);
    impl_->worlds.reserve(worlds);
    while (impl_->worlds.size() < worlds)
        impl_->worlds.push_back(SimulatorInternals::another(impl_->worlds.front()));
    impl_->diverged.assign(worlds, 0);
}

Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;
Batch::~Batch() = default;

std::size_t Batch::size() const {
    return impl_->worlds.size();
}

Simulator& Batch::operator[](std::size_t world) {
    assert(world < size());
    return impl_->worlds[world];
}

const Simulator& Batch::operator[](std::size_t world) const {
    assert(world < size());
    return impl_->worlds[world];
}

void Batch::step(std::size_t count) {
    std::vector<std::exception_ptr> errors(size());
    impl_->for_each_world([&](std::size_t w) {
        if (impl_->has_diverged(w)) return;
        try {
            for (std::size_t s = 0; s < count; ++s) impl_->worlds[w].step();
        } catch (const Diverged&) {
            errors[w] = std::current_exception();
        }
    });
    for (std::size_t w = 0; w < errors.size(); ++w)
        if (errors[w]) throw_with_world(errors[w], w);
}

void Batch::advance(std::size_t frames) {
    step(frames * static_cast<std::size_t>(impl_->worlds.front().substeps()));
}

void Batch::reset(std::span<const std::uint8_t> mask) {
    assert(mask.size() == size());
    impl_->for_each_world([&](std::size_t w) {
        if (mask[w] == 0) return;
        impl_->worlds[w].reset();
    });
}

void Batch::reset() {
    reset(std::vector<std::uint8_t>(size(), 1));
}

const std::vector<std::uint8_t>& Batch::diverged() const {
    for (std::size_t w = 0; w < size(); ++w) impl_->diverged[w] = impl_->has_diverged(w) ? 1 : 0;
    return impl_->diverged;
}

}  // namespace gelatin
