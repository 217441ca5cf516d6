#include "bench_kernels.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench_samples.h"
#include "bench_threads.h"
#include "core/file.h"
#include "core/log.h"
#include "cpu/cpu_solver.h"
#include "gelatin/error.h"
#include "gelatin/version.h"
#include "gl/context.h"
#include "gl/program.h"
#include "gpu/gpu_solver.h"
#include "gpu/update_normals.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/build_model.h"
#include "model/descent_rows.h"
#include "model/stability.h"

namespace gelatin {
namespace {

// One stage on one backend at one size.
struct Row {
    std::string backend, stage;
    int scale;
    double ms;      // median
    double spread;  // (90th - 10th percentile) / median
    double bytes;   // read and written at least once
    double springs;
    double least;  // [ms], of all samples
};

// 3 x scale spheres of the paper's size in a grid, damped a little so that both terms of the force are at
// work.
std::shared_ptr<const Model> make_spheres(const TetMesh& sphere, int scale) {
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
    // Nothing lands while it is timed: what touches or is crushed costs more.
    const glm::dvec3 gravity(0.0, -0.01, 0.0);
    return std::make_shared<const Model>(pack_bodies(bodies, {ColliderDescription{}}, gravity));
}

constexpr double kFrame = 1.0 / 60.0;  // [s], what vertex block descent steps over
const char* const kDispatches = "dispatches of a sweep";

std::string descent_stage(int sweeps) {
    return fmt::format("vbd ({} {})", sweeps, sweeps == 1 ? "sweep" : "sweeps");
}
// With these, differences tell what a sweep costs: alone, and with what comes with every second one.
constexpr std::array<int, 3> kSweepCounts{1, 2, 10};

constexpr double kNodeBytes = 2 * sizeof(glm::vec4);

// What each stage reads and writes once, gathers counted once a node.
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
// A sweep reads springs, with their dampers in them, and positions and targets; the step makes the springs.
double descent_bytes(const Model& m, int sweeps) {
    return (sweeps + 1) * fused_bytes(m);
}
double normals_bytes(const Model& m) {
    return static_cast<double>(m.faces.size()) *
               (sizeof(Face) + sizeof(glm::vec4) + 3 * sizeof(std::uint32_t)) +
           static_cast<double>(m.surface.vertices.size()) * (sizeof(SurfaceVertex) + 2 * sizeof(glm::vec4));
}

// A stage ready to be timed: `run` enqueues it (or does it), `wait` ends when it is done.
struct Case {
    std::string backend, stage;
    double bytes;
    std::function<void()> run;
    std::function<void()> wait;
    int threads = 0;  // 0: all
};

double time_once(const Case& c, int repeats) {
    const auto start = std::chrono::steady_clock::now();
    for (int r = 0; r < repeats; ++r) c.run();
    c.wait();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count() / repeats;
}

// Samples every case in turn, so that a machine that slows down slows all of them.
std::vector<Row> time_cases(const std::vector<Case>& cases, int scale, int runs, double springs) {
    std::vector<int> repeats;
    for (const Case& c : cases) {
        time_once(c, 1);  // compiles shaders, faults pages in
        repeats.push_back(std::clamp(static_cast<int>(20.0 / std::max(time_once(c, 1), 1e-3)), 1, 200));
    }
    std::vector<std::vector<double>> samples(cases.size());
    for (int r = 0; r < runs; ++r) {
        for (std::size_t c = 0; c < cases.size(); ++c) {
            const ThreadLimit limit(cases[c].threads);
            samples[c].push_back(time_once(cases[c], repeats[c]));
        }
    }
    std::vector<Row> rows;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        const BenchSummary summary = summarise(samples[c]);
        rows.push_back({cases[c].backend, cases[c].stage, scale, summary.median, summary.spread(),
                        cases[c].bytes, springs, *std::min_element(samples[c].begin(), samples[c].end())});
    }
    return rows;
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

void add_plain_cases(const std::shared_ptr<const Model>& model, double step, std::vector<Case>& cases) {
    const auto fused = std::make_shared<PlainCore>(model, step),
               divided = std::make_shared<PlainCore>(model, step);
    const auto add = [&](const char* stage, double bytes, std::function<void()> run) {
        cases.push_back({"plain C++", stage, bytes, std::move(run), [] {}});
    };
    const Model& m = *model;
    add("advance_nodes (fused)", fused_bytes(m), [fused] { fused->fused(); });
    add("write_spring_forces", write_bytes(m), [divided] { divided->write(); });
    add("merge_spring_forces", merge_bytes(m), [divided] { divided->merge(); });
    add("integrate_nodes", integrate_bytes(m), [divided] { divided->integrate(); });
    add("divide and merge", write_bytes(m) + merge_bytes(m) + integrate_bytes(m),
        [divided] { divided->divide_and_merge(); });
}

void add_cpu_cases(const std::shared_ptr<const Model>& model, double step, std::vector<Case>& cases) {
    const auto solver_for = [&](ForceMethod forces) {
        return std::make_shared<cpu::CpuSolver<float>>(model, SolverKind::semi_implicit_euler, forces);
    };
    const auto fused = solver_for(ForceMethod::fused);
    const auto divided = solver_for(ForceMethod::divide_and_merge);
    std::array<std::shared_ptr<cpu::CpuSolver<float>>, kSweepCounts.size()> descents;
    for (std::size_t k = 0; k < descents.size(); ++k) {
        descents[k] =
            std::make_shared<cpu::CpuSolver<float>>(model, SolverKind::vbd, ForceMethod::fused,
                                                    CollisionSettings{}, DescentSettings{kSweepCounts[k]});
    }
    const double divided_bytes = write_bytes(*model) + merge_bytes(*model) + integrate_bytes(*model);
    for (const int threads : measured_thread_counts()) {
        const std::string name = describe_cpu(threads);
        const auto nothing = [] {};
        cases.push_back({name, "advance_nodes (fused)", fused_bytes(*model),
                         [fused, step] { fused->advance_nodes(step); }, nothing, threads});
        cases.push_back({name, "divide and merge", divided_bytes,
                         [divided, step] { divided->advance_nodes(step); }, nothing, threads});
        for (std::size_t k = 0; k < descents.size(); ++k) {
            const int sweeps = kSweepCounts[k];
            cases.push_back({name, descent_stage(sweeps), descent_bytes(*model, sweeps),
                             [descent = descents[k]] { descent->advance_nodes(kFrame); }, nothing, threads});
        }
        cases.push_back({name, "measure", fused_bytes(*model),
                         [fused] {
                             fused->begin_measure();
                             fused->end_measure();
                         },
                         nothing, threads});
    }
}

void add_gl_cases(const std::shared_ptr<const Model>& model, double step, std::vector<Case>& cases) {
    const Model& m = *model;
    const auto solver_for = [&](ForceMethod forces) {
        return std::make_shared<gpu::GpuSolver>(model, SolverKind::semi_implicit_euler, forces);
    };
    const auto fused = solver_for(ForceMethod::fused);
    const auto divided = solver_for(ForceMethod::divide_and_merge);
    const auto kernels =
        std::make_shared<gpu::DivideAndMerge>(*model, explicit_scheme(SolverKind::semi_implicit_euler));
    const auto normals = std::make_shared<gpu::UpdateNormals>(*model);
    const DescentRows rows = make_descent_rows(m);
    const auto empty = std::make_shared<gl::Program>(gl::Program::compute("bench/nothing.comp"));
    const auto finish = [] { gl::finish(); };
    cases.push_back({"GL", "advance_nodes (fused)", fused_bytes(m),
                     [fused, step] { fused->advance_nodes(step); }, finish});
    cases.push_back({"GL", "write_spring_forces", write_bytes(m),
                     [kernels, fused] { kernels->write_spring_forces(fused->nodes()); }, finish});
    cases.push_back(
        {"GL", "merge_spring_forces", merge_bytes(m), [kernels] { kernels->merge_spring_forces(); }, finish});
    cases.push_back({"GL", "divide and merge", write_bytes(m) + merge_bytes(m) + integrate_bytes(m),
                     [divided, step] { divided->advance_nodes(step); }, finish});
    for (const int sweeps : kSweepCounts) {
        const auto descent = std::make_shared<gpu::GpuSolver>(model, SolverKind::vbd, ForceMethod::fused,
                                                              CollisionSettings{}, DescentSettings{sweeps});
        cases.push_back({"GL", descent_stage(sweeps), descent_bytes(m, sweeps),
                         [descent] { descent->advance_nodes(kFrame); }, finish});
    }
    // One a colour, and half of the four that come with every second sweep.
    const std::size_t dispatches = rows.colors.size() + 2,
                      invocations = rows.nodes.size() / rows.colors.size();
    cases.push_back({"GL", kDispatches, 0.0,
                     [empty, dispatches, invocations] {
                         for (std::size_t k = 0; k < dispatches; ++k) {
                             empty->dispatch(invocations);
                             gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
                         }
                     },
                     finish});
    cases.push_back({"GL", "update_normals", normals_bytes(m),
                     [normals, fused] { normals->run(fused->nodes().position_texels); }, finish});
    cases.push_back({"GL", "measure", fused_bytes(m),
                     [fused] {
                         fused->begin_measure();
                         fused->end_measure();
                     },
                     finish});
}

const Row& find_row(const std::vector<Row>& rows, const std::string& backend, const std::string& stage,
                    int scale) {
    return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
        return r.backend == backend && r.stage == stage && r.scale == scale;
    });
}

