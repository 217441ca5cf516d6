#pragma once

#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "gpu/proximity/proximity_buffers.h"

namespace gelatin::gpu {

/// Proximities: nodes and faces, pairs of edges. The leaves of the face trees walk through the trees of the
/// objects that they may be near (shaders/sim/proximity/list_near_objects.comp, walk_near_objects.comp).
/// Their nodes and edges are tested against the leaves found (list_proximity_tasks.comp,
/// test_proximities.comp). The results are counted, their offsets summed, and written in order
/// (sum_proximities.comp, write_proximities.comp). Nothing is read back. CPU twin: cpu::FindProximities.
class FindProximities {
public:
    /// @param radius [m] @param own also within one object
    FindProximities(double radius, bool own);
    /// @pre the boxes, with the margin for the radius, and pairs of objects are those of `nodes`
    /// Ends with the barrier that the next stage needs.
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const ProximityBuffers& buffers,
             const NodeBuffers& nodes) const;

private:
    void find_near_leaves(const CollisionBuffers& collision, const ProximityBuffers& buffers) const;
    void test(const CollisionBuffers& collision, const ProximityBuffers& buffers) const;
    void sum_up(const ProximityBuffers& buffers) const;
    void write(const CollisionBuffers& collision, const ProximityBuffers& buffers) const;

    float squared_radius_;  // [m^2]
    gl::Program begin_program_, object_program_, count_program_, task_program_, list_program_;
    gl::Program test_nodes_program_, test_edges_program_;
    gl::Program sum_program_, sum_groups_program_, start_program_;
    gl::Program write_nodes_program_, write_edges_program_;
};

}  // namespace gelatin::gpu
