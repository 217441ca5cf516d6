#include "support/contact_scenes.h"

#include "model/build/build_model.h"
#include "support/test_models.h"

namespace gelatin::test {

std::shared_ptr<const Model> make_blocks(const std::vector<Block>& blocks, const glm::dvec3& gravity,
                                         const std::vector<ColliderDescription>& colliders) {
    std::vector<Body> bodies;
    unsigned seed = 0;
    for (const Block& block : blocks) {
        Body body = make_body(make_block(block.cells, block.size, 0.15, ++seed));
        for (glm::dvec3& p : body.mesh.positions) p += block.place;
        body.velocity = block.velocity;
        body.pins = block.pins;
        body.material.youngs_modulus = block.youngs_modulus;
        body.material.poisson_ratio = block.poisson_ratio;
        body.material.model = block.model;
        if (block.model == MaterialModel::neo_hookean) body.material.springs.reset();
        bodies.push_back(std::move(body));
    }
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    scene.colliders = colliders;
    return std::make_shared<const Model>(
        pack_bodies(bodies, solid_colliders(scene), gravity, make_collider_surfaces(scene)));
}

}  // namespace gelatin::test
