#include "gpu/descent/coarse_correction.h"

#include <bit>
#include <utility>

namespace gelatin::gpu {
namespace {

std::vector<glm::uvec2> packed(const std::vector<CoarseBasis::Part>& parts) {
    std::vector<glm::uvec2> result;
    for (const CoarseBasis::Part& part : parts)
        result.emplace_back(part.index, std::bit_cast<std::uint32_t>(part.weight));
    return result;
}

std::vector<ClusterRest> rests_of(const CoarseBasis& basis) {
    std::vector<ClusterRest> rests;
    for (std::uint32_t o = 0; o < basis.objects.size(); ++o) {
        const Range& clusters = basis.objects[o];
        for (std::uint32_t k = clusters.first; k < clusters.end(); ++k) {
            rests.push_back({glm::vec4(glm::vec3(basis.middles[k]), 0.0f), o, basis.core_starts[k],
                             basis.core_starts[k + 1], 6 * (k - clusters.first)});
        }
    }
    return rests;
}

std::vector<CoarseBody> bodies_of(const CoarseBasis& basis) {
    std::vector<CoarseBody> bodies;
    std::uint32_t matrix = 0;
    for (std::size_t o = 0; o < basis.objects.size(); ++o) {
        const Range& clusters = basis.objects[o];
        bodies.push_back({clusters.first, clusters.count, matrix, static_cast<float>(basis.lengths[o])});
        matrix += 36 * clusters.count * clusters.count;
    }
    return bodies;
}

std::vector<float> inverses_of(const std::vector<CoarseMatrices>& matrices, double step) {
    std::vector<float> result;
    for (const CoarseMatrices& m : matrices) {
        if (m.inertia.size() == 0) continue;
        const Eigen::MatrixXf inverse = m.inverse(step).cast<float>();
        result.insert(result.end(), inverse.data(), inverse.data() + inverse.size());
    }
    return result;
}

}  // namespace

CoarseCorrection::CoarseCorrection(const Model& model, const CoarseBasis& basis)
    : rotate_program_(gl::Program::compute("sim/descent/rotate_clusters.comp")),
      load_program_(gl::Program::compute("sim/descent/load_clusters.comp")),
      move_program_(gl::Program::compute("sim/descent/move_clusters.comp")),
      displacement_program_(gl::Program::compute("sim/descent/find_displacements.comp")),
      sum_program_(gl::Program::compute("sim/descent/apply_displacements.comp", {"SUMS"})),
      factor_program_(gl::Program::compute("sim/descent/apply_displacements.comp", {"OBJECTS"})),
      apply_program_(gl::Program::compute("sim/descent/apply_displacements.comp")),
      node_count_(model.node_count()),
      cluster_count_(basis.cluster_count()),
      object_count_(static_cast<std::uint32_t>(model.objects.size())) {
    matrices_ = make_coarse_matrices(model, basis);
    rests_ = gl::Buffer<ClusterRest>(rests_of(basis));
    clusters_ = gl::Buffer<Cluster>(cluster_count_);
    bodies_ = gl::Buffer<CoarseBody>(bodies_of(basis));
    core_nodes_ = {basis.core_nodes, gl::TexelFormat::r32ui};
    cluster_starts_ = {basis.cluster_starts, gl::TexelFormat::r32ui};
    node_starts_ = {basis.node_starts, gl::TexelFormat::r32ui};
    cluster_parts_ = {packed(basis.cluster_parts), gl::TexelFormat::rg32ui};
    node_parts_ = {packed(basis.node_parts), gl::TexelFormat::rg32ui};
    rest_positions_ = {model.positions, gl::TexelFormat::rgba32f};
    for (gl::Buffer<glm::vec4>* by_node : {&forces_, &forces_ahead_, &displacements_, &ahead_})
        *by_node = gl::Buffer<glm::vec4>(node_count_);
    loads_ = gl::Buffer<float>(std::size_t{6} * cluster_count_);
    factors_ = gl::Buffer<float>(object_count_);
    ahead_texels_ = {ahead_, gl::TexelFormat::rgba32f};
    bind_buffers();
}

void CoarseCorrection::bind_buffers() const {
    rotate_program_.bind("core_nodes", core_nodes_);
    rotate_program_.bind("rest_positions", rest_positions_);
    for (const gl::Program* program : {&rotate_program_, &move_program_}) program->bind("Rests", rests_);
    for (const gl::Program* program :
         {&rotate_program_, &load_program_, &move_program_, &displacement_program_})
        program->bind("Clusters", clusters_);
    load_program_.bind("cluster_starts", cluster_starts_);
    load_program_.bind("cluster_parts", cluster_parts_);
    load_program_.bind("Forces", forces_);
    for (const gl::Program* program : {&load_program_, &move_program_}) program->bind("Loads", loads_);
    for (const gl::Program* program : {&move_program_, &factor_program_}) program->bind("Bodies", bodies_);
    displacement_program_.bind("node_starts", node_starts_);
    displacement_program_.bind("node_parts", node_parts_);
    displacement_program_.bind("Ahead", ahead_);
    for (const gl::Program* program :
         {&displacement_program_, &sum_program_, &factor_program_, &apply_program_})
        program->bind("Displacements", displacements_);
    sum_program_.bind("ForcesHere", forces_);
    sum_program_.bind("ForcesAhead", forces_ahead_);
    for (const gl::Program* program : {&factor_program_, &apply_program_}) program->bind("Factors", factors_);
}

void CoarseCorrection::begin(const NodeBuffers& nodes, double step) {
    if (step != step_) {
        inverses_ = gl::Buffer<float>(inverses_of(matrices_, step));
        move_program_.bind("Inverses", inverses_);
        step_ = step;
    }
    for (const gl::Program* program : {&rotate_program_, &load_program_, &displacement_program_})
        program->bind("positions", nodes.position_texels);
    apply_program_.bind("Positions", nodes.positions);
    rotate_program_.set("cluster_count", cluster_count_);
    rotate_program_.dispatch_groups(cluster_count_);
}

void CoarseCorrection::bind_forces(const gl::Program& program, bool is_ahead) const {
    program.bind("Displacements", displacements_);
    program.bind("Forces", is_ahead ? forces_ahead_ : forces_);
}

void CoarseCorrection::find_displacements() const {
    load_program_.set("cluster_count", cluster_count_);
    load_program_.dispatch_groups(cluster_count_);
    gl::barrier(gl::Barrier::storage);

    move_program_.set("cluster_count", cluster_count_);
    move_program_.dispatch(cluster_count_);
    gl::barrier(gl::Barrier::storage);

    displacement_program_.set("node_count", node_count_);
    displacement_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

void CoarseCorrection::apply_displacements(const gl::Buffer<Chunk>& chunks,
                                           const gl::TexelTable<std::uint32_t>& chunk_starts) {
    const auto chunk_count = static_cast<std::uint32_t>(chunks.size());
    if (sums_.size() != chunks.size()) sums_ = gl::Buffer<glm::vec4>(chunks.size());
    for (const gl::Program* program : {&sum_program_, &factor_program_, &apply_program_}) {
        program->bind("Chunks", chunks);
        program->bind("Sums", sums_);
    }
    factor_program_.bind("chunk_starts", chunk_starts);
    sum_program_.set("element_count", chunk_count);
    sum_program_.dispatch_groups(chunks.size());
    gl::barrier(gl::Barrier::storage);

    factor_program_.set("element_count", object_count_);
    factor_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    apply_program_.set("element_count", chunk_count);
    apply_program_.dispatch_groups(chunks.size());
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
