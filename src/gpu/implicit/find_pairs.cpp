#include "gpu/implicit/find_pairs.h"

#include <algorithm>
#include <string>
#include <utility>

#include "gpu/collision/update_boxes.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

namespace stages = pair_stages;

gl::Program implicit_program(const char* file, const gl::Defines& defines = {}) {
    return gl::Program::compute(std::string("sim/implicit/") + file, defines);
}

std::vector<glm::uvec2> nodes_of_objects(const Model& model) {
    std::vector<glm::uvec2> nodes;
    for (const ModelObject& object : model.objects)
        nodes.emplace_back(object.nodes.first, object.nodes.end());
    return nodes;
}

// Of each object in the list of leaves, and the end.
std::vector<std::uint32_t> leaf_starts_of(const BoxTree& trees) {
    const std::vector<std::uint32_t>& leaves = trees.levels[0];
    std::vector<std::uint32_t> starts;
    for (const std::uint32_t root : trees.roots)
        starts.push_back(static_cast<std::uint32_t>(std::lower_bound(leaves.begin(), leaves.end(), root) -
                                                    leaves.begin()));
    starts.push_back(static_cast<std::uint32_t>(leaves.size()));
    return starts;
}

}  // namespace

FindPairs::Programs::Programs(bool finds_own)
    : find_paths(implicit_program("find_paths.comp")),
      box_leaves(implicit_program("box_paths.comp", {"LEAVES"})),
      box_nodes(implicit_program("box_paths.comp")),
      count_slots(implicit_program("find_slots.comp")),
      place_slots(implicit_program("place_slots.comp")),
      list_slots(implicit_program("find_slots.comp", {"LIST"})),
      count_searches(implicit_program("find_searches.comp")),
      list_searches(implicit_program("find_searches.comp", {"LIST"})),
      count_leaf_pairs(implicit_program("find_leaf_pairs.comp")),
      list_leaf_pairs(implicit_program("find_leaf_pairs.comp", {"LIST"})),
      test_leaf_pairs(implicit_program("test_leaf_pairs.comp")),
      list_pairs(implicit_program("test_leaf_pairs.comp", {"LIST"})),
      sum_counts(implicit_program("sum_counts.comp")),
      place_lists(implicit_program("place_lists.comp")),
      end_slots(implicit_program("end_slots.comp")),
      own(finds_own) {
    if (!own) return;
    find_rotations = implicit_program("find_rotations.comp");
    find_lost_on_paths = implicit_program("find_lost.comp");
    find_lost = implicit_program("find_lost.comp", {"ENDS"});
}

std::vector<const gl::Program*> FindPairs::Programs::all() const {
    std::vector<const gl::Program*> all = {
        &find_paths,      &box_leaves,     &box_nodes,     &count_slots,      &place_slots,
        &list_slots,      &count_searches, &list_searches, &count_leaf_pairs, &list_leaf_pairs,
        &test_leaf_pairs, &list_pairs,     &sum_counts,    &place_lists,      &end_slots};
    if (own) all.insert(all.end(), {&find_rotations, &find_lost_on_paths, &find_lost});
    return all;
}

FindPairs::Starts::Starts(std::size_t capacity)
    : starts(capacity + 1, gl::TexelFormat::r32ui),
      group_sums(capacity / stages::kCountsAGroup + 1, gl::TexelFormat::r32ui) {}

FindPairs::FindPairs(const Model& model, const ContactSurface& surface, StepState& state, PairBuffers& pairs,
                     bool own)
    : state_(state),
      pairs_(pairs),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      body_count_(static_cast<std::uint32_t>(model.body_count())),
      programs_(own),
      trees_(model.face_trees),
      object_nodes_(nodes_of_objects(model), gl::TexelFormat::rg32ui),
      face_starts_(model.surface_parts.face_starts, gl::TexelFormat::rg32ui),
      leaf_starts_(leaf_starts_of(model.face_trees), gl::TexelFormat::r32ui),
      surface_nodes_(model.surface_parts.nodes, gl::TexelFormat::r32ui),
      face_edges_(model.surface_parts.edges, gl::TexelFormat::rgba32ui),
      convex_(model, surface, own),
      speeds_(model.objects.size()) {
    grow();
}

void FindPairs::grow() {
    const PairCapacity& most = pairs_.capacity;
    of_slots_ = Starts(most.slots);
    of_searches_ = Starts(most.searches);
    of_leaf_pairs_ = Starts(most.leaf_pairs);
    searches_ = {most.searches, gl::TexelFormat::rg32ui};
    leaf_pairs_ = {most.leaf_pairs, gl::TexelFormat::rg32ui};
    hits_ = {stages::kLanesALeafPair * most.leaf_pairs, gl::TexelFormat::rg32ui};
    bind_buffers();
}

