#pragma once

#include <cstdint>

#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// What colliders did in the last sweep of block descent. CPU twin: cpu::ColliderContacts.
struct ColliderContacts {
    gl::Buffer<std::uint32_t> objects;  ///< not 0 where they met a collider in this step
    gl::Buffer<ColliderContact> nodes;  ///< empty without colliders

    explicit ColliderContacts(const Model& model) : objects(model.objects.size()) {
        if (!model.colliders.empty()) nodes = gl::Buffer<ColliderContact>(model.positions.size());
    }

    /// To be called for each program that reads or writes them.
    void bind(const gl::Program& program) const {
        program.bind("ObjectContacts", objects);
        program.bind("Contacts", nodes);
    }
};

}  // namespace gelatin::gpu
