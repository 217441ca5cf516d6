#include "gpu/support/implicit_scenarios.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cpu/implicit/elastic_system.h"
#include "cpu/implicit/step_system.h"
#include "gpu/implicit/elastic_system.h"
#include "gpu/implicit/step_system.h"
#include "gpu/support/body_contact_runs.h"
#include "gpu/support/pair_guard_scenarios.h"
#include "gpu/support/pair_rows_scenarios.h"
#include "gpu/support/pair_scenarios.h"
#include "gpu/support/part_end_scenarios.h"
#include "gpu/support/part_start_scenarios.h"
#include "model/shared_constants.h"
#include "support/contact_scenes.h"
#include "support/converted.h"
#include "support/elastic_cases.h"
#include "support/parity.h"
#include "support/random_maker.h"

namespace gelatin::test {
namespace {

constexpr float kInverseStep = 240.0f;  // [1/s]

// A part of that length, and damping times of nodes as they are in the model.
class ElasticStart {
public:
    explicit ElasticStart(const Model& model) : buffers_(model), nodes(model.positions, model.velocities) {
        tries.set_clock(clock_of_part());
        std::vector<float> times;
        for (const glm::vec4& v : model.velocities) times.push_back(v.w);
        damping_times_ = {times, gl::TexelFormat::r32f};
    }
    void linearise(const gpu::ElasticSystem& system) {
        system.linearise(buffers_, nodes, damping_times_.texels(), tries);
    }

private:
    static StepClock clock_of_part() {
        StepClock clock{};
        clock.step = 1.0f / kInverseStep;
        clock.goes_on = 1;
        return clock;
    }
    gpu::ModelBuffers buffers_;

public:
    gpu::NodeBuffers nodes;
    gpu::Tries tries;

private:
    gl::TexelTable<float> damping_times_;
};

struct ElasticResult {
    std::vector<glm::dvec3> forces, diagonals, besides, products;
};

std::vector<glm::dvec3> xyz_of(const std::vector<glm::vec4>& values) {
    std::vector<glm::dvec3> result;
    for (const glm::vec4& value : values) result.emplace_back(value);
    return result;
}

ElasticResult elastic_on_gpu(const Model& model) {
    ElasticStart start(model);
    gpu::ElasticSystem system(model);
    start.linearise(system);
    std::vector<glm::vec4> values;
    for (const cpu::Vec3<float>& d : random_field<float>(model.node_count(), 1)) values.emplace_back(d, 0.0f);
    system.displacements.upload(values);
    const gl::Buffer<glm::vec4> products(poisoned(model.node_count()));
    system.multiply(products);
    gl::barrier(gl::Barrier::buffer_update);
    ElasticResult result;
    system.forces().download(values);
    result.forces = xyz_of(values);
    products.download(values);
    result.products = xyz_of(values);
    std::vector<NodeBlock> blocks(model.node_count());
    system.blocks().download(blocks);
    for (const NodeBlock& block : blocks) {
        result.diagonals.emplace_back(block.diagonal);
        result.besides.emplace_back(block.beside);
    }
    return result;
}

ElasticResult elastic_reference(const Model& model) {
    cpu::ElasticSystem<double> system(std::make_shared<const Model>(model));
    system.linearise(converted<double>(model.positions), converted<double>(model.velocities), kInverseStep);
    const std::vector<cpu::Vec3<double>> d = random_field<double>(model.node_count(), 1);
    for (std::size_t n = 0; n < d.size(); ++n) system.displacements[n] = glm::dvec4(d[n], 0.0);
    for (const ModelObject& body : model.bodies()) system.begin_product(body);
    ElasticResult result;
    result.products.resize(d.size());
    system.multiply({0, model.node_count()}, result.products);
    result.forces = system.forces();
    for (const auto& block : system.diagonal()) {
        result.diagonals.push_back(block.diagonal);
        result.besides.push_back(block.beside);
    }
    return result;
}

// Of the distance of two fields, over a part of the norm of the second; a node that is wrong alone counts.
double error_of(std::span<const glm::dvec3> actual, std::span<const glm::dvec3> expected, double tolerance) {
    double squares = 0.0, worst = 0.0;
    for (std::size_t n = 0; n < expected.size(); ++n) {
        squares += glm::dot(expected[n], expected[n]);
        const double distance = glm::distance(actual[n], expected[n]);
        if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, distance);
    }
    return worst / (tolerance * std::sqrt(squares / static_cast<double>(expected.size())));
}

double elastic_error(const Model& model) {
    const ElasticResult actual = elastic_on_gpu(model), expected = elastic_reference(model);
    return std::max({error_of(actual.forces, expected.forces, 1e-4),
                     error_of(actual.diagonals, expected.diagonals, 1e-5),
                     error_of(actual.besides, expected.besides, 1e-5),
                     error_of(actual.products, expected.products, 1e-5)});
}

// What a system is solved for: bodies that are pushed and pulled at random, with rows or without.
struct SolveCase {
    std::shared_ptr<const Model> model;
    int iterations;
    float enough;  // [J]
    std::vector<cpu::ContactRow<double>> rows{};
    std::vector<std::uint32_t> islands{};  // of bodies; none: a body each
    std::vector<std::uint8_t> asleep{};    // bodies, after a solve in which none is
    float push = 0.01f;                    // how far bodies would go [m]
    std::uint32_t small_chunks = 0;        // as in gpu::StepSystem
};

struct SolveInput {
    std::vector<glm::vec4> loads, guesses;  // w of loads: m / h^2, 0 where a node is held
    std::vector<std::uint32_t> islands;
};

struct SolveResult {
    std::vector<glm::dvec3> displacements;
    std::vector<double> limits;  // of rows
    std::uint32_t iterations;
};

SolveInput solve_input(const SolveCase& at) {
    const Model& model = *at.model;
    const std::vector<cpu::Vec3<float>> pushes = random_field<float>(model.node_count(), 2),
                                        guesses = random_field<float>(model.node_count(), 3);
    SolveInput input;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const float w = model.positions[n].w, inertia = w > 0.0f ? kInverseStep * kInverseStep / w : 0.0f;
        // Those of a body have much in common.
        input.loads.emplace_back(at.push * inertia * (glm::vec3(0.5f, -1.0f, 0.2f) + 0.3f * pushes[n]),
                                 inertia);
        input.guesses.emplace_back(0.003f * guesses[n], 0.0f);
    }
    input.islands = at.islands;
    for (std::uint32_t o = 0; o < at.asleep.size(); ++o) {
        if (at.asleep[o] == 0) continue;
        const Range& nodes = model.objects[o].nodes;
        std::fill_n(input.loads.begin() + nodes.first, nodes.count, glm::vec4(0.0f));
        std::fill_n(input.guesses.begin() + nodes.first, nodes.count, glm::vec4(0.0f));
    }
    if (input.islands.empty()) {
        input.islands.resize(model.body_count());
        std::iota(input.islands.begin(), input.islands.end(), 0u);
    }
    return input;
}