void print_rows(const std::vector<Row>& rows) {
    fmt::print("{:<16} {:<24} {:>6} {:>10} {:>8} {:>10} {:>8} {:>10}\n", "backend", "stage", "scale", "ms",
               "spread", "MB", "GB/s", "ns/spring");
    for (const Row& r : rows) {
        fmt::print("{:<16} {:<24} {:>5}x {:>10.4f} {:>7.0f}% {:>10.2f} {:>8.2f} {:>10.3f}\n", r.backend,
                   r.stage, r.scale, r.ms, 100 * r.spread, r.bytes / 1e6, r.bytes / r.ms / 1e6,
                   1e6 * r.ms / r.springs);
    }
}

// What a sweep of block descent costs in explicit steps, by differences. Of shortest times: medians of times
// that others have disturbed differ by more than a sweep.
void add_sweep_ratios(const std::vector<Row>& rows, const std::string& backend, int scale,
                      std::vector<BenchRatio>& ratios) {
    const auto least = [&](const std::string& stage) { return find_row(rows, backend, stage, scale).least; };
    const double fused = least("advance_nodes (fused)");
    const double one = least(descent_stage(1)), two = least(descent_stage(2)), ten = least(descent_stage(10));
    const auto add = [&](const std::string& what, double ms, const std::string& wanted = "") {
        ratios.push_back({fmt::format("{}: {} / fused, {}x", backend, what, scale), ms / fused, wanted});
    };
    const double sweep = (ten - two) / 8;  // and half of what comes with every second one
    if (backend == "GL") {
        add("a sweep of vbd", sweep);
        add("its dispatches", least(kDispatches));
        add("a sweep less them", sweep - least(kDispatches), "<= 1.2");
    } else {
        add("a sweep of vbd", sweep, "<= 1.2");
    }
    add("its colours alone", two - one);
    add("the rest of a step", ten - 10 * sweep);
}

