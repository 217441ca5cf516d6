#include "gpu/measure/measure.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "gpu/chunks.h"

namespace gelatin::gpu {
namespace {

gl::Defines node_defines(const Model& model) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    for (const std::string& define : NeoHookeanBuffers::defines(model)) defines.push_back(define);
    for (const std::string& define : VolumeTermBuffers::defines(model)) defines.push_back(define);
    return defines;
}

template <class T>
std::vector<T> read_as(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

}  // namespace

Measure::Measure(const Model& model, bool self_collision)
    : node_program_(gl::Program::compute("sim/measure/measure_nodes.comp", node_defines(model))),
      face_program_(gl::Program::compute("sim/measure/measure_faces.comp")),
      colliding_program_(
          gl::Program::compute("sim/measure/count_colliding_faces.comp",
                               self_collision ? gl::Defines{"SELF_COLLISION"} : gl::Defines{})),
      node_chunks_(make_chunks(model, &ModelObject::nodes)),
      face_chunks_(make_chunks(model, &ModelObject::faces)),
      node_chunk_buffer_(std::span<const Chunk>(node_chunks_)),
      face_chunk_buffer_(std::span<const Chunk>(face_chunks_)),
      node_sums_(node_chunks_.size()),
      volumes_(face_chunks_.size()),
      colliding_(std::span<const std::uint32_t>(std::vector<std::uint32_t>(face_chunks_.size() + 1))),
      object_count_(model.objects.size()) {
    set_contact_distances(std::vector<float>(object_count_, static_cast<float>(kContactDistance)));
}

void Measure::begin(const ModelBuffers& model, const NodeBuffers& nodes, const CollisionBuffers* collision,
                    const SelfCollisionBuffers* self, const ProximityBuffers* near) {
    gl::barrier(gl::Barrier::storage);  // what was measured before may still be on its way to the host
    node_program_.bind("positions", nodes.position_texels);
    node_program_.bind("velocities", nodes.velocity_texels);
    model.bind_half_springs(node_program_);
    model.neo_hookean.bind(node_program_);
    model.volume_term.bind(node_program_);
    model.bind_colliders(node_program_);
    node_program_.bind("Chunks", node_chunk_buffer_);
    node_program_.bind("Sums", node_sums_);
    node_program_.set("chunk_count", static_cast<std::uint32_t>(node_chunks_.size()));
    node_program_.set("gravity", model.gravity);
    node_program_.bind("contact_distances", contact_distances_);
    node_program_.dispatch_groups(node_chunks_.size());

    face_program_.bind("positions", nodes.position_texels);
    face_program_.bind("Chunks", face_chunk_buffer_);
    face_program_.bind("Volumes", volumes_);
    face_program_.bind("Faces", model.faces);
    face_program_.set("chunk_count", static_cast<std::uint32_t>(face_chunks_.size()));
    face_program_.dispatch_groups(face_chunks_.size());

    if (collision != nullptr) count_colliding_faces(*collision, self);
    readback_.begin(node_sums_.id(), node_sums_.size() * sizeof(NodeSums));
    readback_.begin(volumes_.id(), volumes_.size() * sizeof(float));
    readback_.begin(colliding_.id(), colliding_.size() * sizeof(std::uint32_t));
    if (near != nullptr) readback_.begin(near->found.id(), sizeof(ProximityCounts));
    proximity_capacities_.push_back(near != nullptr ? static_cast<std::uint32_t>(near->proximities.size())
                                                    : 0);
}

// One element for each chunk, and the lost pairs.
void Measure::count_colliding_faces(const CollisionBuffers& collision, const SelfCollisionBuffers* self) {
    collision.bind_pairs(colliding_program_);
    colliding_program_.bind("FaceCollisions", collision.face_collisions);
    colliding_program_.bind("Chunks", face_chunk_buffer_);
    colliding_program_.bind("Colliding", colliding_);
    if (self != nullptr) colliding_program_.bind("ContactCounts", self->contact_counts);
    colliding_program_.set("chunk_count", static_cast<std::uint32_t>(face_chunks_.size()));
    colliding_program_.dispatch_groups(face_chunks_.size());
}

Measurement Measure::end() {
    const auto sums = read_as<NodeSums>(readback_.take());
    const auto volumes = read_as<float>(readback_.take());
    const auto colliding = read_as<std::uint32_t>(readback_.take());
    Measurement measured;
    measured.lost_pairs = colliding.back();
    if (proximity_capacities_.front() > 0) {
        const auto found = read_as<ProximityCounts>(readback_.take()).front();
        measured.proximities = {found.node_face, found.all - found.node_face,
                                found.all - std::min(found.all, proximity_capacities_.front()),
                                static_cast<double>(std::bit_cast<float>(found.nearest))};
    }
    proximity_capacities_.pop_front();
    std::vector<ObjectMeasure>& objects = measured.objects;
    objects.resize(object_count_);
    for (std::size_t c = 0; c < sums.size(); ++c) {
        ObjectMeasure& object = objects[node_chunks_[c].object];
        object.momentum += glm::dvec3(sums[c].momentum_x, sums[c].momentum_y, sums[c].momentum_z);
        object.kinetic_energy += static_cast<double>(sums[c].kinetic_energy);
        object.elastic_energy += static_cast<double>(sums[c].elastic_energy);
        object.potential_energy += static_cast<double>(sums[c].potential_energy);
        object.deepest_penetration =
            std::max(object.deepest_penetration, static_cast<double>(sums[c].deepest));
        object.contacts += sums[c].contacts;
    }
    for (std::size_t c = 0; c < volumes.size(); ++c) {
        objects[face_chunks_[c].object].volume += static_cast<double>(volumes[c]);
        objects[face_chunks_[c].object].colliding_faces += colliding[c];
    }
    return measured;
}

}  // namespace gelatin::gpu