StepRow converted_row(const cpu::ContactRow<double>& row) {
    const auto& nodes = row.nodes;
    const auto& w = row.weights;
    return {nodes[0],
            nodes[1],
            nodes[2],
            nodes[3],
            glm::vec4(w[0], w[1], w[2], w[3]),
            glm::vec4(row.normal, row.gap),
            static_cast<float>(row.reach),
            static_cast<float>(row.stiffness),
            static_cast<float>(row.damping),
            static_cast<float>(row.friction),
            glm::vec4(row.hold, row.limit),
            row.object,
            row.other,
            0,
            0};
}

SolveResult solve_on_gpu(const SolveCase& at) {
    const Model& model = *at.model;
    ElasticStart start(model);
    const std::size_t most = at.rows.empty() ? 0 : at.rows.size() + 3;
    gpu::StepSystem system(model, start.tries, {most, most}, at.small_chunks);
    system.enough().upload(std::vector<float>(model.objects.size(), at.enough));
    system.set_iterations(at.iterations);
    std::vector<StepRow> rows;
    for (const cpu::ContactRow<double>& row : at.rows) rows.push_back(converted_row(row));
    start.linearise(system.elastic);
    const auto solve = [&](const SolveCase& some) {
        SolveInput input = solve_input(some);
        for (std::size_t o = 0; o < some.asleep.size(); ++o)
            if (some.asleep[o] != 0) input.islands[o] = packing::kNone;
        system.loads().upload(input.loads);
        system.displacements().upload(input.guesses);
        system.set_rows(rows, input.islands);
        system.begin_bodies(start.nodes);
        system.solve(start.nodes);
    };
    if (!at.asleep.empty()) {
        SolveCase awake = at;
        awake.asleep.clear();
        solve(awake);
        gl::barrier(gl::Barrier::buffer_update);
    }
    solve(at);
    SolveResult result;
    for (const glm::vec4& slip : system.slips()) result.limits.push_back(static_cast<double>(slip.w));
    result.iterations = 0;
    for (const SolveState& state : system.states()) result.iterations += state.iterations;
    std::vector<glm::vec4> values(model.node_count());
    system.displacements().download(values);
    result.displacements = xyz_of(values);
    return result;
}

