#include <CLI/CLI.hpp>
#include <memory>

#include "bench/contact.h"
#include "bench/kernels.h"
#include "bench/materials.h"
#include "bench/paper.h"
#include "bench/scaling.h"
#include "commands.h"

namespace gelatin {
namespace {

void add_kernels(CLI::App& bench) {
    auto options = std::make_shared<KernelBenchOptions>();
    CLI::App* kernels =
        bench.add_subcommand("kernels", "Each stage on each backend: ms, bytes, rate, ratios");
    kernels->add_option("--json", options->json, "Also write the figures to this file")
        ->type_name("FILE.json");
    kernels->add_option("--report", options->report, "Also write a report")->type_name("FILE.md");
    kernels->add_option("--runs", options->runs, "Samples of each stage; the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    kernels->add_option("--scales", options->scales, "Sizes, as multiples of three spheres of 4,581 nodes")
        ->delimiter(',')
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    kernels->add_flag("!--no-gl", options->use_gl, "Without OpenGL");
    kernels->callback([options] { bench_kernels(*options); });
}

void add_paper(CLI::App& bench) {
    auto options = std::make_shared<PaperBenchOptions>();
    CLI::App* paper = bench.add_subcommand(
        "paper", "Frames per second of the paper's two simulations, compared with the paper");
    paper->add_option("--json", options->json, "Also write the figures to this file")->type_name("FILE.json");
    paper->add_option("--report", options->report, "Also write a report (.md)")->type_name("FILE.md");
    paper->add_option("--runs", options->runs, "Runs of each system; the mean counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    paper
        ->add_option("--only", options->only,
                     "Measure what has this in its name: \"free fall\", \"paper, GPU\", \", drawn\"")
        ->type_name("PART");
    paper
        ->add_option("--scenes", options->scenes,
                     "Folder of free_fall.toml and collision.toml; default: scenes here, or of the sources")
        ->type_name("DIR");
    paper
        ->add_option("--frames", options->frames, "Length of a run, instead of the scene's simulation.frames")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000));
    paper
        ->add_option("--whole-limit", options->whole_limit,
                     "Seconds that a whole run may take; longer ones are sampled")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    paper->add_option("--windows", options->windows, "Of a sampled run, spread evenly")
        ->check(CLI::Range(1, 10'000))
        ->capture_default_str();
    paper->add_option("--window-frames", options->window_frames, "Frames timed in each window")
        ->check(CLI::Range(1, 10'000))
        ->capture_default_str();
    paper->callback([options] { bench_paper(*options); });
}

void add_scaling(CLI::App& bench) {
    auto options = std::make_shared<ScalingBenchOptions>();
    CLI::App* scaling = bench.add_subcommand(
        "scaling", "Cost of collision by number of faces and objects, with trees and by brute force");
    scaling->add_option("--json", options->json, "Also write the figures to this file")
        ->type_name("FILE.json");
    scaling->add_option("--report", options->report, "Also write a report (.md)")->type_name("FILE.md");
    scaling->add_option("--runs", options->runs, "Samples of each measurement; the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    scaling
        ->add_option("--only", options->only,
                     "Measure what has this in its name: \"two bodies, deep\", \"1000 apart\", \"OpenGL\"")
        ->type_name("PART");
    scaling->add_option("--faces", options->faces, "Sizes of the two bodies that touch, about")
        ->delimiter(',')
        ->check(CLI::Range(40, 4'000'000))
        ->capture_default_str();
    scaling->add_option("--objects", options->objects, "Numbers of objects")
        ->delimiter(',')
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    scaling
        ->add_option("--scenes", options->scenes,
                     "Folder of free_fall.toml and rain.toml; default: scenes here, or of the sources")
        ->type_name("DIR");
    scaling->add_flag("!--no-gl", options->use_gl, "Without OpenGL");
    scaling->callback([options] { bench_scaling(*options); });
}

void add_materials(CLI::App& bench) {
    auto options = std::make_shared<MaterialBenchOptions>();
    CLI::App* materials =
        bench.add_subcommand("materials", "Cost of springs and tets, with volume term and damping");
    materials->add_option("--json", options->json, "Also write the figures to this file")
        ->type_name("FILE.json");
    materials->add_option("--report", options->report, "Also write a report")->type_name("FILE.md");
    materials->add_option("--runs", options->runs, "Samples of each measurement; the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    materials
        ->add_option("--frequency", options->frequency, "Of the three balls, of 20 frequency^2 faces each")
        ->check(CLI::Range(2, 200))
        ->capture_default_str();
    materials->add_option("--beam-nodes", options->beam_nodes, "Of SOFA's beam, across, across and along it")
        ->delimiter('x')
        ->expected(3)
        ->type_name("NxNxN")
        ->check(CLI::Range(2, 1000));
    materials->add_option("--iterations", options->iterations, "Of the beam's steps")
        ->delimiter(',')
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    materials->add_flag("!--no-gl", options->use_gl, "Without OpenGL");
    materials->callback([options] { bench_materials(*options); });
}

void add_contact(CLI::App& bench) {
    auto options = std::make_shared<ContactBenchOptions>();
    CLI::App* contact =
        bench.add_subcommand("contact", "Frames in which bodies press each other: ms, dispatches, bytes");
    contact->add_option("--json", options->json, "Also write the figures to this file")
        ->type_name("FILE.json");
    contact->add_option("--report", options->report, "Also write a report")->type_name("FILE.md");
    contact->add_option("--runs", options->runs, "Of each measurement; the median counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    contact->add_option("--scales", options->scales, "Sizes, as copies of each scene's bodies")
        ->delimiter(',')
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    contact->add_option("--frames", options->frames, "Frames that are timed at most, instead of each window")
        ->type_name("N")
        ->check(CLI::Range(1, 1000));
    contact
        ->add_option("--only", options->only,
                     "Measure what has this in its name: \"pile\", \"A, 10x\", \"OpenGL\"; may be repeated")
        ->type_name("PART")
        ->allow_extra_args(false);
    contact
        ->add_option(
            "--scenes", options->scenes,
            "Folder of scene_a.toml, scene_b.toml, pile.toml and rain.toml; default: those of the sources")
        ->type_name("DIR");
    contact->add_flag("!--no-gl", options->use_gl, "Without OpenGL");
    contact->callback([options] { bench_contact(*options); });
}

}  // namespace

void add_bench_command(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "Measure speed on this machine");
    bench->require_subcommand(1);
    add_paper(*bench);
    add_kernels(*bench);
    add_scaling(*bench);
    add_materials(*bench);
    add_contact(*bench);
}

}  // namespace gelatin