// But for what differs from run to run.
void FindPairs::bind_buffers() const {
    for (const gl::Program* program : programs_.all()) {
        state_.bind(*program);
        pairs_.bind(*program);
        convex_.bind(*program);
        bind_tables(*program);
        bind_lists(*program);
    }
    for (const auto& [program, starts] : {std::pair(&programs_.count_searches, &of_slots_),
                                          {&programs_.count_leaf_pairs, &of_searches_},
                                          {&programs_.test_leaf_pairs, &of_leaf_pairs_}})
        program->bind("Starts", starts->starts.values);
}

void FindPairs::bind_tables(const gl::Program& program) const {
    program.set("finds_own", programs_.own ? 1u : 0u);
    program.bind_declared("positions", state_.from.position_texels);
    program.bind_declared("velocities", state_.from.velocity_texels);
    program.bind_declared("tree_nodes", trees_.node_texels);
    program.bind_declared("tree_boxes", trees_.box_texels);
    program.bind_declared("TreeBoxes", trees_.boxes);
    program.bind_declared("roots", trees_.root_texels);
    program.bind_declared("LevelNodes", trees_.level_nodes);
    program.bind_declared("object_nodes", object_nodes_);
    program.bind_declared("face_starts", face_starts_);
    program.bind_declared("leaf_starts", leaf_starts_);
    program.bind_declared("surface_nodes", surface_nodes_);
    program.bind_declared("face_edges", face_edges_);
}

void FindPairs::bind_lists(const gl::Program& program) const {
    program.bind_declared("Speeds", speeds_);
    program.bind_declared("search_starts", of_slots_.starts.texels);
    program.bind_declared("search_sums", of_slots_.group_sums.texels);
    program.bind_declared("walk_starts", of_searches_.starts.texels);
    program.bind_declared("walk_sums", of_searches_.group_sums.texels);
    program.bind_declared("hit_starts", of_leaf_pairs_.starts.texels);
    program.bind_declared("hit_sums", of_leaf_pairs_.group_sums.texels);
    searches_.bind(program, "Searches", "searches");
    leaf_pairs_.bind(program, "LeafPairs", "leaf_pairs");
    hits_.bind(program, "Hits", "hits");
}

void FindPairs::run(const gl::Program& program, std::size_t groups) const {
    state_.tries.run(Tries::Where::goes_on, program, groups);
}

void FindPairs::run_counted(const gl::Program& program, std::uint32_t dispatch) const {
    state_.tries.run_counted(program, dispatch);
}

// Of the next list.
void FindPairs::place(std::uint32_t stage) const {
    const Starts& list = stage == stages::kOfSlots      ? of_slots_
                         : stage == stages::kOfSearches ? of_searches_
                                                        : of_leaf_pairs_;
    for (const gl::Program* program : {&programs_.sum_counts, &programs_.place_lists}) {
        program->set("stage", stage);
        program->bind("GroupSums", list.group_sums.values);
    }
    programs_.sum_counts.bind("Starts", list.starts.values);
    run_counted(programs_.sum_counts, 2 * stage + 1);
    run(programs_.place_lists, 1);
}

void FindPairs::find_boxes(const ModelBuffers& model) const {
    programs_.box_leaves.bind("faces", model.face_texels);
    for (std::size_t level = 0; level < trees_.level_count(); ++level)
        update_level(level == 0 ? programs_.box_leaves : programs_.box_nodes, trees_, level);
}

void FindPairs::run(const ModelBuffers& model, bool follows) const {
    const Programs& p = programs_;
    for (const gl::Program* program : {&p.find_paths, &p.count_slots, &p.list_slots})
        program->set("finds_own", !follows && p.own ? 1u : 0u);
    p.find_paths.set("follows", follows ? 1u : 0u);
    run(p.find_paths, object_count_);
    find_boxes(model);
    if (convex_.tet_count > 0) {
        state_.tries.run(Tries::Where::makes_part, p.find_rotations, body_count_);
        state_.tries.run(Tries::Where::makes_part, p.find_lost_on_paths, (convex_.tet_count + 63) / 64);
    }
    run(p.count_slots, object_count_);
    run(p.place_slots, 1);
    run(p.list_slots, object_count_);
    run_counted(p.count_searches, 2 * stages::kOfSlots);
    place(stages::kOfSlots);
    run_counted(p.list_searches, 2 * stages::kOfSlots);
    run_counted(p.count_leaf_pairs, 2 * stages::kOfSearches);
    place(stages::kOfSearches);
    run_counted(p.list_leaf_pairs, 2 * stages::kOfSearches);
    for (const gl::Program* program : {&p.test_leaf_pairs, &p.list_pairs})
        program->bind("faces", model.face_texels);
    run_counted(p.test_leaf_pairs, 2 * stages::kOfLeafPairs);
    place(stages::kOfLeafPairs);
    run_counted(p.list_pairs, stages::kWrites);
    run_counted(p.end_slots, stages::kSlotEnds);
}

void FindPairs::find_lost(const NodeBuffers& ends) const {
    if (convex_.tet_count == 0) return;
    programs_.find_lost.bind("ends", ends.position_texels);
    run(programs_.find_lost, (convex_.tet_count + 63) / 64);
}

}  // namespace gelatin::gpu