SolveResult solve_reference(const SolveCase& at) {
    const auto& model = at.model;
    const SolveInput input = solve_input(at);
    const std::vector<glm::dvec4> positions = converted<double>(model->positions);
    cpu::StepSystem<double> system(model);
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        system.inertia[n] = input.loads[n].w;
        system.loads[n] = glm::dvec3(input.loads[n]);
        system.displacements[n] = glm::dvec3(input.guesses[n]);
    }
    std::fill(system.enough.begin(), system.enough.end(), static_cast<double>(at.enough));
    system.iterations = at.iterations;
    system.rows = at.rows;
    if (!at.asleep.empty()) system.leave_out(at.asleep);
    system.elastic.linearise(positions, converted<double>(model->velocities), kInverseStep);
    system.rigid.begin(positions, system.inertia);
    system.solve(input.islands);
    SolveResult result{system.displacements, {}, static_cast<std::uint32_t>(system.counts.iterations)};
    for (const cpu::ContactRow<double>& row : system.rows) result.limits.push_back(row.limit);
    return result;
}

// Of limits, over a hundredth of the greatest.
double error_of_limits(const std::vector<double>& actual, const std::vector<double>& expected) {
    double worst = 0.0, greatest = 0.0;
    for (std::size_t r = 0; r < expected.size(); ++r) {
        worst = std::max(worst, std::abs(actual[r] - expected[r]));
        greatest = std::max(greatest, expected[r]);
    }
    return worst > 0.0 ? worst / (0.01 * greatest) : 0.0;
}

double error_of_solve(const SolveCase& at) {
    const SolveResult actual = solve_on_gpu(at), expected = solve_reference(at);
    if (actual.iterations != expected.iterations) return std::numeric_limits<double>::infinity();
    return std::max(error_of(actual.displacements, expected.displacements, 1e-4),
                    error_of_limits(actual.limits, expected.limits));
}

// Contacts of blocks, with numbers that float has, too.
class RowMaker {
public:
    explicit RowMaker(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// @param object kNoNode: a plane
    void add(std::uint32_t object, std::uint32_t other, int count, const glm::dvec3& normal,
             double friction) {
        for (int k = 0; k < count; ++k) {
            cpu::ContactRow<double> row;
            row.object = object;
            row.other = other;
            row.normal = glm::dvec3(glm::vec3(glm::normalize(normal + random_.point(0.1))));
            row.reach = number(4e-3, 8e-3);
            row.gap = row.reach * number(0.02, 1.5);
            row.stiffness = number(1e4, 1e5);
            row.damping = k % 3 == 0 ? number(0.0, 1e3) : 0.0;
            row.friction = number(0.5 * friction, friction);
            if (friction > 0.0) {
                row.hold = glm::dvec3(glm::vec3(glm::cross(row.normal, random_.point(5.0))));
                row.limit = number(0.0, 10.0);
            }
            if (object != kNoNode) add_nodes(object, -1.0, k % 3, row);
            add_nodes(other, 1.0, (k + 1) % 2, row);
            rows.push_back(row);
        }
    }

    std::vector<cpu::ContactRow<double>> rows;

private:
    double number(double low, double high) { return static_cast<float>(random_.uniform(low, high)); }
    // Of one side, one node or two.
    void add_nodes(std::uint32_t object, double sign, int kind, cpu::ContactRow<double>& row) {
        const Range& nodes = model_->objects[object].nodes;
        const auto node = static_cast<std::uint32_t>(random_.integer(0, static_cast<int>(nodes.count) - 2));
        const double part = kind == 0 ? 1.0 : 0.25;
        for (std::uint32_t k = 0; k < (kind == 0 ? 1u : 2u); ++k) {
            row.nodes[row.count] = nodes.first + node + k;
            row.weights[row.count++] = sign * (k == 0 ? part : 1.0 - part);
        }
    }

    std::shared_ptr<const Model> model_;
    RandomMaker random_{7};
};

const glm::dvec3 kUp(0.0, 1.0, 0.0), kAlong(1.0, 0.0, 0.0);

// Three blocks of an island on a plane, the second above the first; a block alone; two blocks of another
// island.
SolveCase several_islands(double friction, int rows, bool is_held) {
    std::vector<Block> blocks{{},
                              {.place = {0, 0.31, 0}},
                              {.place = {0.31, 0, 0}},
                              {.place = {2, 0, 0}},
                              {.place = {4, 0, 0}},
                              {.place = {4.31, 0, 0}}};
    if (is_held) blocks[2].pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.2}};
    SolveCase at{make_blocks(blocks, {0, -10, 0}), 30, 1e-7f, {}, {0, 0, 0, 3, 4, 4}};
    RowMaker maker(at.model);
    maker.add(kNoNode, 0, rows, kUp, friction);
    maker.add(4, 5, rows, kAlong, friction);
    maker.add(0, 1, 2 * rows, kUp, friction);
    maker.add(kNoNode, 2, rows, kUp, friction);
    maker.add(2, 1, rows / 2, kUp, friction);
    maker.add(0, 2, rows, kAlong, friction);
    maker.add(1, 1, 3, kAlong, friction);
    at.rows = maker.rows;
    return at;
}

