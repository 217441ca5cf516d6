#include "bench/kernel_cases.h"

#include <cmath>
#include <numeric>

#include "bench/moved_bytes.h"
#include "bench/threads.h"
#include "cpu/explicit/explicit_solver.h"
#include "cpu/implicit/step_system.h"
#include "cpu/implicit/system_solver.h"
#include "gl/program.h"
#include "gpu/explicit/explicit_solver.h"
#include "gpu/implicit/implicit_solver.h"
#include "gpu/implicit/step_system.h"
#include "gpu/view/update_normals.h"
#include "model/assembly/build_model.h"

namespace gelatin {
namespace {

constexpr double kImplicitStep = 1.0 / 60.0;  // [s]

constexpr int kSolveIterations = 10;
constexpr const char* kLineariseStage = "linearise";
constexpr const char* kSolveStage = "solve (10 iterations)";

constexpr double kNodeBytes = 2 * sizeof(glm::vec4);

// What each stage reads and writes once, with gathers counted once for each node.
double fused_bytes(const Model& m) {
    return static_cast<double>(m.half_springs.pairs.size()) * (sizeof(HalfSpringPair) + sizeof(glm::vec2)) +
           2 * kNodeBytes * m.node_count();
}
double write_bytes(const Model& m) {
    return static_cast<double>(m.springs.size()) * (sizeof(Spring) + sizeof(glm::vec4)) +
           kNodeBytes * m.node_count();
}
double merge_bytes(const Model& m) {
    return static_cast<double>(m.springs.size()) * (2 * sizeof(std::uint32_t) + sizeof(glm::vec4)) +
           (sizeof(std::uint32_t) + sizeof(glm::vec4)) * m.node_count();
}
double integrate_bytes(const Model& m) {
    return (2 * kNodeBytes + sizeof(glm::vec4)) * m.node_count();
}
// With the residual before them.
double solve_bytes(const Model& m) {
    return (kSolveIterations + 1) * iteration_bytes(m);
}
// One part, as bodies make that touch nothing.
double implicit_bytes(const Model& m) {
    return linearise_bytes(m) + solve_bytes(m);
}
double normals_bytes(const Model& m) {
    return static_cast<double>(m.faces.size()) *
               (sizeof(Face) + sizeof(glm::vec4) + 3 * sizeof(std::uint32_t)) +
           static_cast<double>(m.surface.vertices.size()) * (sizeof(SurfaceVertex) + 2 * sizeof(glm::vec4));
}

// The plain scalar core: the templated kernels in float on one thread, no SIMD, no TBB.
class PlainCore {
public:
    PlainCore(std::shared_ptr<const Model> model, double step)
        : model_(std::move(model)),
          step_(step),
          now_{{model_->positions}, {model_->velocities}},
          next_(now_),
          spring_forces_(model_->springs.size()),
          node_forces_(model_->node_count()) {}

