#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/contact.h"
#include "bench/contact_cases.h"
#include "bench/contact_player.h"
#include "bench/machine.h"
#include "bench/ratios.h"

namespace gelatin {

/// Of a step, as solvers name them; what is left is kOtherStages.
inline constexpr std::array kContactStages{"detect", "linearise", "solve", "finish", "guard"};
inline constexpr const char* kOtherStages = "others";

/// What a device was given to do. Means of a frame.
struct ContactDispatches {
    /// How many were launched, and how many of them had work groups.
    struct Count {
        double launched = 0.0, working = 0.0;
    };
    std::map<std::string, Count> stages;  ///< by kContactStages and kOtherStages
    Count all;
    Count tries;              ///< to make parts; `working` are those that solved a system
    double iterations = 0.0;  ///< of the solve

    /// With work, of one part, without the iterations of its solve.
    double of_part() const;
};
ContactDispatches summarise(const gl::DispatchCounter::Counts& counts, int frames);

/// The measurement of one scene at one size on one system.
struct ContactResult {
    const ContactScene* scene;
    int scale;
    StageSystem system;
    std::size_t bodies, nodes, faces;
    int frames;
    double linearise_bytes, iteration_bytes;  ///< of the whole model, once
    std::vector<ContactSample> samples;
    std::optional<ContactDispatches> dispatches;  ///< empty on a CPU

    std::string label() const { return contact_label(*scene, scale, system); }
    /// Medians of samples [ms a frame].
    double mean() const;
    double median() const;
    double worst() const;
    double stage(const std::string& name) const;
    /// A frame, of the last sample.
    double tries() const { return samples.back().tries; }
    double contacts() const { return samples.back().contacts; }
    /// Moved at least in a frame; 0 where no formula holds.
    double bytes(const std::string& stage) const;
    double rate(const std::string& stage) const {
        return 1e3 * bytes(stage) / this->stage(stage);
    }  ///< [B/s]
};

/// One run of `gelatin bench contact`.
struct ContactBench {
    ContactBenchOptions options;
    BenchMachine machine;
    std::map<std::string, double> memory_rates;  ///< of a copy, by system [B/s]
    std::vector<ContactResult> results;
    std::vector<std::string> left_out;  ///< measurements, each with the reason

    /// The important ratios.
    std::vector<BenchRatio> ratios() const;
};

}  // namespace gelatin