// A block that is held, on a plane. It has no rigid motion, so friction's limits stay what they were.
SolveCase held_block() {
    SolveCase at{make_blocks({{.pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.2}}}}, {0, -10, 0}), 30, 1e-7f};
    RowMaker maker(at.model);
    maker.add(kNoNode, 0, 30, kUp, 0.4);
    at.rows = maker.rows;
    return at;
}

// Of six soft blocks on a plane, pushed far into each other.
SolveCase stack(double friction) {
    std::vector<Block> blocks;
    for (int k = 0; k < 6; ++k)
        blocks.push_back({.place = {0.02 * k, 0.301 * k, 0.0}, .youngs_modulus = 2e4});
    SolveCase at{make_blocks(blocks, {0, -10, 0}), 10, 1e-6f, {}, {0, 0, 0, 0, 0, 0}};
    at.push = 0.05f;
    RowMaker maker(at.model);
    maker.add(kNoNode, 0, 40, kUp, friction);
    for (std::uint32_t k = 0; k < 5; ++k) maker.add(k, k + 1, 40, kUp, friction);
    at.rows = maker.rows;
    return at;
}

// A soft block pushed into the surface of a collider, whose nodes move.
SolveCase block_on_a_surface() {
    ColliderDescription table;
    table.shape = Shape(BoxShape{{0.4, 0.1, 0.4}});
    table.position = {0.15, -0.1, 0.15};
    SolveCase at{make_blocks({{.youngs_modulus = 2e4}}, {0, -10, 0}, {table}), 10, 1e-6f};
    at.push = 0.05f;
    RowMaker maker(at.model);
    maker.add(1, 0, 40, kUp, 0.4);
    at.rows = maker.rows;
    return at;
}

}  // namespace

Scenarios elastic_system_scenarios() {
    Scenarios scenarios;
    for (const ElasticCase& at : elastic_cases()) {
        for (const float extent : {0.003f, 0.03f}) {
            Model model = at.model;
            shake_nodes(model, extent);
            scenarios.push_back({at.name + (extent > 0.01f ? "_shaken" : ""),
                                 [model = std::move(model)] { return elastic_error(model); }});
        }
    }
    // Nearly a point.
    Model small = make_elastic_block(MaterialModel::neo_hookean, 0.3);
    for (glm::vec4& p : small.positions) p = glm::vec4(0.05f * glm::vec3(p), p.w);
    scenarios.push_back({"collapsed", [small = std::move(small)] { return elastic_error(small); }});
    return scenarios;
}