std::vector<BenchRatio> summarise(const std::vector<Row>& rows, const KernelBenchOptions& options) {
    const std::string fused = "advance_nodes (fused)", divided = "divide and merge";
    std::vector<std::string> backends{"plain C++", "CPU, 1 thread"};
    if (options.use_gl) backends.emplace_back("GL");
    std::vector<BenchRatio> ratios;
    for (const int scale : options.scales) {
        const auto ms = [&](const std::string& b, const std::string& s) {
            return find_row(rows, b, s, scale).ms;
        };
        for (const std::string& b : backends) {
            ratios.push_back({fmt::format("{}: divide and merge / fused, {}x", b, scale),
                              ms(b, divided) / ms(b, fused), b == "GL" ? ">= 2.5" : ""});
        }
        for (const std::string& b : backends) {
            if (b == "plain C++") continue;
            add_sweep_ratios(rows, b, scale, ratios);
        }
        if (options.use_gl) {
            ratios.push_back({fmt::format("GL / plain C++, fused, {}x", scale),
                              ms("GL", fused) / ms("plain C++", fused), "<= 2 on llvmpipe"});
        }
        ratios.push_back({fmt::format("plain C++ / CPU on one thread, fused, {}x", scale),
                          ms("plain C++", fused) / ms("CPU, 1 thread", fused), ">= 2"});
    }
    for (const std::string& b : backends) {
        const int most = options.scales.back(), least = options.scales.front();
        const Row& large = find_row(rows, b, fused, most);
        const Row& small = find_row(rows, b, fused, least);
        ratios.push_back({fmt::format("{}: cost per spring, {}x / {}x", b, most, least),
                          large.ms / large.springs / (small.ms / small.springs), "<= 1.5"});
    }
    return ratios;
}

