#include "model/collision/rest_shape.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "model/corners.h"
#include "model/model.h"

namespace gelatin {
namespace {

struct RestBox {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    void add(const RestBox& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
    double distance(const RestBox& box) const {
        return glm::length(glm::max(glm::max(min - box.max, box.min - max), glm::dvec3(0.0)));
    }
};

using Corners = std::array<glm::dvec3, 3>;

// The length of a direction does not matter; a direction of length 0 gives no information.
double gap_along(const glm::dvec3& direction, const Corners& a, const Corners& b) {
    const double length = glm::length(direction);
    if (!(length > 0.0)) return 0.0;
    const auto [low_a, high_a] =
        std::minmax({glm::dot(direction, a[0]), glm::dot(direction, a[1]), glm::dot(direction, a[2])});
    const auto [low_b, high_b] =
        std::minmax({glm::dot(direction, b[0]), glm::dot(direction, b[1]), glm::dot(direction, b[2])});
    return std::max(low_a - high_b, low_b - high_a) / length;
}

// The widest gap between two triangles along the usual separating directions, a lower bound of their
// distance. Stops once it is `enough`.
double least_distance(const Corners& a, const Corners& b, double enough) {
    const glm::dvec3 edges_a[] = {a[1] - a[0], a[2] - a[1], a[0] - a[2]};
    const glm::dvec3 edges_b[] = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const glm::dvec3 normal_a = glm::cross(edges_a[0], edges_a[1]);
    const glm::dvec3 normal_b = glm::cross(edges_b[0], edges_b[1]);
    double widest = 0.0;
    const auto try_direction = [&](const glm::dvec3& direction) {
        widest = std::max(widest, gap_along(direction, a, b));
        return widest >= enough;
    };
    if (try_direction(b[0] + b[1] + b[2] - a[0] - a[1] - a[2])) return widest;
    if (try_direction(normal_a) || try_direction(normal_b)) return widest;
    for (const glm::dvec3& edge : edges_a)
        if (try_direction(glm::cross(edge, normal_a))) return widest;
    for (const glm::dvec3& edge : edges_b)
        if (try_direction(glm::cross(edge, normal_b))) return widest;
    for (const glm::dvec3& p : a)
        for (const glm::dvec3& q : b)
            if (try_direction(p - q)) return widest;
    for (const glm::dvec3& e : edges_a)
        for (const glm::dvec3& f : edges_b)
            if (try_direction(glm::cross(e, f))) return widest;
    return widest;
}

class Clearances {
public:
    explicit Clearances(const Model& model)
        : model_(model), face_boxes_(model.faces.size()), tree_boxes_(model.face_trees.nodes.size()) {
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            for (const glm::dvec3& p : corners(model.faces[f])) face_boxes_[f].add({p, p});
        }
        const std::vector<TreeNode>& nodes = model.face_trees.nodes;
        for (std::uint32_t n = static_cast<std::uint32_t>(nodes.size()); n-- > 0;) {
            for (std::uint32_t k = 0; k < nodes[n].item_count; ++k)
                tree_boxes_[n].add(face_boxes_[nodes[n].first_item + k]);
            for (std::uint32_t child = n + 1; child < nodes[n].skip; child = nodes[child].skip)
                tree_boxes_[n].add(tree_boxes_[child]);
        }
    }

    // Not searched for at larger distances than the face's length.
    double of(std::uint32_t face) const {
        const Face& own = model_.faces[face];
        const Corners own_corners = corners(own);
        double clearance = std::max({glm::distance(own_corners[0], own_corners[1]),
                                     glm::distance(own_corners[1], own_corners[2]),
                                     glm::distance(own_corners[2], own_corners[0])});
        const std::vector<TreeNode>& nodes = model_.face_trees.nodes;
        const std::uint32_t root = model_.face_trees.roots[own.object];
        for (std::uint32_t n = root; n < nodes[root].skip;) {
            const bool near = tree_boxes_[n].distance(face_boxes_[face]) < clearance;
            for (std::uint32_t k = 0; near && k < nodes[n].item_count; ++k) {
                const std::uint32_t other = nodes[n].first_item + k;
                if (share_corner(own, model_.faces[other])) continue;
                if (face_boxes_[other].distance(face_boxes_[face]) >= clearance) continue;
                clearance =
                    std::min(clearance, least_distance(own_corners, corners(model_.faces[other]), clearance));
            }
            n = near ? n + 1 : nodes[n].skip;
        }
        return clearance;
    }

private:
    Corners corners(const Face& face) const {
        return {glm::dvec3(model_.positions[face.a]), glm::dvec3(model_.positions[face.b]),
                glm::dvec3(model_.positions[face.c])};
    }

    const Model& model_;
    std::vector<RestBox> face_boxes_, tree_boxes_;
};

RestShape make_rest_shape(const Model& model, const Range& nodes, std::vector<glm::vec4>& offsets) {
    glm::dvec3 middle(0.0);
    RestBox box;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 p(model.positions[n]);
        middle += p / static_cast<double>(nodes.count);
        box.add({p, p});
    }
    glm::dmat3 moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 offset = glm::dvec3(model.positions[n]) - middle;
        moment += glm::outerProduct(offset, offset);
        offsets.emplace_back(glm::vec3(offset), 0.0f);
    }
    const glm::mat3 inverse(glm::inverse(moment));
    const auto length = static_cast<float>(glm::length(box.max - box.min));
    return {glm::vec4(inverse[0], length), glm::vec4(inverse[1], 0.0f), glm::vec4(inverse[2], 0.0f)};
}

}  // namespace

RestShapes make_rest_shapes(const Model& model) {
    RestShapes shapes;
    shapes.offsets.reserve(model.positions.size());
    for (const ModelObject& object : model.objects)
        shapes.objects.push_back(make_rest_shape(model, object.nodes, shapes.offsets));
    const Clearances clearances(model);
    constexpr float kRoundedDown = 1.0f - 1e-5f;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f)
        shapes.clearances.push_back(kRoundedDown * static_cast<float>(clearances.of(f)));
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const auto first = shapes.clearances.begin() + model.objects[o].faces.first;
        const auto least = std::min_element(first, first + model.objects[o].faces.count);
        if (model.objects[o].faces.count > 0) shapes.objects[o].inverse_moment_y.w = *least;
    }
    return shapes;
}

}  // namespace gelatin
