#include "gelatin/loading.h"

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <utility>

#include "core/progress.h"
#include "gelatin/error.h"
#include "model/assembly/build_model.h"
#include "sim/simulator_internals.h"

namespace gelatin {

struct Loading::Impl : ProgressListener {
    Impl(const Scene& s, const SimulatorOptions& o, std::function<void(const LoadProgress&)> f)
        : scene(s), options(o), on_change(std::move(f)) {
        model = std::async(std::launch::async, [this] {
            const ListenToProgress listen(*this);
            auto made = std::make_shared<const Model>(build_model(scene));
            report_progress(1.0, "ready");
            return made;
        });
    }
    ~Impl() override { cancelled = true; }  // then the future's destructor waits

    void on_progress(double share, std::string_view what) override {
        const LoadProgress now{share, std::string(what)};
        {
            const std::lock_guard lock(mutex);
            progress = now;
        }
        if (on_change) on_change(now);
    }
    bool is_cancelled() const override { return cancelled; }

    Scene scene;
    SimulatorOptions options;
    std::function<void(const LoadProgress&)> on_change;
    std::atomic<bool> cancelled = false;
    mutable std::mutex mutex;
    LoadProgress progress;
    std::future<std::shared_ptr<const Model>> model;  // last: its thread uses all others
};

Loading::Loading(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Loading::Loading(Loading&&) noexcept = default;
Loading& Loading::operator=(Loading&&) noexcept = default;
Loading::~Loading() = default;

LoadProgress Loading::progress() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->progress;
}

bool Loading::is_ready() const {
    return wait_for(0.0);
}

bool Loading::wait_for(double seconds) const {
    if (!impl_->model.valid()) return true;  // it was taken
    return impl_->model.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
}

void Loading::cancel() {
    impl_->cancelled = true;
}

Simulator Loading::get() {
    if (!impl_->model.valid()) throw InvalidInput("a loading gives its simulator once");
    return SimulatorInternals::make(impl_->scene, impl_->model.get(), impl_->options);
}

Loading load_simulator(const Scene& scene, const SimulatorOptions& options,
                       std::function<void(const LoadProgress&)> on_progress) {
    validate(scene);
    return Loading(std::make_unique<Loading::Impl>(scene, options, std::move(on_progress)));
}

}  // namespace gelatin