void write_json(const std::filesystem::path& file, const std::string& device, const std::vector<Row>& rows,
                const std::vector<BenchRatio>& ratios) {
    nlohmann::ordered_json json;
    json["gelatin"] = {{"version", version()}, {"commit", commit()}};
    json["benchmark"] = "kernels";
    json["device"] = device;
    json["cpu"] = cpu::simd_target();
    for (const Row& r : rows) {
        json["stages"].push_back({{"backend", r.backend},
                                  {"stage", r.stage},
                                  {"scale", r.scale},
                                  {"ms", r.ms},
                                  {"spread", r.spread},
                                  {"bytes", r.bytes},
                                  {"springs", r.springs}});
    }
    for (const BenchRatio& r : ratios)
        json["ratios"].push_back({{"what", r.what}, {"value", r.value}, {"wanted", r.wanted}});
    write_file(file, json.dump(2) + "\n");
}

}  // namespace

void bench_kernels(const KernelBenchOptions& options) {
    std::optional<gl::Context> context;
    if (options.use_gl) context = gl::Context::headless();
    const std::string device =
        context ? context->device().renderer + ", " + context->device().version : "no OpenGL";
    fmt::print("gelatin {} ({}), {}, {} hardware threads\nGL: {}\n\n", version(), commit(),
               cpu::simd_target(), tbb::info::default_concurrency(), device);

    const TetMesh sphere = tetrahedralise(make_sphere({0.5, 20}), MesherSettings{}, "sphere");
    std::vector<Row> rows;
    for (const int scale : options.scales) {
        const auto model = make_spheres(sphere, scale);
        const double step = 0.5 * largest_stable_step(SolverKind::semi_implicit_euler, *model);
        std::vector<Case> cases;
        add_plain_cases(model, step, cases);
        add_cpu_cases(model, step, cases);
        if (context) add_gl_cases(model, step, cases);
        const std::vector<Row> timed =
            time_cases(cases, scale, options.runs, static_cast<double>(model->springs.size()));
        print_rows(timed);
        fmt::print("\n");
        rows.insert(rows.end(), timed.begin(), timed.end());
    }
    const std::vector<BenchRatio> ratios = summarise(rows, options);
    for (const BenchRatio& r : ratios) fmt::print("{:<52} {:>6.2f}  {}\n", r.what, r.value, r.wanted);
    if (!options.json.empty()) write_json(options.json, device, rows, ratios);
}

}  // namespace gelatin
