#include "gpu/implicit/step_system.h"

#include <cassert>
#include <numeric>

#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

void bind_positions(const gl::Program& program, const NodeBuffers& at) {
    program.bind_declared("positions", at.position_texels);
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
    : begin(gl::Program::compute("sim/implicit/begin_rows.comp")),
      base(gl::Program::compute("sim/implicit/find_base.comp")),
      newton(gl::Program::compute("sim/implicit/rigid_newton.comp")),
      move(gl::Program::compute("sim/implicit/move_bodies.comp")),
      linearise(gl::Program::compute("sim/implicit/linearise_rows.comp")),
      begin_again(gl::Program::compute("sim/implicit/solve_begin.comp", {"ROWS"})),
      sum_step(gl::Program::compute("sim/implicit/sum_step.comp")),
      line_search(gl::Program::compute("sim/implicit/line_search.comp")) {}

std::vector<const gl::Program*> StepSystem::RowPrograms::all() const {
    return {&begin, &base, &newton, &move, &linearise, &begin_again, &sum_step, &line_search};
}

StepSystem::StepSystem(const Model& model, const RowCapacity& capacity, std::uint32_t small_chunks)
    : elastic(model),
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

void StepSystem::run(const gl::Program& program, std::uint32_t groups) const {
    program.dispatch_groups(groups);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

// With what is in base_sums.
void StepSystem::run_newton(float tolerance) const {
    rows_->newton.set("tolerance", tolerance);
    run(rows_->newton, buffers_.object_count);
    if (buffers_.has_large_islands()) run(rows_->move, buffers_.chunk_count);
}

// A linearisation and its conjugate gradients. @param turn of states @return the next
std::uint32_t StepSystem::run_round(bool is_first, int count, std::uint32_t turn) const {
    const std::uint32_t chunks = buffers_.chunk_count, islands = buffers_.object_count;
    const auto run_at_turn = [&](const gl::Program& program, std::uint32_t groups) {
        program.set("turn", turn);
        program.set("is_first", is_first ? 1u : 0u);
        run(program, groups);
    };
    if (rows_) run_at_turn(rows_->linearise, islands);
    run_at_turn(is_first ? programs_.begin : rows_->begin_again, chunks);
    run_at_turn(programs_.start, islands);
    run_at_turn(programs_.first_direction, chunks);
    for (int k = 0; k < count; ++k) {
        for (const gl::Program* program : {&programs_.product, &programs_.residual, &programs_.direction})
            run_at_turn(*program, chunks);
        turn = 1 - turn;
    }
    if (rows_) {
        run_at_turn(rows_->sum_step, chunks);
        run_at_turn(rows_->line_search, islands);
    }
    return turn;
}

void StepSystem::begin_bodies(const NodeBuffers& at) const {
    for (const gl::Program* program : {&programs_.sums, &programs_.bodies}) bind_positions(*program, at);
    run(programs_.sums, buffers_.chunk_count);
    programs_.bodies.dispatch(buffers_.object_count);
    gl::barrier(gl::Barrier::texture_fetch);
}

void StepSystem::solve_large_islands() const {
    // Islands without rows go on in the second round.
    std::uint32_t turn = 0;
    const std::uint32_t rounds = rows_ ? contact_tuning::kMostLinearisations : 1;
    for (std::uint32_t round = 0; round < rounds; ++round)
        turn = run_round(round == 0, rows_ ? iterations : 2 * iterations, turn);
    run(programs_.finish, buffers_.chunk_count);
}

void StepSystem::solve(const NodeBuffers& at) const {
    for (const gl::Program* program : programs_.all()) bind_positions(*program, at);
    programs_.direction.set("most_iterations", static_cast<std::uint32_t>(iterations));
    if (rows_) {
        for (const gl::Program* program : rows_->all()) bind_positions(*program, at);
        run(rows_->begin, buffers_.object_count);
        if (buffers_.has_large_islands()) run(rows_->base, buffers_.chunk_count);
        run_newton(contact_tuning::kBalance);
    }
    if (small_islands_) {
        bind_positions(*small_islands_, at);
        small_islands_->set("most_iterations", static_cast<std::uint32_t>(iterations));
        run(*small_islands_, buffers_.object_count);
    }
    if (buffers_.has_large_islands()) solve_large_islands();
    if (rows_) run_newton(contact_tuning::kBalance);
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
