#include "bench/moved_bytes.h"

#include "model/layouts.h"

namespace gelatin {
namespace {

// A step's matrix, of edges that all have springs, and of tets.
double matrix_bytes(const Model& m) {
    return static_cast<double>(m.springs.size()) * (sizeof(EdgeMatrix) + 2 * sizeof(glm::uvec2));
}

}  // namespace

double linearise_bytes(const Model& m) {
    constexpr std::size_t kNode = 2 * sizeof(glm::vec4) + sizeof(NodeBlock);
    return matrix_bytes(m) + static_cast<double>(m.springs.size()) * sizeof(ElementEdge) +
           static_cast<double>(m.tets.size()) * 5 * sizeof(glm::vec4) +
           static_cast<double>(kNode) * m.node_count();
}

double iteration_bytes(const Model& m) {
    return matrix_bytes(m) + 10 * sizeof(glm::vec4) * m.node_count();
}

}  // namespace gelatin
