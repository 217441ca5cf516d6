#include "model/collision/node_faces.h"

#include <numeric>

namespace gelatin {

NodeFaces make_node_faces(std::uint32_t node_count, std::span<const Face> faces) {
    NodeFaces result;
    result.starts.assign(node_count + 1, 0);
    for (const Face& face : faces) {
        for (const std::uint32_t n : {face.a, face.b, face.c}) ++result.starts[n + 1];
    }
    std::partial_sum(result.starts.begin(), result.starts.end(), result.starts.begin());

    result.faces.resize(3 * faces.size());
    std::vector<std::uint32_t> next(result.starts.begin(), result.starts.end() - 1);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        for (const std::uint32_t n : {faces[f].a, faces[f].b, faces[f].c}) result.faces[next[n]++] = f;
    }
    return result;
}

}  // namespace gelatin
