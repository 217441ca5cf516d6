#include "cpu/implicit/step_system.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "cpu/implicit/island_solve.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

SolveCounts& SolveCounts::operator+=(const SolveCounts& more) {
    iterations += more.iterations;
    multiplied_nodes += more.multiplied_nodes;
    return *this;
}

template <class Real>
StepSystem<Real>::StepSystem(std::shared_ptr<const Model> model)
    : elastic(model),
      rigid(model),
      inertia(model->node_count()),
      loads(model->node_count()),
      displacements(model->node_count()),
      enough(model->objects.size(), 0.0),
      model_(std::move(model)),
      asleep_(model_->body_count()),
      row_starts_(model_->node_count() + 1),
      glued_(model_),
      inverse_blocks_(model_->node_count()) {
    for (Field* field : {&base_, &residual_, &step_, &product_, &z_}) field->resize(model_->node_count());
}

template <class Real>
void StepSystem<Real>::leave_out(std::span<const std::uint8_t> asleep) {
    elastic.leave_out(asleep);
    asleep_.assign(asleep.begin(), asleep.end());
    // Only nodes of bodies that are awake have a step and a direction.
    std::fill(step_.begin(), step_.end(), Vec3<Real>(0));
    std::fill(elastic.displacements.begin(), elastic.displacements.end(), Vec4<Real>(0));
}

template <class Real>
std::vector<typename StepSystem<Real>::Island> StepSystem<Real>::sort_by_island(
    std::span<const std::uint32_t> islands_of_bodies) {
    const auto bodies = static_cast<std::uint32_t>(model_->body_count());
    std::vector<Island> islands;
    std::vector<std::uint32_t> numbers(bodies);
    for (std::uint32_t o = 0; o < bodies; ++o) {
        const std::uint32_t least = islands_of_bodies[o];
        if (least == o) {
            numbers[o] = static_cast<std::uint32_t>(islands.size());
            islands.emplace_back();
        }
        numbers[o] = numbers[least];
        if (asleep_[o] == 0) islands[numbers[o]].bodies.push_back(o);
    }
    using Key = std::array<std::uint32_t, 4>;  // island, object, other, row
    std::vector<Key> keys;
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const auto& [object, other] = std::pair(rows[r].object, rows[r].other);
        keys.push_back({numbers[other < bodies ? other : object], object, other, r});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<ContactRow<Real>> sorted(rows.size());
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const auto& [number, object, other, row] = keys[r];
        sorted[r] = rows[row];
        Island& island = islands[number];
        if (island.rows.count == 0) island.rows.first = r;
        if (island.pairs.empty() || island.pairs.back().object != object ||
            island.pairs.back().other != other)
            island.pairs.push_back({object, other, {island.rows.count, 0}});
        ++island.rows.count;
        ++island.pairs.back().rows.count;
    }
    rows.swap(sorted);
    return islands;
}

template <class Real>
void StepSystem<Real>::index_rows() {
    std::fill(row_starts_.begin(), row_starts_.end(), 0u);
    for (const ContactRow<Real>& row : rows)
        for (std::uint32_t k = 0; k < row.count; ++k) ++row_starts_[row.nodes[k] + 1];
    for (std::size_t n = 1; n < row_starts_.size(); ++n) row_starts_[n] += row_starts_[n - 1];
    row_entries_.resize(row_starts_.back());
    std::vector<std::uint32_t> next(row_starts_.begin(), row_starts_.end() - 1);
    for (std::uint32_t r = 0; r < rows.size(); ++r)
        for (std::uint32_t k = 0; k < rows[r].count; ++k) row_entries_[next[rows[r].nodes[k]]++] = {r, k};
    glued_.find(rows, inertia);
    tangents_.resize(rows.size());
    for (Field* values : {&row_forces_, &slips_}) values->resize(rows.size());
}

template <class Real>
void StepSystem<Real>::find_slips() {
    for_each_index(rows.size(), [&](std::size_t r) { slips_[r] = slip<Real>(rows[r], displacements); });
}

template <class Real>
std::vector<Vec3<Real>> StepSystem<Real>::elastic_forces() {
    Field forces(displacements.size(), Vec3<Real>(0));
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        if (asleep_[o] != 0) return;
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            elastic.displacements[n] = Vec4<Real>(displacements[n], 0);
        elastic.begin_product(model_->objects[o]);
        elastic.multiply(nodes, forces);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) forces[n] = elastic.forces()[n] - forces[n];
    });
    return forces;
}

template <class Real>
void StepSystem<Real>::solve(std::span<const std::uint32_t> islands_of_bodies) {
    const std::vector<Island> islands = sort_by_island(islands_of_bodies);
    index_rows();
    std::vector<SolveCounts> of_islands(islands.size());
    for_each_index(0, islands.size(), 1, [&](std::size_t i) {
        const Island& island = islands[i];
        if (!island.bodies.empty())
            of_islands[i] = IslandSolve<Real>(*this, island.bodies, island.rows, island.pairs).run();
    });
    counts = std::accumulate(of_islands.begin(), of_islands.end(), SolveCounts(),
                             [](SolveCounts sum, const SolveCounts& more) { return sum += more; });
}

template class StepSystem<float>;
template class StepSystem<double>;

}  // namespace gelatin::cpu
