#include "cpu/contact/near_objects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/file.h"
#include "cpu/collision/nearest_points.h"
#include "cpu/contact/swept_box.h"
#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using Box = cpu::AxisBox<double>;

// A body and a collider, near objects of which are found.
struct Scenery {
    explicit Scenery(const ColliderDescription& collider)
        : model(test::make_blocks({{}}, {0, 0, 0}, {collider})),
          surface(make_contact_surface(*model, {.friction = 0.4})),
          margin(cpu::BoxMargin<double>::for_distance(cpu::NearObjects<double>::most_listed(surface))),
          positions(model->positions.begin(), model->positions.end()),
          collision(model, BroadPhase::hierarchy, CollisionDetection::continuous, margin),
          near(model, surface, collision) {
        collision.update_boxes(positions, positions);
        near.run(positions, {.longest = 0.1}, list);
    }
    std::vector<std::uint32_t> collider_leaves() const {
        std::vector<std::uint32_t> leaves;
        for (const std::uint32_t leaf : model->face_trees.levels[0])
            if (model->faces[model->face_trees.nodes[leaf].first_item].object == 1) leaves.push_back(leaf);
        return leaves;
    }
    cpu::Triangle<double> triangle(std::uint32_t f) const {
        const Face& face = model->faces[f];
        return {glm::dvec3(positions[face.a]), glm::dvec3(positions[face.b]), glm::dvec3(positions[face.c])};
    }

    std::shared_ptr<const Model> model;
    ContactSurface surface;
    cpu::BoxMargin<double> margin;
    std::vector<glm::dvec4> positions;
    cpu::Collision<double> collision;
    cpu::NearObjects<double> near;
    cpu::ContactList<double> list;
};

glm::dvec3 corner_of(const Box& box, int k) {
    return {(k & 1) != 0 ? box.max.x : box.min.x, (k & 2) != 0 ? box.max.y : box.min.y,
            (k & 4) != 0 ? box.max.z : box.min.z};
}

// The least squared distance among samples: of corners of a box on its drift, which has the margin, from what
// is around points of a leaf's faces by the margin. Those are the points that the corners are nearest to,
// whichever corner of what is around them is meant.
double sampled_squared_gap(const Scenery& scenery, const Box& box, const glm::dvec3& drift,
                           std::uint32_t leaf) {
    constexpr int kTimes = 4;
    const TreeNode& faces = scenery.model->face_trees.nodes[leaf];
    const Box shifts{glm::dvec3(-scenery.margin.width), glm::dvec3(scenery.margin.width)};
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t f = faces.first_item; f < faces.first_item + faces.item_count; ++f) {
        const auto triangle = scenery.triangle(f);
        for (int sample = 0; sample < 64 * (kTimes + 1); ++sample) {
            const glm::dvec3 moved = double(sample / 64) / kTimes * drift;
            const Box at{box.min + moved, box.max + moved};
            const glm::dvec3 from = corner_of(at, sample % 8) + corner_of(shifts, sample / 8 % 8);
            Box around;
            around.add(from + cpu::nearest_points<double>(from, triangle).apart, scenery.margin);
            least = std::min(least, cpu::squared_distance(at, around));
        }
    }
    return least;
}

// Of 4 m, in the plane y = 0.
FileShape make_sheet(const TemporaryFolder& folder) {
    const FileShape sheet{folder.path() / "sheet.obj"};
    write_file(sheet.file, "v -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nf 1 3 2\nf 1 4 3\n");
    return sheet;
}

ColliderDescription turned(Shape shape) {
    ColliderDescription collider;
    collider.shape = std::move(shape);
    collider.rotation = {20, 30, 40};
    return collider;
}

// Of a box of large faces, which is turned, and of a sheet.
TEST(NearObjects, GapsAreNoMoreThanDistances) {
    const TemporaryFolder folder;
    test::RandomMaker random(1);
    int zero = 0, beyond_boxes = 0;
    for (const Shape& shape : {Shape(BoxShape{{4, 3, 2}}), Shape(make_sheet(folder))}) {
        const Scenery scenery(turned(shape));
        const std::vector<std::uint32_t> leaves = scenery.collider_leaves();
        ASSERT_FALSE(leaves.empty());
        for (int round = 0; round < 1000; ++round) {
            const glm::dvec3 center = random.point(4.0), half = glm::abs(random.point(0.5));
            const Box box{center - half, center + half};
            const glm::dvec3 drift =
                round % 3 == 0 ? glm::dvec3(0) : random.point(random.magnitude(0.01, 4.0));
            const std::uint32_t leaf = leaves[static_cast<std::size_t>(round) % leaves.size()];
            const double squared = scenery.near.squared_gap(box, drift, leaf);
            const double sampled = sampled_squared_gap(scenery, box, drift, leaf);
            ASSERT_LE(std::sqrt(squared), std::sqrt(sampled) + 1e-9) << round;
            zero += squared > 0.0 ? 0 : 1;
            const double between_boxes =
                cpu::squared_distance(cpu::swept(box, drift), scenery.collision.tree_boxes()[leaf]);
            beyond_boxes += squared > between_boxes + 0.01 ? 1 : 0;
        }
    }
    EXPECT_GT(zero, 100);
    EXPECT_GT(beyond_boxes, 200);
}

// Boxes above the middle of a sheet, on either side of it, that go along it, away from it or nearer to it:
// the whole distance.
TEST(NearObjects, GapsAreThoseToThePlanesOfFaces) {
    const TemporaryFolder folder;
    const Scenery scenery(turned(make_sheet(folder)));
    const std::uint32_t leaf = scenery.collider_leaves().front();
    const auto triangle = scenery.triangle(scenery.model->face_trees.nodes[leaf].first_item);
    const glm::dvec3 normal =
        glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    test::RandomMaker random(2);
    for (int round = 0; round < 500; ++round) {
        const double side = round % 2 == 0 ? 1.0 : -1.0;
        const glm::dvec3 along = random.point(0.3), half = glm::abs(random.point(0.2));
        const glm::dvec3 center = along + side * (1.0 + random.uniform(0.0, 1.0)) * normal;
        const glm::dvec3 drift = random.point(0.3);
        const Box box{center - half, center + half};
        const double sampled = std::sqrt(sampled_squared_gap(scenery, box, drift, leaf));
        ASSERT_GT(sampled, 0.0);
        EXPECT_NEAR(std::sqrt(scenery.near.squared_gap(box, drift, leaf)), sampled, 1e-9) << round;
    }
}

}  // namespace
}  // namespace gelatin
