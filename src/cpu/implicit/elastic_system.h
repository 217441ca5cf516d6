#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/elasticity/elements.h"
#include "cpu/implicit/cavity_elements.h"
#include "cpu/implicit/elastic_arrays.h"
#include "cpu/nodes.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// The elements of a step, linearised where it begins: springs, tets and the volume term, with their dampers,
/// and the gas of cavities.
/// For a displacement d of the nodes, forces are f - K d, with K symmetric and, but for pressures, positive
/// semi-definite. All sums are gathered by node, in a fixed order.
template <class Real>
class ElasticSystem {
public:
    explicit ElasticSystem(std::shared_ptr<const Model> model);

    /// @param positions, velocities shape [nodes]; of the velocities only the damping times are read
    /// @param inverse_step [1/s] @param drives of cavities, shape [Model::cavities]
    void linearise(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> velocities,
                   Real inverse_step, std::span<const double> drives = {});

    /// @param asleep bodies whose nodes are all held: what is found of them may stay as it was
    void leave_out(std::span<const std::uint8_t> /*asleep*/) {}

    /// f [N], shape [nodes]; of held nodes too.
    const std::vector<Vec3<Real>>& forces() const { return forces_; }
    /// The 3 x 3 blocks of K on its diagonal [N/m], shape [nodes].
    const std::vector<SymmetricMatrix<Real>>& diagonal() const { return diagonal_; }

    /// d, of which products are made: xyz [m], shape [nodes].
    std::vector<Vec4<Real>> displacements;
    /// To be called for each d and body, before its products.
    void begin_product(const ModelObject& body);
    /// K d of some nodes. @param product output [N], shape [nodes]
    void multiply(const Range& nodes, std::span<Vec3<Real>> product) const;

private:
    // What a spring to `other` adds to K of a node: stretch stretch^T + across.
    struct HalfSpring {
        std::uint32_t other;
        Vec3<Real> stretch;  // sqrt(k - across) times its direction
        Real across;         // [N/m]
    };
    // What a neo-Hookean tet adds to K, from the change of its deformation gradient; times its volume.
    struct TetStiffness {
        Mat3<Real> gradient, cofactor;
        Real shear, pressure, stretch, volume;  // of dF, d cof F, F (F : dF), cof F (cof F : dF)
        Real viscosity;                         // of F S(dF), with S the viscous stress
    };

    void linearise_springs(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> velocities,
                           Real inverse_step);
    void linearise_volumes(std::span<const Vec4<Real>> positions);
    void linearise_neo_hookean(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> velocities,
                               Real inverse_step);

    std::shared_ptr<const Model> model_;
    NodeTets node_tets_;  // of all tets
    std::vector<std::uint32_t> spring_starts_;
    std::vector<HalfSpring> half_springs_;
    // By tet of Model::tets; empty where bodies have neither springs with a volume term nor flat tets to
    // fear.
    std::vector<Vec3<Real>> slopes_;   // 4 t + c: dJ/dx of corner c [1/m]
    std::vector<Real> slope_weights_;  // of slope slope^T [J]
    std::vector<Real> tet_pressures_;  // minus what the slopes are multiplied by in forces [J]
    std::vector<Real> ratios_, node_pressures_, tet_values_;
    std::vector<TetStiffness> neo_hookean_;
    std::vector<Vec3<Real>> corner_forces_;  // 4 t + c, of neo-Hookean tets
    std::vector<Vec3<Real>> forces_;
    std::vector<SymmetricMatrix<Real>> diagonal_;
    CavityElements<Real> cavities_;
};

/// The same with SIMD, and with what tets add to K as matrices, one for each edge: a step multiplies often.
template <>
class ElasticSystem<float> {
public:
    explicit ElasticSystem(std::shared_ptr<const Model> model);

    void linearise(std::span<const Vec4<float>> positions, std::span<const Vec4<float>> velocities,
                   float inverse_step, std::span<const double> drives = {});
    void leave_out(std::span<const std::uint8_t> asleep);
    const std::vector<Vec3<float>>& forces() const { return forces_; }
    const std::vector<SymmetricMatrix<float>>& diagonal() const { return diagonal_; }
    std::vector<Vec4<float>> displacements;
    void begin_product(const ModelObject& body) { cavities_.begin_product(body, displacements); }
    void multiply(const Range& nodes, std::span<Vec3<float>> product) const;

private:
    void find_points(std::span<const Vec4<float>> positions);

    std::shared_ptr<const Model> model_;
    ElasticArrays arrays_;
    std::vector<std::uint8_t> left_out_nodes_, left_out_tets_;  // groups
    std::vector<Vec3<float>> forces_;
    std::vector<SymmetricMatrix<float>> diagonal_;
    CavityElements<float> cavities_;
};

}  // namespace gelatin::cpu
