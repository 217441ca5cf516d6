#include "arrays.h"

namespace gelatin::python {

Vectors view_of(std::span<const glm::vec4> values, nb::handle owner) {
    const float* const first = values.empty() ? nullptr : &values[0].x;
    return Vectors(first, {values.size(), 3}, owner, {4, 1});
}

Indices view_of(const std::uint32_t* rows, std::size_t count, std::size_t columns, nb::handle owner) {
    return Indices(rows, {count, columns}, owner, {4, 1});
}

Vectors array_of(std::vector<float> values) {
    auto* const kept = new std::vector<float>(std::move(values));
    const nb::capsule owner(kept,
                            [](void* pointer) noexcept { delete static_cast<std::vector<float>*>(pointer); });
    return Vectors(kept->data(), {kept->size() / 3, 3}, owner);
}

}  // namespace gelatin::python
