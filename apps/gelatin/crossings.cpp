#include "crossings.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "cpu/collision/triangle_overlap.h"

namespace gelatin {
namespace {

struct FaceBox {
    glm::dvec3 min, max;
    std::uint32_t face;
};

bool have_a_common_vertex(const glm::uvec3& a, const glm::uvec3& b) {
    return glm::any(glm::equal(a, b)) || glm::any(glm::equal(a, glm::uvec3(b.y, b.z, b.x))) ||
           glm::any(glm::equal(a, glm::uvec3(b.z, b.x, b.y)));
}

}  // namespace

// Along x, each face against those that begin before it ends.
std::size_t count_crossings(const SurfaceMesh& mesh) {
    const auto triangle = [&](std::uint32_t f) {
        const glm::uvec3& face = mesh.faces[f];
        return cpu::Triangle<double>{mesh.positions[face.x], mesh.positions[face.y], mesh.positions[face.z]};
    };
    std::vector<FaceBox> boxes;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto [a, b, c] = triangle(f);
        boxes.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), f});
    }
    std::sort(boxes.begin(), boxes.end(),
              [](const FaceBox& a, const FaceBox& b) { return a.min.x < b.min.x; });
    std::size_t count = 0;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        const FaceBox& box = boxes[k];
        for (std::size_t other = k + 1; other < boxes.size() && boxes[other].min.x <= box.max.x; ++other) {
            const FaceBox& near = boxes[other];
            if (near.min.y > box.max.y || near.max.y < box.min.y || near.min.z > box.max.z ||
                near.max.z < box.min.z || have_a_common_vertex(mesh.faces[box.face], mesh.faces[near.face]))
                continue;
            count += cpu::triangles_overlap(triangle(box.face), triangle(near.face)) ? 1 : 0;
        }
    }
    return count;
}

}  // namespace gelatin
