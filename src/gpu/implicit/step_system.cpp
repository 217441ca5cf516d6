#include "gpu/implicit/step_system.h"

#include <cassert>
#include <numeric>

#include "gl/context.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

// Of a round its islands, and its chunks; its iterations follow.
constexpr std::uint32_t kArgumentsOfRound = 2;

void bind_positions(const gl::Program& program, const NodeBuffers& at) {
    program.bind_declared("positions", at.position_texels);
}

// Of a work group that has an island to itself (island_lanes.glsl).
gl::Program island_program(const char* file) {
    const bool is_software = gl::Context::current().device().is_software;
    return gl::Program::compute(file, is_software ? gl::Defines{"LANES 16"} : gl::Defines{});
}

}  // namespace

StepSystem::Programs::Programs(const gl::Defines& rows)
    : sums(gl::Program::compute("sim/implicit/solve_bodies.comp")),
      bodies(gl::Program::compute("sim/implicit/solve_bodies.comp", {"OBJECTS"})),
      start(gl::Program::compute("sim/implicit/solve_start.comp")),
      first_direction(gl::Program::compute("sim/implicit/solve_direction.comp", {"FIRST"})),
      product(gl::Program::compute("sim/implicit/solve_product.comp", rows)),
      residual(gl::Program::compute("sim/implicit/solve_residual.comp")),
      direction(gl::Program::compute("sim/implicit/solve_direction.comp")),
      finish(gl::Program::compute("sim/implicit/find_base.comp", {"FINISH"})) {
    gl::Defines first = rows;
    first.emplace_back("FIRST");
    begin = gl::Program::compute("sim/implicit/solve_begin.comp", first);
}

std::vector<const gl::Program*> StepSystem::Programs::all() const {
    return {&sums, &bodies, &begin, &start, &first_direction, &product, &residual, &direction, &finish};
}

StepSystem::RowPrograms::RowPrograms()
    : begin(island_program("sim/implicit/begin_rows.comp")),
      base(gl::Program::compute("sim/implicit/find_base.comp")),
      newton(island_program("sim/implicit/rigid_newton.comp")),
      move(gl::Program::compute("sim/implicit/move_bodies.comp")),
      linearise(island_program("sim/implicit/linearise_rows.comp")),
      begin_again(gl::Program::compute("sim/implicit/solve_begin.comp", {"ROWS"})),
      sum_step(gl::Program::compute("sim/implicit/sum_step.comp")),
      line_search(island_program("sim/implicit/line_search.comp")) {}

std::vector<const gl::Program*> StepSystem::RowPrograms::all() const {
    return {&begin, &base, &newton, &move, &linearise, &begin_again, &sum_step, &line_search};
}

StepSystem::StepSystem(const Model& model, Tries& tries, const RowCapacity& capacity,
                       std::uint32_t small_chunks)
    : elastic(model),
      tries_(&tries),
      buffers_(model, capacity, small_chunks),
      programs_(capacity.rows > 0 ? gl::Defines{"ROWS"} : gl::Defines{}),
      capacity_(capacity) {
    assert(small_chunks <= packing::kChunksOfSmallIsland);
    const gl::Defines defines = capacity.rows > 0 ? gl::Defines{"ROWS"} : gl::Defines{};
    if (capacity.rows > 0) rows_.emplace();
    if (small_chunks > 0) small_islands_ = gl::Program::compute("sim/implicit/solve_islands.comp", defines);
    std::vector<std::uint32_t> alone(model.body_count());
    std::iota(alone.begin(), alone.end(), 0u);
    set_rows({}, alone);
    bind_buffers();
    set_iterations(iterations_);
}

// What never changes.
void StepSystem::bind_buffers() const {
    for (const gl::Program* program : programs_.all()) buffers_.bind(*program);
    const Programs& p = programs_;
    p.sums.set("element_count", buffers_.chunk_count);
    p.bodies.set("element_count", buffers_.object_count);
    elastic.bind_product(p.begin, buffers_.displacements.texels);
    elastic.bind_product(p.product, elastic.displacement_texels());
    p.begin.bind("element_blocks", elastic.block_texels());
    p.residual.bind("directions", elastic.displacement_texels());
    for (const gl::Program* program : {&p.first_direction, &p.direction})
        program->bind("Directions", elastic.displacements);
    if (small_islands_) {
        buffers_.bind(*small_islands_);
        elastic.bind_edges(*small_islands_);
        small_islands_->bind("element_blocks", elastic.block_texels());
    }
    if (!rows_) return;
    for (const gl::Program* program : rows_->all()) buffers_.bind(*program);
    rows_->begin_again.bind("element_blocks", elastic.block_texels());
}

void StepSystem::grow(const RowCapacity& capacity) {
    assert(rows_);
    capacity_ = capacity;
    buffers_.grow(capacity);
    bind_buffers();
}

void StepSystem::set_rows(std::span<const StepRow> rows, std::span<const std::uint32_t> islands_of_bodies) {
    assert(rows.size() <= capacity_.rows);
    row_count_ = static_cast<std::uint32_t>(rows.size());
    buffers_.set_rows(rows, islands_of_bodies);
}

