#pragma once

#include <memory>
#include <utility>

#include "cpu/cpu_solver.h"
#include "gpu/gpu_solver.h"
#include "model/solver.h"

namespace gelatin {

/// A simulator's solver, shared by who looks at its nodes, which is also known as its backend's: what draws
/// the bodies reads from that backend's own memory.
class BackendSolver {
public:
    BackendSolver() = default;  ///< null
    explicit BackendSolver(std::shared_ptr<cpu::CpuSolver<float>> solver)
        : on_cpu_(solver.get()), solver_(std::move(solver)) {}
    explicit BackendSolver(std::shared_ptr<gpu::GpuSolver> solver)
        : on_gpu_(solver.get()), solver_(std::move(solver)) {}

    Solver* operator->() const { return solver_.get(); }
    Solver& operator*() const { return *solver_; }
    const std::shared_ptr<Solver>& shared() const { return solver_; }
    bool uses_gl() const { return on_gpu_ != nullptr; }

    /// What `work` returns for the solver, a cpu::CpuSolver<float>& or a gpu::GpuSolver&.
    template <class Work>
    auto visit(const Work& work) const {
        return on_gpu_ != nullptr ? work(*on_gpu_) : work(*on_cpu_);
    }

private:
    cpu::CpuSolver<float>* on_cpu_ = nullptr;
    gpu::GpuSolver* on_gpu_ = nullptr;
    std::shared_ptr<Solver> solver_;
};

}  // namespace gelatin
