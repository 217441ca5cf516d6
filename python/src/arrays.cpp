#include "arrays.h"

namespace gelatin::python {

nb::capsule capsule_of(Owner owner) {
    return nb::capsule(new Owner(std::move(owner)),
                       [](void* pointer) noexcept { delete static_cast<Owner*>(pointer); });
}

Vectors view_of(std::span<const glm::vec4> values, Owner owner) {
    const float* const first = values.empty() ? nullptr : &values[0].x;
    return Vectors(first, {values.size(), 3}, capsule_of(std::move(owner)), {4, 1});
}

Indices view_of(const std::uint32_t* rows, std::size_t count, std::size_t columns, Owner owner) {
    return Indices(rows, {count, columns}, capsule_of(std::move(owner)), {4, 1});
}

Vectors array_of(std::vector<float> values) {
    const auto kept = std::make_shared<const std::vector<float>>(std::move(values));
    return Vectors(kept->data(), {kept->size() / 3, 3}, capsule_of(kept));
}

}  // namespace gelatin::python
