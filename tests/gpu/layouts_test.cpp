// The driver lays out the shared structs as C++ does: asked through the program interface.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "gl/program.h"
#include "gl/shader_source.h"
#include "model/layouts.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

class LayoutsTest : public test::GlTest {
protected:
    // A shader that uses every field of struct `type`, so that none is optimised away.
    void check(const std::string& file, const std::string& type, std::size_t size,
               const std::vector<std::pair<std::string, std::size_t>>& fields) {
        std::string sum;
        for (const auto& [field, offset] : fields) sum += " + vec4(items[1]." + field + ")";
        const gl::ShaderOverride probe(
            "probe.comp", "#include \"layouts/" + file +
                              "\"\nlayout(local_size_x = 1) in;\nlayout(std430) buffer Items { " + type +
                              " items[]; };\nlayout(std430) buffer Out { vec4 result; };\n" +
                              "void main() { result = vec4(0.0)" + sum + "; }\n");
        const gl::Program program = gl::Program::compute("probe.comp");
        for (const auto& [field, offset] : fields) {
            EXPECT_EQ(query(program, "items[0]." + field, GL_OFFSET), static_cast<int>(offset))
                << type << "." << field;
            EXPECT_EQ(query(program, "items[0]." + field, GL_TOP_LEVEL_ARRAY_STRIDE), static_cast<int>(size))
                << type;
        }
    }

private:
    static int query(const gl::Program& program, const std::string& name, GLenum property) {
        unsigned index = glGetProgramResourceIndex(program.id(), GL_BUFFER_VARIABLE, name.c_str());
        if (index == GL_INVALID_INDEX)
            index = glGetProgramResourceIndex(program.id(), GL_BUFFER_VARIABLE, ("Items." + name).c_str());
        if (index == GL_INVALID_INDEX) return -1;
        int value = -1;
        glGetProgramResourceiv(program.id(), GL_BUFFER_VARIABLE, index, 1, &property, 1, nullptr, &value);
        return value;
    }
};