Scenarios step_system_scenarios(std::uint32_t small_chunks) {
    Scenarios scenarios;
    const auto solve_error = [small_chunks](SolveCase at) {
        at.small_chunks = small_chunks;
        return error_of_solve(at);
    };
    for (const double friction : {0.0, 0.4})
        for (const bool is_held : {false, true})
            for (const int rows : {6, 60})
                scenarios.push_back({std::string("rows") + (friction > 0.0 ? "_with_friction" : "") +
                                         (is_held ? "_with_a_held_body" : "") +
                                         (rows > 6 ? "_of_several_chunks" : ""),
                                     [=] { return solve_error(several_islands(friction, rows, is_held)); }});
    scenarios.push_back({"rows_after_few_iterations", [=] {
                             SolveCase at = several_islands(0.4, 20, false);
                             at.iterations = 2;
                             return solve_error(at);
                         }});
    scenarios.push_back(
        {"rows_of_what_was_solved_before_and_sleeps", [=] {
             SolveCase at = several_islands(0.4, 20, false);
             at.asleep = {0, 0, 1, 0, 0, 1};
             std::erase_if(at.rows, [](const auto& row) { return row.object == kNoNode && row.other == 2; });
             return solve_error(at);
         }});
    scenarios.push_back({"rows_of_a_held_body", [=] { return solve_error(held_block()); }});
    scenarios.push_back({"rows_with_a_moving_surface", [=] { return solve_error(block_on_a_surface()); }});
    scenarios.push_back({"rows_of_what_is_enough_at_once", [=] {
                             SolveCase at = several_islands(0.4, 20, false);
                             at.enough = 1e9f;
                             return solve_error(at);
                         }});
    for (const double friction : {0.0, 0.6})
        scenarios.push_back(
            {friction > 0.0 ? "stack_with_friction" : "stack", [=] { return solve_error(stack(friction)); }});
    for (const ElasticCase& at : elastic_cases()) {
        Model shaken = at.model;
        shake_nodes(shaken, 0.003f);
        const auto model = std::make_shared<const Model>(std::move(shaken));
        scenarios.push_back({at.name, [=] { return solve_error({model, 3, 0.0f}); }});
        scenarios.push_back({at.name + "_to_the_end", [=] { return solve_error({model, 30, 1e-5f}); }});
    }
    return scenarios;
}

Scenarios small_island_scenarios(bool with_rows) {
    Scenarios scenarios = step_system_scenarios(packing::kChunksOfSmallIsland);
    std::erase_if(scenarios, [&](const Scenario& scenario) {
        const bool has_rows = scenario.name.starts_with("rows") || scenario.name.starts_with("stack");
        return has_rows != with_rows;
    });
    for (Scenario& scenario : scenarios) scenario.name += "_in_small_islands";
    if (!with_rows) return scenarios;
    scenarios.push_back(
        {"rows_of_a_body_of_several_chunks", [] {
             SolveCase at{
                 make_blocks({{.cells = {6, 6, 6}}, {.place = {0.0, 0.31, 0.0}}}), 30, 1e-7f, {}, {0, 0}};
             at.small_chunks = packing::kChunksOfSmallIsland;
             RowMaker maker(at.model);
             maker.add(kNoNode, 0, 20, kUp, 0.4);
             maker.add(0, 1, 20, kUp, 0.4);
             at.rows = maker.rows;
             return error_of_solve(at);
         }});
    scenarios.push_back({"rows_in_islands_small_and_large", [] {
                             SolveCase at = several_islands(0.4, 20, false);
                             at.small_chunks = 2;
                             return error_of_solve(at);
                         }});
    return scenarios;
}

bool solves_repeat() {
    SolveCase at = several_islands(0.4, 60, false);
    const auto repeats = [&] { return solve_on_gpu(at).displacements == solve_on_gpu(at).displacements; };
    if (!repeats()) return false;
    at.small_chunks = packing::kChunksOfSmallIsland;
    return repeats();
}

void run_implicit_programs() {
    solve_on_gpu({make_blocks({{}}), 2, 0.0f});
    SolveCase with_rows = several_islands(0.4, 2, false);
    with_rows.iterations = 1;
    solve_on_gpu(with_rows);
    with_rows.small_chunks = packing::kChunksOfSmallIsland;
    solve_on_gpu(with_rows);
    for (const ElasticCase& at : elastic_cases()) elastic_on_gpu(at.model);
    run_end_programs();
    run_part_start();
    run_find_pairs();
    run_pair_rows();
    run_pair_guard();
    run_body_contacts();
}

}  // namespace gelatin::test
