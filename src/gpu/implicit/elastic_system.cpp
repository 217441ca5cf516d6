#include "gpu/implicit/elastic_system.h"

#include <numeric>
#include <utility>
#include <vector>

#include "model/elasticity/element_edges.h"
#include "model/elasticity/node_tets.h"

namespace gelatin::gpu {
namespace {

gl::Defines element_defines(const Model& model) {
    gl::Defines defines;
    if (!model.volume_term.is_empty()) defines.emplace_back("VOLUME");
    if (!model.neo_hookean_tets.empty()) defines.emplace_back("NEO_HOOKEAN");
    return defines;
}

// Volume [m^3], modulus against being flat [Pa], stiffness of the volume term [Pa].
std::vector<glm::vec4> rests_of(const Model& model) {
    const std::vector<float>& stiffnesses = model.volume_term.tets;
    std::vector<glm::vec4> rests;
    for (std::size_t t = 0; t < model.tet_rests.size(); ++t) {
        const TetRest& rest = model.tet_rests[t];
        rests.emplace_back(rest.volume, rest.modulus, stiffnesses.empty() ? 0.0f : stiffnesses[t], 0.0f);
    }
    return rests;
}

std::vector<std::uint32_t> numbers_of_neo_hookean(const Model& model) {
    std::vector<std::uint32_t> numbers(model.tets.size(), packing::kNone);
    for (const ModelObject& object : model.bodies())
        for (std::uint32_t k = 0; k < object.neo_hookean_tets.count; ++k)
            numbers[object.tets.first + k] = object.neo_hookean_tets.first + k;
    return numbers;
}

std::vector<glm::vec4> gradients_of_neo_hookean(const Model& model) {
    std::vector<glm::vec4> gradients;
    for (const NeoHookeanTet& tet : model.neo_hookean_tets)
        for (const glm::vec4& gradient : {tet.gradient_1, tet.gradient_2, tet.gradient_3})
            gradients.push_back(gradient);
    return gradients;
}

}  // namespace

ElasticSystem::ElasticSystem(const Model& model)
    : displacements(model.positions.size()),
      tet_program_(gl::Program::compute("sim/implicit/linearise_tets.comp", element_defines(model))),
      edge_program_(gl::Program::compute("sim/implicit/linearise_edges.comp", element_defines(model))),
      node_program_(gl::Program::compute("sim/implicit/linearise_nodes.comp")),
      product_program_(gl::Program::compute("sim/implicit/multiply.comp")),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      tets_(model.tets, gl::TexelFormat::rgba32ui),
      tet_rests_(rests_of(model), gl::TexelFormat::rgba32f),
      neo_hookean_tets_(gradients_of_neo_hookean(model), gl::TexelFormat::rgba32f),
      neo_hookean_numbers_(numbers_of_neo_hookean(model), gl::TexelFormat::r32ui),
      tet_rows_(4 * model.tets.size()),
      forces_(model.positions.size()),
      blocks_(model.positions.size()) {
    if (!model.volume_term.is_empty()) stresses_.emplace(model);
    std::vector<std::uint32_t> nodes(node_count_);
    std::iota(nodes.begin(), nodes.end(), 0u);
    const NodeTetSlices node_tets = pack_node_tets(nodes, make_node_tets(node_count_, model.tets));
    node_tets_ = {node_tets.entries, gl::TexelFormat::r32ui};
    node_tet_starts_ = {node_tets.slice_starts, gl::TexelFormat::r32ui};
    const ElementEdges edges = make_element_edges(model);
    edge_count_ = static_cast<std::uint32_t>(edges.edges.size());
    edges_ = gl::Buffer<ElementEdge>(edges.edges);
    edge_tets_ = {edges.tets, gl::TexelFormat::r32ui};
    edge_tet_starts_ = {edges.tet_starts, gl::TexelFormat::r32ui};
    half_edges_ = {edges.halves, gl::TexelFormat::rg32ui};
    half_edge_starts_ = {edges.half_starts, gl::TexelFormat::r32ui};
    matrices_ = gl::Buffer<EdgeMatrix>(edges.edges.size());
    tet_row_texels_ = {tet_rows_, gl::TexelFormat::rgba32f};
    matrix_texels_ = {matrices_, gl::TexelFormat::rgba32f};
    block_texels_ = {blocks_, gl::TexelFormat::rgba32f};
    displacement_texels_ = {displacements, gl::TexelFormat::rgba32f};
    bind_buffers();
}

// What never changes.
void ElasticSystem::bind_buffers() const {
    for (const gl::Program* program : {&tet_program_, &edge_program_}) bind_tets(*program);
    tet_program_.bind("TetRows", tet_rows_);
    tet_program_.set("tet_count", tet_count_);
    edge_program_.bind("Edges", edges_);
    edge_program_.bind("edge_tets", edge_tets_);
    edge_program_.bind("edge_tet_starts", edge_tet_starts_);
    edge_program_.bind("tet_rows", tet_row_texels_);
    edge_program_.bind("Matrices", matrices_);
    edge_program_.set("edge_count", edge_count_);
    node_program_.bind("node_tets", node_tets_);
    node_program_.bind("node_tet_starts", node_tet_starts_);
    node_program_.bind("tet_rows", tet_row_texels_);
    node_program_.bind("Forces", forces_);
    node_program_.bind("Blocks", blocks_);
    node_program_.set("node_count", node_count_);
    bind_edges(node_program_);
    product_program_.set("node_count", node_count_);
    bind_product(product_program_, displacement_texels_);
}

void ElasticSystem::bind_tets(const gl::Program& program) const {
    program.bind("tets", tets_);
    program.bind("tet_rests", tet_rests_);
    program.bind("neo_hookean_numbers", neo_hookean_numbers_);
    program.bind("neo_hookean_tets", neo_hookean_tets_);
    if (stresses_) stresses_->bind(program);
}

void ElasticSystem::bind_edges(const gl::Program& program) const {
    program.bind("half_edges", half_edges_);
    program.bind("half_edge_starts", half_edge_starts_);
    program.bind("matrices", matrix_texels_);
}

void ElasticSystem::bind_product(const gl::Program& program, const gl::BufferTexture& d) const {
    bind_edges(program);
    program.bind("displacements", d);
}

void ElasticSystem::linearise(const ModelBuffers& model, const NodeBuffers& at,
                              const gl::BufferTexture& damping_times, Tries& tries) const {
    if (stresses_) stresses_->run(model, at);
    for (const gl::Program* program : {&tet_program_, &edge_program_, &node_program_}) tries.bind(*program);
    for (const gl::Program* program : {&tet_program_, &edge_program_})
        program->bind("positions", at.position_texels);
    edge_program_.bind("damping_times", damping_times);
    for (const auto& [program, count] :
         {std::pair(&tet_program_, tet_count_), {&edge_program_, edge_count_}, {&node_program_, node_count_}})
        tries.run(Tries::Where::makes_part, *program, (count + 63) / 64);
}

void ElasticSystem::multiply(const gl::Buffer<glm::vec4>& products) const {
    product_program_.bind("Products", products);
    product_program_.dispatch(node_count_);
}

}  // namespace gelatin::gpu
