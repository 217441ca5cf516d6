#include "bench/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "bench/contact_report.h"
#include "bench/contact_result.h"
#include "bench/memory_rate.h"
#include "bench/moved_bytes.h"
#include "common/output_file.h"
#include "core/file.h"
#include "gelatin/error.h"
#include "gl/context.h"

namespace gelatin {
namespace {

class ContactBenchRun {
public:
    ContactBenchRun(const ContactBenchOptions& options, const gl::Context* context)
        : systems_(stage_systems(context != nullptr)) {
        bench_.options = options;
        bench_.machine = describe_bench_machine(context != nullptr ? &context->device() : nullptr);
    }
    /// At all sizes. Runs nothing of a scene of which nothing is requested.
    void measure(const ContactScene& scene);
    void measure_memory();
    ContactBench take_result() { return std::move(bench_); }

private:
    struct Measured {
        ContactResult result;
        std::unique_ptr<ContactPlayer> player;
    };

    std::vector<StageSystem> wanted(const ContactScene& scene, int scale) const;
    void measure(const ContactScene& scene, int scale, const ContactCase& contact_case);
    void for_each(std::vector<Measured>& all, const std::function<void(Measured&)>& work);

    ContactBench bench_;
    std::vector<StageSystem> systems_;
};

std::vector<StageSystem> ContactBenchRun::wanted(const ContactScene& scene, int scale) const {
    std::vector<StageSystem> wanted;
    const std::vector<std::string>& parts = bench_.options.only;
    for (const StageSystem& system : systems_) {
        const std::string label = contact_label(scene, scale, system);
        const auto is_in_label = [&](const std::string& part) {
            return label.find(part) != std::string::npos;
        };
        if (parts.empty() || std::any_of(parts.begin(), parts.end(), is_in_label)) wanted.push_back(system);
    }
    return wanted;
}

void ContactBenchRun::measure(const ContactScene& scene) {
    std::optional<ContactLeadIn> lead_in;
    for (const int scale : bench_.options.scales) {
        if (wanted(scene, scale).empty()) continue;
        if (!lead_in) lead_in.emplace(scene, bench_.options.scenes);
        measure(scene, scale, lead_in->copies(scale));
    }
}

// Samples all systems alternately.
void ContactBenchRun::measure(const ContactScene& scene, int scale, const ContactCase& contact_case) {
    const Model& model = *contact_case.model;
    const int window = scene.last - scene.first,
              frames = std::min(bench_.options.frames.value_or(window), window);
    std::vector<Measured> all;
    for (const StageSystem& system : wanted(scene, scale)) {
        all.push_back({{&scene,
                        scale,
                        system,
                        model.body_count(),
                        model.node_count(),
                        model.faces.size(),
                        frames,
                        linearise_bytes(model),
                        iteration_bytes(model),
                        {},
                        {}},
                       nullptr});
    }
    for_each(all, [&](Measured& m) {
        std::fprintf(stderr, "gelatin: %s\n", m.result.label().c_str());
        m.player = std::make_unique<ContactPlayer>(contact_case, m.result.system, frames);
    });
    for (int run = 0; run < bench_.options.runs; ++run)
        for_each(all, [](Measured& m) { m.result.samples.push_back(m.player->sample()); });
    for_each(all, [&](Measured& m) {
        if (m.result.system.uses_gl) m.result.dispatches = summarise(m.player->count_dispatches(), frames);
    });
    for (Measured& m : all) bench_.results.push_back(std::move(m.result));
}

// What a device has no room for is left out, with its reason.
void ContactBenchRun::for_each(std::vector<Measured>& all, const std::function<void(Measured&)>& work) {
    for (auto m = all.begin(); m != all.end();) {
        try {
            work(*m);
            ++m;
        } catch (const GlError& error) {
            bench_.left_out.push_back(m->result.label() + ": " + error.what());
            std::fprintf(stderr, "gelatin: left out: %s\n", bench_.left_out.back().c_str());
            m = all.erase(m);
        }
    }
}

void ContactBenchRun::measure_memory() {
    for (const ContactResult& result : bench_.results) {
        double& rate = bench_.memory_rates[result.system.name];
        if (rate > 0.0) continue;
        rate = result.system.uses_gl ? device_memory_rate() : cpu_memory_rate(result.system.threads);
    }
}

}  // namespace

void bench_contact(const ContactBenchOptions& options) {
    if (!options.json.empty()) check_output_file("--json", options.json);
    if (!options.report.empty()) check_output_file("--report", options.report, {".md"});
    std::optional<gl::Context> context;
    if (options.use_gl) context = gl::Context::headless();
    ContactBenchRun run(options, context ? &*context : nullptr);
    for (const ContactScene& scene : contact_scenes()) run.measure(scene);
    run.measure_memory();
    const ContactBench bench = run.take_result();
    if (bench.results.empty() && !bench.left_out.empty()) throw GlError(bench.left_out.front());
    if (bench.results.empty()) {
        throw InvalidInput({{},
                            0,
                            "--only",
                            fmt::format("{}", fmt::join(options.only, ", ")),
                            "is part of no measurement's name, such as \"" +
                                contact_label(contact_scenes().front(), options.scales.front(),
                                              stage_systems(false).front()) +
                                "\""});
    }
    fmt::print(message_stream({options.json, options.report}), "{}", contact_tables(bench));
    if (!options.json.empty()) write_file(options.json, contact_json(bench));
    if (!options.report.empty()) write_contact_report(options.report, bench);
}

}  // namespace gelatin