#define FIELD(Type, name) \
    { #name, offsetof(Type, name) }

TEST_F(LayoutsTest, Spring) {
    check("spring.glsl", "Spring", sizeof(Spring),
          {FIELD(Spring, i), FIELD(Spring, j), FIELD(Spring, rest_length), FIELD(Spring, stiffness)});
}
TEST_F(LayoutsTest, ShapeMatching) {
    check("shape_match.glsl", "RestMoment", sizeof(RestMoment),
          {FIELD(RestMoment, inverse_x), FIELD(RestMoment, inverse_y), FIELD(RestMoment, inverse_z)});
    check("shape_match.glsl", "ShapeSums", sizeof(ShapeSums),
          {FIELD(ShapeSums, column_x), FIELD(ShapeSums, column_y), FIELD(ShapeSums, column_z),
           FIELD(ShapeSums, momentum), FIELD(ShapeSums, spin)});
    check("shape_match.glsl", "ShapePlace", sizeof(ShapePlace),
          {FIELD(ShapePlace, center), FIELD(ShapePlace, rotation_x), FIELD(ShapePlace, rotation_y),
           FIELD(ShapePlace, rotation_z), FIELD(ShapePlace, velocity), FIELD(ShapePlace, spin)});
}
TEST_F(LayoutsTest, Alarm) {
    check("alarm.glsl", "Alarm", sizeof(Alarm),
          {FIELD(Alarm, step), FIELD(Alarm, node), FIELD(Alarm, count), FIELD(Alarm, speed)});
}
TEST_F(LayoutsTest, HalfSpringPair) {
    check("half_spring_pair.glsl", "HalfSpringPair", sizeof(HalfSpringPair),
          {FIELD(HalfSpringPair, node_0), FIELD(HalfSpringPair, rest_length_0), FIELD(HalfSpringPair, node_1),
           FIELD(HalfSpringPair, rest_length_1)});
}
TEST_F(LayoutsTest, ElementEdge) {
    check("element_edge.glsl", "ElementEdge", sizeof(ElementEdge),
          {FIELD(ElementEdge, lower), FIELD(ElementEdge, upper), FIELD(ElementEdge, rest_length),
           FIELD(ElementEdge, stiffness)});
    check("element_edge.glsl", "EdgeMatrix", sizeof(EdgeMatrix),
          {FIELD(EdgeMatrix, x), FIELD(EdgeMatrix, y), FIELD(EdgeMatrix, z)});
    check("element_edge.glsl", "NodeBlock", sizeof(NodeBlock),
          {FIELD(NodeBlock, diagonal), FIELD(NodeBlock, beside)});
}

TEST_F(LayoutsTest, StepSystem) {
    check("step_system.glsl", "StepBody", sizeof(StepBody),
          {FIELD(StepBody, center), FIELD(StepBody, inverse_diagonal), FIELD(StepBody, inverse_beside),
           FIELD(StepBody, diagonal), FIELD(StepBody, beside)});
    check("step_system.glsl", "StepBodySums", sizeof(StepBodySums),
          {FIELD(StepBodySums, arm), FIELD(StepBodySums, square), FIELD(StepBodySums, beside)});
    check("step_system.glsl", "ResidualSums", sizeof(ResidualSums),
          {FIELD(ResidualSums, force), FIELD(ResidualSums, moment)});
    check("step_system.glsl", "BodyMotion", sizeof(BodyMotion),
          {FIELD(BodyMotion, displacement), FIELD(BodyMotion, rotation)});
    check("step_system.glsl", "BodyInverse", sizeof(BodyInverse),
          {FIELD(BodyInverse, a_x), FIELD(BodyInverse, a_y), FIELD(BodyInverse, a_z), FIELD(BodyInverse, b_x),
           FIELD(BodyInverse, b_y), FIELD(BodyInverse, b_z), FIELD(BodyInverse, c_x), FIELD(BodyInverse, c_y),
           FIELD(BodyInverse, c_z)});
    check("step_system.glsl", "SolveState", sizeof(SolveState),
          {FIELD(SolveState, lack), FIELD(SolveState, is_done), FIELD(SolveState, is_stuck),
           FIELD(SolveState, iterations), FIELD(SolveState, made), FIELD(SolveState, enough),
           FIELD(SolveState, is_over), FIELD(SolveState, unused)});
}

TEST_F(LayoutsTest, StepEnds) {
    check("step_end.glsl", "BodyEnergy", sizeof(BodyEnergy),
          {FIELD(BodyEnergy, elastic), FIELD(BodyEnergy, contacts), FIELD(BodyEnergy, debt),
           FIELD(BodyEnergy, tied), FIELD(BodyEnergy, next_tied), FIELD(BodyEnergy, is_whole),
           FIELD(BodyEnergy, schemes)});
    check("step_end.glsl", "BodyChange", sizeof(BodyChange),
          {FIELD(BodyChange, center), FIELD(BodyChange, velocity), FIELD(BodyChange, spin),
           FIELD(BodyChange, bounce), FIELD(BodyChange, turn), FIELD(BodyChange, action),
           FIELD(BodyChange, unused_0), FIELD(BodyChange, unused_1), FIELD(BodyChange, unused_2)});
}

TEST_F(LayoutsTest, StepRows) {
    check("step_rows.glsl", "StepRow", sizeof(StepRow),
          {FIELD(StepRow, node_0), FIELD(StepRow, node_1), FIELD(StepRow, node_2), FIELD(StepRow, node_3),
           FIELD(StepRow, weights), FIELD(StepRow, normal), FIELD(StepRow, reach), FIELD(StepRow, stiffness),
           FIELD(StepRow, damping), FIELD(StepRow, friction), FIELD(StepRow, hold), FIELD(StepRow, object),
           FIELD(StepRow, other), FIELD(StepRow, plane), FIELD(StepRow, ease)});
    check("step_rows.glsl", "StepTangent", sizeof(StepTangent),
          {FIELD(StepTangent, constant), FIELD(StepTangent, diagonal), FIELD(StepTangent, beside)});
    check("step_rows.glsl", "StepPair", sizeof(StepPair),
          {FIELD(StepPair, object), FIELD(StepPair, other), FIELD(StepPair, first_chunk),
           FIELD(StepPair, chunk_end)});
    check(
        "step_rows.glsl", "StepIsland", sizeof(StepIsland),
        {FIELD(StepIsland, first_body), FIELD(StepIsland, body_end), FIELD(StepIsland, first_chunk),
         FIELD(StepIsland, chunk_end), FIELD(StepIsland, first_row), FIELD(StepIsland, row_end),
         FIELD(StepIsland, first_row_chunk), FIELD(StepIsland, row_chunk_end), FIELD(StepIsland, first_pair),
         FIELD(StepIsland, pair_end), FIELD(StepIsland, unused_0), FIELD(StepIsland, unused_1)});
}

TEST_F(LayoutsTest, StepState) {
    check("rest_state.glsl", "RestState", sizeof(RestState),
          {FIELD(RestState, time), FIELD(RestState, is_restless), FIELD(RestState, takes_places),
           FIELD(RestState, rests)});
    check("step_state.glsl", "StepClock", sizeof(StepClock),
          {FIELD(StepClock, size),      FIELD(StepClock, left),         FIELD(StepClock, longest),
           FIELD(StepClock, step),      FIELD(StepClock, last_step),    FIELD(StepClock, gained),
           FIELD(StepClock, is_over),   FIELD(StepClock, goes_on),      FIELD(StepClock, damps),
           FIELD(StepClock, has_past),  FIELD(StepClock, divides),      FIELD(StepClock, parts),
           FIELD(StepClock, tries),     FIELD(StepClock, made),         FIELD(StepClock, is_guarded),
           FIELD(StepClock, row_count), FIELD(StepClock, dropped_rows), FIELD(StepClock, begun),
           FIELD(StepClock, guards),    FIELD(StepClock, is_full)});
    check("step_state.glsl", "BodyPace", sizeof(BodyPace),
          {FIELD(BodyPace, pace), FIELD(BodyPace, is_struck), FIELD(BodyPace, held_count),
           FIELD(BodyPace, is_held), FIELD(BodyPace, past), FIELD(BodyPace, damping),
           FIELD(BodyPace, first_row), FIELD(BodyPace, row_end), FIELD(BodyPace, velocity),
           FIELD(BodyPace, force), FIELD(BodyPace, moment)});
    check("step_state.glsl", "PlaneMemory", sizeof(PlaneMemory),
          {FIELD(PlaneMemory, hold), FIELD(PlaneMemory, reach), FIELD(PlaneMemory, ease),
           FIELD(PlaneMemory, unused_0), FIELD(PlaneMemory, unused_1)});
    check("step_state.glsl", "StartSums", sizeof(StartSums),
          {FIELD(StartSums, momentum), FIELD(StartSums, carried), FIELD(StartSums, held_count),
           FIELD(StartSums, unused_0), FIELD(StartSums, unused_1), FIELD(StartSums, unused_2)});
    check("step_state.glsl", "ChunkRows", sizeof(ChunkRows),
          {FIELD(ChunkRows, count), FIELD(ChunkRows, first), FIELD(ChunkRows, nearest),
           FIELD(ChunkRows, deepest)});
    check("step_state.glsl", "BodyRows", sizeof(BodyRows),
          {FIELD(BodyRows, count), FIELD(BodyRows, unused), FIELD(BodyRows, nearest),
           FIELD(BodyRows, deepest)});
}

TEST_F(LayoutsTest, NearPairs) {
    check("near_pair.glsl", "NearPair", sizeof(NearPair),
          {FIELD(NearPair, node_0), FIELD(NearPair, node_1), FIELD(NearPair, node_2), FIELD(NearPair, node_3),
           FIELD(NearPair, weights), FIELD(NearPair, normal), FIELD(NearPair, first), FIELD(NearPair, second),
           FIELD(NearPair, is_edges), FIELD(NearPair, slot), FIELD(NearPair, object), FIELD(NearPair, other),
           FIELD(NearPair, reach), FIELD(NearPair, rounding)});
    check("near_pair.glsl", "PairSlot", sizeof(PairSlot),
          {FIELD(PairSlot, object), FIELD(PairSlot, other), FIELD(PairSlot, first_pair),
           FIELD(PairSlot, pair_end)});
    check("near_pair.glsl", "PairCounts", sizeof(PairCounts),
          {FIELD(PairCounts, slots), FIELD(PairCounts, searches), FIELD(PairCounts, leaf_pairs),
           FIELD(PairCounts, pairs), FIELD(PairCounts, fastest), FIELD(PairCounts, is_full),
           FIELD(PairCounts, has_lost), FIELD(PairCounts, unused)});
    check("near_pair.glsl", "RowMemory", sizeof(RowMemory),
          {FIELD(RowMemory, hold), FIELD(RowMemory, reach), FIELD(RowMemory, first), FIELD(RowMemory, second),
           FIELD(RowMemory, is_edges)});
}

TEST_F(LayoutsTest, PairRows) {
    check("pair_rows.glsl", "PairWeight", sizeof(PairWeight),
          {FIELD(PairWeight, stiffness), FIELD(PairWeight, reach), FIELD(PairWeight, known_reach),
           FIELD(PairWeight, there), FIELD(PairWeight, memory), FIELD(PairWeight, place),
           FIELD(PairWeight, unused_0), FIELD(PairWeight, unused_1)});
    check(
        "pair_rows.glsl", "SlotRows", sizeof(SlotRows),
        {FIELD(SlotRows, count), FIELD(SlotRows, twin), FIELD(SlotRows, nearest), FIELD(SlotRows, deepest)});
    check("pair_rows.glsl", "RowPlace", sizeof(RowPlace),
          {FIELD(RowPlace, first_row), FIELD(RowPlace, row_end), FIELD(RowPlace, first_chunk),
           FIELD(RowPlace, pair)});
    check("pair_rows.glsl", "BodyTouch", sizeof(BodyTouch),
          {FIELD(BodyTouch, rows), FIELD(BodyTouch, pairs), FIELD(BodyTouch, row_chunks),
           FIELD(BodyTouch, couplings), FIELD(BodyTouch, plane_rows), FIELD(BodyTouch, is_driven),
           FIELD(BodyTouch, deepest), FIELD(BodyTouch, unused)});
    check("pair_rows.glsl", "BodyPlace", sizeof(BodyPlace),
          {FIELD(BodyPlace, row), FIELD(BodyPlace, pair), FIELD(BodyPlace, row_chunk),
           FIELD(BodyPlace, node_chunk)});
}

TEST_F(LayoutsTest, PairGuard) {
    check("pair_guard.glsl", "GuardState", sizeof(GuardState),
          {FIELD(GuardState, is_changed), FIELD(GuardState, needs_again), FIELD(GuardState, clipped),
           FIELD(GuardState, is_given_up)});
    check("pair_guard.glsl", "NodeClips", sizeof(NodeClips),
          {FIELD(NodeClips, rounds), FIELD(NodeClips, first)});
}

TEST_F(LayoutsTest, Draw) {
    check("draw.glsl", "Draw", sizeof(Draw),
          {FIELD(Draw, count), FIELD(Draw, instance_count), FIELD(Draw, first), FIELD(Draw, first_instance)});
}
TEST_F(LayoutsTest, Face) {
    check("face.glsl", "Face", sizeof(Face),
          {FIELD(Face, a), FIELD(Face, b), FIELD(Face, c), FIELD(Face, object)});
}
TEST_F(LayoutsTest, SkinPoint) {
    check("skin_point.glsl", "SkinPoint", sizeof(SkinPoint),
          {FIELD(SkinPoint, a), FIELD(SkinPoint, b), FIELD(SkinPoint, c), FIELD(SkinPoint, d),
           FIELD(SkinPoint, weights)});
}
TEST_F(LayoutsTest, SurfaceVertex) {
    check("surface_vertex.glsl", "SurfaceVertex", sizeof(SurfaceVertex),
          {FIELD(SurfaceVertex, node), FIELD(SurfaceVertex, object), FIELD(SurfaceVertex, first_face),
           FIELD(SurfaceVertex, face_count)});
}
TEST_F(LayoutsTest, Collider) {
    check(
        "collider.glsl", "Collider", sizeof(Collider),
        {FIELD(Collider, center), FIELD(Collider, axis), FIELD(Collider, orientation), FIELD(Collider, kind),
         FIELD(Collider, friction), FIELD(Collider, restitution), FIELD(Collider, unused)});
}
TEST_F(LayoutsTest, Chunk) {
    check("chunk.glsl", "Chunk", sizeof(Chunk),
          {FIELD(Chunk, object), FIELD(Chunk, first), FIELD(Chunk, count), FIELD(Chunk, origin)});
}
TEST_F(LayoutsTest, NodeSums) {
    check("chunk.glsl", "NodeSums", sizeof(NodeSums),
          {FIELD(NodeSums, momentum_x), FIELD(NodeSums, momentum_y), FIELD(NodeSums, momentum_z),
           FIELD(NodeSums, kinetic_energy), FIELD(NodeSums, elastic_energy),
           FIELD(NodeSums, potential_energy), FIELD(NodeSums, deepest), FIELD(NodeSums, contacts)});
}

TEST_F(LayoutsTest, Drives) {
    check("handle.glsl", "HandleNode", sizeof(HandleNode),
          {FIELD(HandleNode, arm), FIELD(HandleNode, node), FIELD(HandleNode, handle),
           FIELD(HandleNode, animated)});
    check("handle.glsl", "NodeMotion", sizeof(NodeMotion),
          {FIELD(NodeMotion, start), FIELD(NodeMotion, velocity)});
    check("handle.glsl", "HandleMotion", sizeof(HandleMotion),
          {FIELD(HandleMotion, center), FIELD(HandleMotion, map_x), FIELD(HandleMotion, map_y),
           FIELD(HandleMotion, map_z), FIELD(HandleMotion, velocity), FIELD(HandleMotion, rate_x),
           FIELD(HandleMotion, rate_y), FIELD(HandleMotion, rate_z)});
    check("load.glsl", "NodeLoad", sizeof(NodeLoad),
          {FIELD(NodeLoad, force), FIELD(NodeLoad, load), FIELD(NodeLoad, b), FIELD(NodeLoad, c)});
    check("load.glsl", "LoadedNode", sizeof(LoadedNode),
          {FIELD(LoadedNode, node), FIELD(LoadedNode, first), FIELD(LoadedNode, end)});
}

TEST_F(LayoutsTest, Boxes) {
    check("box.glsl", "Box", sizeof(Box), {FIELD(Box, min), FIELD(Box, max)});
    check("box.glsl", "BoundingBox", sizeof(BoundingBox),
          {FIELD(BoundingBox, min), FIELD(BoundingBox, max), FIELD(BoundingBox, object),
           FIELD(BoundingBox, node_count), FIELD(BoundingBox, face_count), FIELD(BoundingBox, first_face)});
}
TEST_F(LayoutsTest, Pairs) {
    check("object_pair.glsl", "ObjectPair", sizeof(ObjectPair),
          {FIELD(ObjectPair, object), FIELD(ObjectPair, other), FIELD(ObjectPair, first_word),
           FIELD(ObjectPair, first_candidate), FIELD(ObjectPair, candidate_count),
           FIELD(ObjectPair, first_test)});
    check("object_pair.glsl", "PairRow", sizeof(PairRow),
          {FIELD(PairRow, first_pair), FIELD(PairRow, pair_count), FIELD(PairRow, first_word),
           FIELD(PairRow, first_entry)});
    check("object_pair.glsl", "FacePair", sizeof(FacePair),
          {FIELD(FacePair, pair), FIELD(FacePair, face), FIELD(FacePair, other_face)});
}
TEST_F(LayoutsTest, Contacts) {
    check("contact.glsl", "ContactPatch", sizeof(ContactPatch),
          {FIELD(ContactPatch, area_normal), FIELD(ContactPatch, momentum), FIELD(ContactPatch, held)});
    check("contact.glsl", "ApproachSums", sizeof(ApproachSums),
          {FIELD(ApproachSums, momentum), FIELD(ApproachSums, impulse)});
    check(
        "contact.glsl", "ContactResponse", sizeof(ContactResponse),
        {FIELD(ContactResponse, normal), FIELD(ContactResponse, velocity), FIELD(ContactResponse, slowing)});
}
TEST_F(LayoutsTest, RestShapes) {
    check("rest_shape.glsl", "RestShape", sizeof(RestShape),
          {FIELD(RestShape, inverse_moment_x), FIELD(RestShape, inverse_moment_y),
           FIELD(RestShape, inverse_moment_z)});
    check("rest_shape.glsl", "FitSums", sizeof(FitSums),
          {FIELD(FitSums, column_x), FIELD(FitSums, column_y), FIELD(FitSums, column_z)});
    check("rest_shape.glsl", "AffineFit", sizeof(AffineFit),
          {FIELD(AffineFit, column_x), FIELD(AffineFit, column_y), FIELD(AffineFit, column_z),
           FIELD(AffineFit, center), FIELD(AffineFit, origin)});
}
TEST_F(LayoutsTest, Proximities) {
    check("proximity.glsl", "FaceEdge", sizeof(FaceEdge),
          {FIELD(FaceEdge, a), FIELD(FaceEdge, b), FIELD(FaceEdge, object), FIELD(FaceEdge, face)});
    check("proximity.glsl", "Proximity", sizeof(Proximity),
          {FIELD(Proximity, first), FIELD(Proximity, second), FIELD(Proximity, distance),
           FIELD(Proximity, apart), FIELD(Proximity, weights)});
    check("proximity.glsl", "ProximityCounts", sizeof(ProximityCounts),
          {FIELD(ProximityCounts, node_face), FIELD(ProximityCounts, all), FIELD(ProximityCounts, nearest)});
    check("proximity.glsl", "LeafSearch", sizeof(LeafSearch),
          {FIELD(LeafSearch, first_object), FIELD(LeafSearch, object_count), FIELD(LeafSearch, first_near),
           FIELD(LeafSearch, near_count), FIELD(LeafSearch, first_node_task),
           FIELD(LeafSearch, first_edge_task)});
    check("proximity.glsl", "NearObject", sizeof(NearObject),
          {FIELD(NearObject, leaf), FIELD(NearObject, object), FIELD(NearObject, first_near),
           FIELD(NearObject, near_count)});
}
TEST_F(LayoutsTest, TetStrips) {
    check("tet_strip.glsl", "VolumeStep", sizeof(VolumeStep),
          {FIELD(VolumeStep, vertex), FIELD(VolumeStep, tet), FIELD(VolumeStep, inverse_six_volumes),
           FIELD(VolumeStep, modulus)});
    check("tet_strip.glsl", "NeoHookeanStep", sizeof(NeoHookeanStep),
          {FIELD(NeoHookeanStep, vertex), FIELD(NeoHookeanStep, tet), FIELD(NeoHookeanStep, mu),
           FIELD(NeoHookeanStep, lambda), FIELD(NeoHookeanStep, aa), FIELD(NeoHookeanStep, ab),
           FIELD(NeoHookeanStep, bb), FIELD(NeoHookeanStep, ac), FIELD(NeoHookeanStep, bc),
           FIELD(NeoHookeanStep, cc), FIELD(NeoHookeanStep, modulus), FIELD(NeoHookeanStep, volume),
           FIELD(NeoHookeanStep, opening)});
}
TEST_F(LayoutsTest, Dispatch) {
    check("dispatch.glsl", "Dispatch", sizeof(Dispatch),
          {FIELD(Dispatch, groups_x), FIELD(Dispatch, groups_y), FIELD(Dispatch, groups_z),
           FIELD(Dispatch, count)});
}

TEST_F(LayoutsTest, NodeContacts) {}

TEST_F(LayoutsTest, Descent) {
    check("tet_corner.glsl", "TetCorner", sizeof(TetCorner),
          {FIELD(TetCorner, a), FIELD(TetCorner, b), FIELD(TetCorner, c), FIELD(TetCorner, tet)});
}

}  // namespace
}  // namespace gelatin
