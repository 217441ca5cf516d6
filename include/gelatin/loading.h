#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gelatin/export.h"
#include "gelatin/scene.h"
#include "gelatin/simulator.h"

namespace gelatin {

struct LoadProgress {
    double share = 0.0;  ///< done so far, from 0 to 1
    std::string what;    ///< is done now: "object 'ball': tets"
};

/// A scene that another thread makes tets, springs and tables of. Move-only. The destructor cancels what is
/// still under way, and waits for its end.
class GELATIN_API Loading {
public:
    Loading(Loading&&) noexcept;
    Loading& operator=(Loading&&) noexcept;
    ~Loading();

    LoadProgress progress() const;
    /// Whether get() would not wait.
    bool is_ready() const;
    /// Waits, but not longer than this [s]. @return is_ready()
    bool wait_for(double seconds) const;

    /// Ends it as soon as possible, between objects and the phases of their meshing; a running TetGen is
    /// killed at once. Then get() throws Cancelled, unless it was done already.
    void cancel();

    /// Waits for the end, then makes the simulator on this thread, whose OpenGL context it uses with the GL
    /// backend. To be called once.
    /// @throws Cancelled; and what the constructor of Simulator throws
    Simulator get();

private:
    friend GELATIN_API Loading load_simulator(const Scene&, const SimulatorOptions&,
                                              std::function<void(const LoadProgress&)>);
    struct Impl;
    explicit Loading(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// Starts to load a scene beside the calling thread. What takes long of it, the meshes, is cached on disk.
/// @param on_progress is called on the loading thread; what it throws ends the loading, and comes out of
/// get()
/// @throws InvalidInput as validate
GELATIN_API Loading load_simulator(const Scene& scene, const SimulatorOptions& options = {},
                                   std::function<void(const LoadProgress&)> on_progress = {});

}  // namespace gelatin