    void fused() {
        cpu::advance_nodes(pass(),
                           {0, static_cast<std::uint32_t>(model_->half_springs.slice_starts.size() - 1)});
        std::swap(now_, next_);
    }
    void write() { cpu::write_spring_forces<float>(pass(), spring_forces_, {0, size(model_->springs)}); }
    void merge() {
        cpu::merge_spring_forces<float>(*model_, spring_forces_, node_forces_, {0, model_->node_count()});
    }
    void integrate() { cpu::integrate_nodes<float>(pass(), node_forces_, {0, model_->node_count()}); }
    void divide_and_merge() {
        write();
        merge();
        integrate();
        std::swap(now_, next_);
    }

private:
    template <class T>
    static std::uint32_t size(const std::vector<T>& v) {
        return static_cast<std::uint32_t>(v.size());
    }
    cpu::Pass<float> pass() {
        return cpu::make_pass(*model_, explicit_scheme(SolverKind::semi_implicit_euler), 0, step_, now_, now_,
                              next_, none_);
    }
    std::shared_ptr<const Model> model_;
    double step_;
    cpu::Nodes<float> now_, next_, none_;
    std::vector<glm::vec4> spring_forces_, node_forces_;
};

// What the system of a step is solved for: each node is pushed, with inertia as in a part of a frame.
std::vector<glm::vec4> loads_of(const Model& model) {
    std::vector<glm::vec4> loads;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const float inertia =
            16.0f / (model.positions[n].w * static_cast<float>(kImplicitStep * kImplicitStep));
        loads.emplace_back(1e-3f * inertia * glm::vec3(std::sin(0.1f * static_cast<float>(n)), 1.0f, 0.0f),
                           inertia);
    }
    return loads;
}
constexpr float kInversePart = 4.0f / static_cast<float>(kImplicitStep);  // [1/s]

class CpuSystem {
public:
    explicit CpuSystem(const std::shared_ptr<const Model>& model)
        : model_(model), loads_(loads_of(*model)), islands_(model->body_count()), system_(model) {
        std::iota(islands_.begin(), islands_.end(), 0u);
        for (std::size_t n = 0; n < loads_.size(); ++n) {
            system_.inertia[n] = loads_[n].w;
            system_.loads[n] = glm::vec3(loads_[n]);
        }
        system_.iterations = kSolveIterations / 2;
        linearise();
    }
    void linearise() { system_.elastic.linearise(model_->positions, model_->velocities, kInversePart); }
    void solve() {
        std::fill(system_.displacements.begin(), system_.displacements.end(), glm::vec3(0.0f));
        system_.rigid.begin(model_->positions, system_.inertia);
        system_.solve(islands_);
    }

private:
    std::shared_ptr<const Model> model_;
    std::vector<glm::vec4> loads_;
    std::vector<std::uint32_t> islands_;  // a body each
    cpu::StepSystem<float> system_;
};

class GlSystem {
public:
    explicit GlSystem(const Model& model)
        : buffers_(model),
          nodes_(model.positions, model.velocities),
          system_(model, tries_, {}, packing::kChunksOfSmallIsland) {
        StepClock clock{};
        clock.step = 1.0f / kInversePart;
        clock.goes_on = 1;
        tries_.set_clock(clock);
        std::vector<float> times;
        for (const glm::vec4& velocity : model.velocities) times.push_back(velocity.w);
        damping_times_ = {times, gl::TexelFormat::r32f};
        system_.loads().upload(loads_of(model));
        system_.displacements().upload(std::vector<glm::vec4>(model.node_count(), glm::vec4(0.0f)));
        system_.enough().upload(std::vector<float>(model.objects.size(), 0.0f));
        system_.set_iterations(kSolveIterations / 2);
        linearise();
    }
    void linearise() { system_.elastic.linearise(buffers_, nodes_, damping_times_.texels(), tries_); }
    void solve() {
        system_.begin_bodies(nodes_);
        system_.solve(nodes_);
    }

private:
    gpu::ModelBuffers buffers_;
    gpu::NodeBuffers nodes_;
    gl::TexelTable<float> damping_times_;
    gpu::Tries tries_;
    gpu::StepSystem system_;
};

void add_plain_cases(const std::shared_ptr<const Model>& model, double step, std::vector<KernelCase>& cases) {
    const auto fused = std::make_shared<PlainCore>(model, step),
               divided = std::make_shared<PlainCore>(model, step);
    const auto add = [&](const char* stage, double bytes, std::function<void()> run) {
        cases.push_back({kPlainCore, stage, bytes, std::move(run), [] {}});
    };
    const Model& m = *model;
    add(kFusedStage, fused_bytes(m), [fused] { fused->fused(); });
    add("write_spring_forces", write_bytes(m), [divided] { divided->write(); });
    add("merge_spring_forces", merge_bytes(m), [divided] { divided->merge(); });
    add("integrate_nodes", integrate_bytes(m), [divided] { divided->integrate(); });
    add(kDividedStage, write_bytes(m) + merge_bytes(m) + integrate_bytes(m),
        [divided] { divided->divide_and_merge(); });
}

void add_cpu_cases(const std::shared_ptr<const Model>& model, double step, std::vector<KernelCase>& cases) {
    const auto solver_for = [&](ForceMethod forces) {
        return std::make_shared<cpu::ExplicitSolver<float>>(model, SolverKind::semi_implicit_euler, forces);
    };
    const auto fused = solver_for(ForceMethod::fused);
    const auto divided = solver_for(ForceMethod::divide_and_merge);
    const auto implicit = std::make_shared<cpu::SystemSolver<float>>(model);
    const auto system = std::make_shared<CpuSystem>(model);
    const double divided_bytes = write_bytes(*model) + merge_bytes(*model) + integrate_bytes(*model);
    for (const int threads : measured_thread_counts()) {
        const std::string name = describe_cpu(threads);
        const auto nothing = [] {};
        cases.push_back({name, kFusedStage, fused_bytes(*model), [fused, step] { fused->advance({step}); },
                         nothing, threads});
        cases.push_back({name, kDividedStage, divided_bytes, [divided, step] { divided->advance({step}); },
                         nothing, threads});
        cases.push_back({name, kImplicitStage, implicit_bytes(*model),
                         [implicit] { implicit->advance({kImplicitStep}); }, nothing, threads});
        cases.push_back({name, kLineariseStage, linearise_bytes(*model), [system] { system->linearise(); },
                         nothing, threads});
        cases.push_back(
            {name, kSolveStage, solve_bytes(*model), [system] { system->solve(); }, nothing, threads});
        cases.push_back({name, "measure", fused_bytes(*model),
                         [fused] {
                             fused->begin_measure();
                             fused->end_measure();
                         },
                         nothing, threads});
    }
}

void add_gl_cases(const std::shared_ptr<const Model>& model, double step, std::vector<KernelCase>& cases) {
    const Model& m = *model;
    const auto solver_for = [&](ForceMethod forces) {
        return std::make_shared<gpu::ExplicitSolver>(model, SolverKind::semi_implicit_euler, forces);
    };
    const auto fused = solver_for(ForceMethod::fused);
    const auto divided = solver_for(ForceMethod::divide_and_merge);
    const auto kernels =
        std::make_shared<gpu::DivideAndMerge>(*model, explicit_scheme(SolverKind::semi_implicit_euler));
    const auto normals = std::make_shared<gpu::UpdateNormals>(model->faces, model->surface);
    const auto finish = [] { gl::finish(); };
    cases.push_back(
        {kOpenGl, kFusedStage, fused_bytes(m), [fused, step] { fused->advance({step}); }, finish});
    cases.push_back({kOpenGl, "write_spring_forces", write_bytes(m),
                     [kernels, fused] { kernels->write_spring_forces(fused->nodes()); }, finish});
    cases.push_back({kOpenGl, "merge_spring_forces", merge_bytes(m),
                     [kernels] { kernels->merge_spring_forces(); }, finish});
    cases.push_back({kOpenGl, kDividedStage, write_bytes(m) + merge_bytes(m) + integrate_bytes(m),
                     [divided, step] { divided->advance({step}); }, finish});
    const auto implicit = std::make_shared<gpu::ImplicitSolver>(model);
    cases.push_back({kOpenGl, kImplicitStage, implicit_bytes(m),
                     [implicit] { implicit->advance({kImplicitStep}); }, finish});
    const auto system = std::make_shared<GlSystem>(m);
    cases.push_back(
        {kOpenGl, kLineariseStage, linearise_bytes(m), [system] { system->linearise(); }, finish});
    cases.push_back({kOpenGl, kSolveStage, solve_bytes(m), [system] { system->solve(); }, finish});
    cases.push_back({kOpenGl, "update_normals", normals_bytes(m),
                     [normals, fused] { normals->run(fused->nodes().position_texels); }, finish});
    cases.push_back({kOpenGl, "measure", fused_bytes(m),
                     [fused] {
                         fused->begin_measure();
                         fused->end_measure();
                     },
                     finish});
}

}  // namespace

std::shared_ptr<const Model> make_sphere_grid(const TetMesh& sphere, int scale) {
    std::vector<Body> bodies;
    for (int i = 0; i < 3 * scale; ++i) {
        Body body;
        body.name = "sphere " + std::to_string(i);
        body.mesh = sphere;
        const int row = i / 20, column = i % 20;
        for (glm::dvec3& p : body.mesh.positions) p += glm::dvec3(1.5 * column, 50.0 + 1.5 * row, 0.0);
        body.material.damping = 1e-4;
        body.material.springs = SpringKinds{};  // the paper's
        bodies.push_back(std::move(body));
    }
    // Nothing collides during the measurement: bodies that touch or are crushed cost more.
    const glm::dvec3 gravity(0.0, -0.01, 0.0);
    return std::make_shared<const Model>(pack_bodies(bodies, {ColliderDescription{}}, gravity));
}

std::vector<KernelCase> kernel_cases(const std::shared_ptr<const Model>& model, double step, bool use_gl) {
    std::vector<KernelCase> cases;
    add_plain_cases(model, step, cases);
    add_cpu_cases(model, step, cases);
    if (use_gl) add_gl_cases(model, step, cases);
    return cases;
}

}  // namespace gelatin
