#pragma once

#include <memory>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"
#include "model/assembly/collider_surface.h"
#include "model/assembly/make_animation.h"
#include "model/assembly/object_mesh.h"
#include "model/assembly/rigid_body.h"
#include "model/model.h"
#include "model/springs/fit_springs.h"

namespace gelatin {

/// One body ready to be packed: tets in world coordinates, and their materials; or a rigid one.
struct Body {
    std::string name;
    TetMesh mesh;
    Material material;
    glm::dvec3 velocity{0.0};  ///< [m/s]
    glm::dvec3 spin{0.0};      ///< about the centre of mass [rad/s]
    std::vector<Region> pins;
    std::vector<HandleDescription> handles;
    std::vector<std::shared_ptr<const BodySkeleton>> skeletons = {};  ///< of handles; empty: none has one
    std::vector<LoadDescription> loads;
    std::vector<Cavity> cavities = {};  ///< with nodes of `mesh`
    glm::vec3 color{-1.0f};             ///< linear RGB; negative: the renderer's palette

    /// Materials of parts, with the same kinds of springs as `material`, and the material of each tet: 0 is
    /// `material`, m is part_materials[m - 1], shape [tets]; empty: only `material`.
    std::vector<Material> part_materials;
    std::vector<std::uint32_t> tet_materials;

    /// For a material without kinds of springs: those fitted to the mesh before it was scaled; empty:
    /// pack_bodies fits them.
    std::shared_ptr<const FittedSprings> fitted;
    double scale = 1.0;  ///< scale of the mesh relative to the one that `fitted` belongs to

    /// Of a rigid body: its nodes' masses [kg], shape [nodes], and its volume [m^3]. Empty: tets have masses.
    std::vector<double> rigid_masses = {};
    double rigid_volume = 0.0;

    /// What is drawn of it, by the indices of the mesh's nodes; null: the boundary of the tets.
    std::shared_ptr<const ShapeSkin> skin = {};

    /// Null: the handle has a region.
    const BodySkeleton* skeleton_of(std::size_t handle) const {
        return handle < skeletons.size() ? skeletons[handle].get() : nullptr;
    }
    bool is_rigid() const { return !rigid_masses.empty(); }
    bool has_springs() const { return !is_rigid() && material.model == MaterialModel::mass_spring; }
    bool has_neo_hookean_tets() const { return !is_rigid() && material.model != MaterialModel::mass_spring; }
    /// Of a tet of `mesh`.
    const Material& material_of(std::size_t tet) const {
        const std::uint32_t m = tet_materials.empty() ? 0 : tet_materials[tet];
        return m == 0 ? material : part_materials[m - 1];
    }
};

/// Packs bodies into the arrays of a model: nodes in an order that keeps neighbours close, lumped masses (a
/// quarter of each tet's mass), springs, and the surface to draw: the boundary of the tets, and, if a body
/// has a skin, the skins of all.
/// @throws InvalidInput if a number does not fit into float (stiffness, mass), or the model exceeds 2^31
///   elements.
/// @param colliders planes, and solid spheres, boxes and capsules
Model pack_bodies(const std::vector<Body>& bodies, const std::vector<ColliderDescription>& colliders,
                  const glm::dvec3& gravity, const std::vector<ColliderSurface>& surfaces = {});

/// Makes the mesh of each of the scene's objects and packs them.
/// @throws InvalidInput as validate, pack_bodies, ObjectMesher::make and check_regions.
Model build_model(const Scene& scene);

}  // namespace gelatin
