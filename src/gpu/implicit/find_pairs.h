#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/collision/tree_buffers.h"
#include "gpu/implicit/convex_bodies.h"
#include "gpu/implicit/pair_buffers.h"
#include "gpu/implicit/step_state.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Lists all pairs of surface nodes and faces, and of surface edges, that may come nearer than their reach
/// in a try of a part, while nodes keep to their paths. Nothing is read back. CPU twin: cpu::FindPairs.
///
/// Five lists, each found from the one before, in an order that is always the same: slots, searches of leaves
/// of one tree in another, pairs of leaves, near pairs. Where one has no place, PairCounts says so, and the
/// next are empty; so they are where objects go so far beside each other that the part will be halved.
class FindPairs {
public:
    /// @param own whether bodies meet themselves
    /// @param state, pairs which it reads and writes, and which have to live as long
    FindPairs(const Model& model, const ContactSurface& surface, StepState& state, PairBuffers& pairs,
              bool own);

    /// After PairBuffers::grow.
    void grow();

    /// Finds the pairs of `state.predicted`, or in a try that goes on with the guard alone those of the paths
    /// that it has left. Ends with the barrier for whoever reads them.
    /// @param follows nodes go as predicted, bodies do not meet themselves: they are only put elsewhere
    void run(const ModelBuffers& model, bool follows = false) const;
    /// Whether bodies may meet themselves where nodes end, though pairs were left out, as they hardly
    /// deformed: sets PairCounts::has_lost; then the guard has to be asked for again, before which run()
    /// lists them, too.
    void find_lost(const NodeBuffers& ends) const;

private:
    struct Programs {
        explicit Programs(bool own);
        std::vector<const gl::Program*> all() const;
        gl::Program find_paths, box_leaves, box_nodes, count_slots, place_slots, list_slots, count_searches,
            list_searches, count_leaf_pairs, list_leaf_pairs, test_leaf_pairs, list_pairs, sum_counts,
            place_lists, end_slots;
        gl::Program find_rotations, find_lost_on_paths, find_lost;  // if bodies meet themselves
        bool own;
    };
    // Of elements of a list, where those of the next begin.
    struct Starts {
        explicit Starts(std::size_t capacity = 0);
        StepBuffer<std::uint32_t> starts, group_sums;
    };
    void bind_buffers() const;
    void bind_tables(const gl::Program& program) const;
    void bind_lists(const gl::Program& program) const;
    void find_boxes(const ModelBuffers& model) const;
    void run(const gl::Program& program, std::size_t groups) const;
    void run_counted(const gl::Program& program, std::uint32_t dispatch) const;
    void place(std::uint32_t stage) const;

    StepState& state_;
    PairBuffers& pairs_;
    std::uint32_t object_count_, body_count_;
    Programs programs_;
    TreeBuffers trees_;
    gl::TexelTable<glm::uvec2> object_nodes_, face_starts_;
    gl::TexelTable<std::uint32_t> leaf_starts_, surface_nodes_;
    gl::TexelTable<FaceEdge> face_edges_;
    ConvexBodies convex_;
    gl::Buffer<float> speeds_;  // by object [reaches]
    Starts of_slots_, of_searches_, of_leaf_pairs_;
    StepBuffer<glm::uvec2> searches_;    // leaf, slot
    StepBuffer<glm::uvec2> leaf_pairs_;  // search, leaf
    StepBuffer<glm::uvec2> hits_;        // bits, by leaf pair and lane
};

}  // namespace gelatin::gpu
