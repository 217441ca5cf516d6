#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

/// The structs that C++ and GLSL share: the files of shaders/layouts/ compiled as C++.
/// Made of 4-byte scalars, doubles and vec4 alone, so that std430 and C++ agree; tests/gpu asks the driver.
namespace gelatin::layouts {

using uint = std::uint32_t;
using glm::vec4;

#include "layouts/alarm.glsl"
#include "layouts/box.glsl"
#include "layouts/chunk.glsl"
#include "layouts/collider.glsl"
#include "layouts/contact.glsl"
#include "layouts/dispatch.glsl"
#include "layouts/draw.glsl"
#include "layouts/element_edge.glsl"
#include "layouts/face.glsl"
#include "layouts/half_spring_pair.glsl"
#include "layouts/handle.glsl"
#include "layouts/load.glsl"
#include "layouts/near_pair.glsl"
#include "layouts/object_pair.glsl"
#include "layouts/pair_guard.glsl"
#include "layouts/pair_rows.glsl"
#include "layouts/proximity.glsl"
#include "layouts/rest_shape.glsl"
#include "layouts/rest_state.glsl"
#include "layouts/shape_match.glsl"
#include "layouts/skin_point.glsl"
#include "layouts/spring.glsl"
#include "layouts/step_end.glsl"
#include "layouts/step_rows.glsl"
#include "layouts/step_state.glsl"
#include "layouts/step_system.glsl"
#include "layouts/surface_vertex.glsl"
#include "layouts/tet_corner.glsl"
#include "layouts/tet_strip.glsl"
#include "layouts/tree_node.glsl"

static_assert(sizeof(AffineFit) == 80);
static_assert(sizeof(Alarm) == 16);
static_assert(sizeof(ApproachSums) == 32);
static_assert(sizeof(BodyPlace) == 16);
static_assert(sizeof(BodyTouch) == 32);
static_assert(sizeof(BoundingBox) == 48);
static_assert(sizeof(BodyChange) == 96);
static_assert(sizeof(BodyEnergy) == 40);
static_assert(sizeof(BodyInverse) == 144);
static_assert(sizeof(BodyMotion) == 32);
static_assert(sizeof(BodyPace) == 80);
static_assert(sizeof(BodyRows) == 16);
static_assert(sizeof(Box) == 32);
static_assert(sizeof(Chunk) == 16);
static_assert(sizeof(ChunkRows) == 16);
static_assert(sizeof(Collider) == 64);
static_assert(sizeof(ContactPatch) == 48);
static_assert(sizeof(ContactResponse) == 48);
static_assert(sizeof(Dispatch) == 16);
static_assert(sizeof(Draw) == 16);
static_assert(sizeof(EdgeMatrix) == 48);
static_assert(sizeof(ElementEdge) == 16);
static_assert(sizeof(Face) == 16);
static_assert(sizeof(FaceEdge) == 16);
static_assert(sizeof(FacePair) == 16);
static_assert(sizeof(FitSums) == 48);
static_assert(sizeof(GuardState) == 16);
static_assert(sizeof(HalfSpringPair) == 16);
static_assert(sizeof(HandleMotion) == 128);
static_assert(sizeof(HandleNode) == 32);
static_assert(sizeof(LeafSearch) == 32);
static_assert(sizeof(LoadedNode) == 16);
static_assert(sizeof(NearObject) == 16);
static_assert(sizeof(NearPair) == 80);
static_assert(sizeof(NeoHookeanStep) == 64);
static_assert(sizeof(NodeBlock) == 32);
static_assert(sizeof(NodeClips) == 8);
static_assert(sizeof(NodeLoad) == 32);
static_assert(sizeof(NodeMotion) == 32);
static_assert(sizeof(NodeSums) == 32);
static_assert(sizeof(ObjectPair) == 32);
static_assert(sizeof(PairCounts) == 32);
static_assert(sizeof(PairRow) == 16);
static_assert(sizeof(PairSlot) == 16);
static_assert(sizeof(PairWeight) == 32);
static_assert(sizeof(Proximity) == 48);
static_assert(sizeof(PlaneMemory) == 32);
static_assert(sizeof(ProximityCounts) == 16);
static_assert(sizeof(ResidualSums) == 32);
static_assert(sizeof(RestMoment) == 48);
static_assert(sizeof(RestShape) == 48);
static_assert(sizeof(RestState) == 16);
static_assert(sizeof(RowMemory) == 32);
static_assert(sizeof(RowPlace) == 16);
static_assert(sizeof(ShapePlace) == 96);
static_assert(sizeof(ShapeSums) == 80);
static_assert(sizeof(SkinPoint) == 32);
static_assert(sizeof(SlotRows) == 16);
static_assert(sizeof(SolveState) == 32);
static_assert(sizeof(Spring) == 16);
static_assert(sizeof(StepBody) == 80);
static_assert(sizeof(StepBodySums) == 48);
static_assert(sizeof(StartSums) == 48);
static_assert(sizeof(StepClock) == 80);
static_assert(sizeof(StepIsland) == 48);
static_assert(sizeof(StepPair) == 16);
static_assert(sizeof(StepRow) == 96);
static_assert(sizeof(StepTangent) == 48);
static_assert(sizeof(SurfaceVertex) == 16);
static_assert(sizeof(TetCorner) == 16);
static_assert(sizeof(TreeNode) == 16);
static_assert(sizeof(VolumeStep) == 16);

}  // namespace gelatin::layouts

namespace gelatin {
using layouts::AffineFit;
using layouts::Alarm;
using layouts::ApproachSums;
using layouts::BodyChange;
using layouts::BodyEnergy;
using layouts::BodyInverse;
using layouts::BodyMotion;
using layouts::BodyPace;
using layouts::BodyPlace;
using layouts::BodyRows;
using layouts::BodyTouch;
using layouts::BoundingBox;
using layouts::Box;
using layouts::Chunk;
using layouts::ChunkRows;
using layouts::Collider;
using layouts::ContactPatch;
using layouts::ContactResponse;
using layouts::Dispatch;
using layouts::Draw;
using layouts::EdgeMatrix;
using layouts::ElementEdge;
using layouts::Face;
using layouts::FaceEdge;
using layouts::FacePair;
using layouts::FitSums;
using layouts::GuardState;
using layouts::HalfSpringPair;
using layouts::HandleMotion;
using layouts::HandleNode;
using layouts::LeafSearch;
using layouts::LoadedNode;
using layouts::NearObject;
using layouts::NearPair;
using layouts::NeoHookeanStep;
using layouts::NodeBlock;
using layouts::NodeClips;
using layouts::NodeLoad;
using layouts::NodeMotion;
using layouts::NodeSums;
using layouts::ObjectPair;
using layouts::PairCounts;
using layouts::PairRow;
using layouts::PairSlot;
using layouts::PairWeight;
using layouts::PlaneMemory;
using layouts::Proximity;
using layouts::ProximityCounts;
using layouts::ResidualSums;
using layouts::RestMoment;
using layouts::RestShape;
using layouts::RestState;
using layouts::RowMemory;
using layouts::RowPlace;
using layouts::ShapePlace;
using layouts::ShapeSums;
using layouts::SkinPoint;
using layouts::SlotRows;
using layouts::SolveState;
using layouts::Spring;
using layouts::StartSums;
using layouts::StepBody;
using layouts::StepBodySums;
using layouts::StepClock;
using layouts::StepIsland;
using layouts::StepPair;
using layouts::StepRow;
using layouts::StepTangent;
using layouts::SurfaceVertex;
using layouts::TetCorner;
using layouts::TreeNode;
using layouts::VolumeStep;
}  // namespace gelatin