// Even, so that states end where they began; the last one does nothing then.
std::uint32_t StepSystem::iterations_of_round() const {
    const int most = rows_ ? iterations_ : 2 * iterations_;
    return static_cast<std::uint32_t>(most + most % 2);
}

void StepSystem::set_iterations(int iterations) {
    iterations_ = iterations;
    const std::size_t arguments = kArgumentsOfRound + iterations_of_round() + 1;
    rounds_ = gl::Buffer<std::uint32_t>(4 * arguments * (contact_tuning::kMostLinearisations + 1));
    for (const gl::Program* program : {&programs_.start, &programs_.direction})
        program->bind("Rounds", rounds_);
    if (rows_) rows_->line_search.bind("Rounds", rounds_);
}

void StepSystem::run(const gl::Program& program, std::uint32_t groups) const {
    tries_->run(Tries::Where::makes_part, program, groups);
}

// With what is in base_sums.
void StepSystem::run_newton(float tolerance) const {
    rows_->newton.set("tolerance", tolerance);
    run(rows_->newton, buffers_.object_count);
    if (buffers_.has_large_islands()) run(rows_->move, buffers_.chunk_count);
}

// A linearisation and its conjugate gradients.
void StepSystem::run_round(std::uint32_t round) const {
    const std::uint32_t count = iterations_of_round(), length = kArgumentsOfRound + count + 1;
    const std::uint32_t begin = round * length, first_iteration = begin + kArgumentsOfRound;
    const auto set = [&](const gl::Program& program, std::uint32_t turn, std::uint32_t next_iteration) {
        program.set("turn", turn);
        program.set("is_first", round == 0 ? 1u : 0u);
        program.set("next_iteration", next_iteration);
        program.set("next_round", begin + length);
    };
    const auto run_at = [&](const gl::Program& program, std::uint32_t arguments) {
        program.dispatch_indirect(rounds_.id(), arguments * sizeof(Dispatch));
        gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command);
    };
    // The first round is not asked for.
    const auto run_of_round = [&](const gl::Program& program, bool is_of_islands) {
        set(program, 0, first_iteration);
        if (round > 0) return run_at(program, begin + (is_of_islands ? 0 : 1));
        run(program, is_of_islands ? buffers_.object_count : buffers_.chunk_count);
    };
    if (rows_) run_of_round(rows_->linearise, true);
    run_of_round(round == 0 ? programs_.begin : rows_->begin_again, false);
    run_of_round(programs_.start, true);
    set(programs_.first_direction, 0, first_iteration);
    run_at(programs_.first_direction, first_iteration);
    for (std::uint32_t k = 0; k < count; ++k) {
        for (const gl::Program* program : {&programs_.product, &programs_.residual, &programs_.direction}) {
            set(*program, k % 2, first_iteration + k + 1);
            run_at(*program, first_iteration + k);
        }
    }
    if (!rows_) return;
    set(rows_->sum_step, 0, first_iteration);
    run_at(rows_->sum_step, first_iteration);
    run_of_round(rows_->line_search, true);
}

void StepSystem::begin_bodies(const NodeBuffers& at) const {
    for (const gl::Program* program : {&programs_.sums, &programs_.bodies}) bind_positions(*program, at);
    run(programs_.sums, buffers_.chunk_count);
    run(programs_.bodies, (buffers_.object_count + 63) / 64);
}

void StepSystem::solve_large_islands() {
    gl::barrier(gl::Barrier::buffer_update);
    rounds_.fill(0);
    // Islands without rows go on in the second round.
    const std::uint32_t rounds = rows_ ? contact_tuning::kMostLinearisations : 1;
    for (std::uint32_t round = 0; round < rounds; ++round) run_round(round);
    run(programs_.finish, buffers_.chunk_count);
}

void StepSystem::solve(const NodeBuffers& at) {
    for (const gl::Program* program : programs_.all()) bind_positions(*program, at);
    programs_.direction.set("most_iterations", static_cast<std::uint32_t>(iterations_));
    if (rows_) {
        for (const gl::Program* program : rows_->all()) bind_positions(*program, at);
        run(rows_->begin, buffers_.object_count);
        if (buffers_.has_large_islands()) run(rows_->base, buffers_.chunk_count);
        run_newton(contact_tuning::kHardly);
    }
    if (small_islands_) {
        bind_positions(*small_islands_, at);
        small_islands_->set("most_iterations", static_cast<std::uint32_t>(iterations_));
        run(*small_islands_, buffers_.object_count);
    }
    if (buffers_.has_large_islands()) solve_large_islands();
    if (rows_) run_newton(contact_tuning::kHardly);
}

std::vector<SolveState> StepSystem::states() const {
    const gl::Buffer<SolveState>& both = buffers_.states.values;
    std::vector<SolveState> states(both.size());
    gl::barrier(gl::Barrier::buffer_update);
    both.download(states);
    states.resize(buffers_.object_count);  // after an even number of iterations
    return states;
}

std::vector<glm::vec4> StepSystem::slips() const {
    if (row_count_ == 0) return {};
    std::vector<glm::vec4> slips(buffers_.slips.values.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffers_.slips.values.download(slips);
    slips.resize(row_count_);
    return slips;
}

}  // namespace gelatin::gpu
