#include "model/descent/coarse_matrix.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>

#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/node_tets.h"

namespace gelatin {
namespace {

// Of the diagonal, added to it: a cluster whose nodes are in one line rotates about it without any
// resistance.
constexpr double kLeastStiffness = 1e-8;

// Of the stiffness of a body's clusters against each other, over their inertia.
constexpr double kRigid = 10.0;

// A node and its part of a linear form of displacements: l(d) = sum of slope . d.
struct Slope {
    std::uint32_t node;
    glm::dvec3 slope;
};

// Quadratic forms of one object's nodes as its clusters' motions see them.
class Assembly {
public:
    Assembly(const Model& model, const CoarseBasis& basis, const Range& clusters)
        : model_(model), basis_(basis), clusters_(clusters) {}

    // matrix += factor l l^T, in the half below the diagonal.
    void add(std::span<const Slope> form, double factor, Eigen::MatrixXd& matrix) {
        collect(form);
        for (const Row& a : rows_) {
            for (const Row& b : rows_) {
                if (a.cluster < b.cluster) continue;
                matrix.block<6, 6>(6 * a.cluster, 6 * b.cluster) += factor * a.slope * b.slope.transpose();
            }
        }
    }

private:
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    struct Row {
        Eigen::Index cluster;
        Vector6 slope;
    };

    void collect(std::span<const Slope> form) {
        rows_.clear();
        for (const Slope& part : form) {
            const glm::dvec3 position(model_.positions[part.node]);
            for (const CoarseBasis::Part& cluster : basis_.clusters_of(part.node)) {
                const glm::dvec3 translation = static_cast<double>(cluster.weight) * part.slope;
                const glm::dvec3 orientation =
                    glm::cross(position - basis_.middles[cluster.index], translation);
                row_of(cluster.index - clusters_.first).slope +=
                    (Vector6() << translation.x, translation.y, translation.z, orientation.x, orientation.y,
                     orientation.z)
                        .finished();
            }
        }
    }

    Row& row_of(Eigen::Index cluster) {
        const auto found =
            std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.cluster == cluster; });
        return found != rows_.end() ? *found : rows_.emplace_back(Row{cluster, Vector6::Zero()});
    }

    const Model& model_;
    const CoarseBasis& basis_;
    Range clusters_;
    std::vector<Row> rows_;
};

// A body's elements are added up in so many parts, each by one thread, which are added up in their order.
constexpr std::uint32_t kParts = 16;

// One part of one object's.
class ElementSums {
public:
    ElementSums(const Model& model, const CoarseBasis& basis, std::size_t object, std::uint32_t part)
        : model_(model),
          object_(model.objects[object]),
          part_(part),
          assembly_(model, basis, basis.objects[object]),
          result_(nothing(basis, object)) {}

    static CoarseMatrices nothing(const CoarseBasis& basis, std::size_t object) {
        const auto size = 6 * static_cast<Eigen::Index>(basis.objects[object].count);
        const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(size, size);
        return {zero, zero, zero, zero};
    }

    CoarseMatrices sum() {
        add_masses();
        add_springs();
        add_volume_term();
        add_neo_hookean_tets();
        return std::move(result_);
    }

private:
    Range part_of(const Range& range) const {
        const auto at = [&](std::uint64_t part) {
            return static_cast<std::uint32_t>(range.count * part / kParts);
        };
        return {range.first + at(part_), at(part_ + 1) - at(part_)};
    }

    void add_masses() {
        const Range part = part_of(object_.nodes);
        for (std::uint32_t n = part.first; n < part.end(); ++n) {
            for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
                assembly_.add(std::array{Slope{n, axis}}, static_cast<double>(model_.masses[n]),
                              result_.inertia);
            }
        }
    }

    void add_damped(std::span<const Slope> form, double stiffness) {
        assembly_.add(form, stiffness, result_.elastic);
        double time = 0.0;
        for (const Slope& part : form) time += static_cast<double>(model_.velocities[part.node].w);
        if (time > 0.0)
            assembly_.add(form, stiffness * time / static_cast<double>(form.size()), result_.viscous);
    }

    void add_springs() {
        const Range part = part_of(object_.springs);
        for (std::uint32_t s = part.first; s < part.end(); ++s) {
            const Spring& spring = model_.springs[s];
            const glm::dvec3 n = glm::normalize(position(spring.j) - position(spring.i));
            add_damped(std::array{Slope{spring.i, -n}, Slope{spring.j, n}},
                       static_cast<double>(spring.stiffness));
        }
    }

    // With the stiffness of every tet by itself, which the sweeps have as well.
    void add_volume_term() {
        if (model_.volume_term.is_empty()) return;
        const Range part = part_of(object_.tets);
        for (std::uint32_t t = part.first; t < part.end(); ++t) {
            const glm::uvec4& tet = model_.tets[t];
            const auto volume = static_cast<double>(model_.tet_rests[t].volume);
            std::array<Slope, 4> form;
            for (int corner = 0; corner < 4; ++corner) {
                const auto& others = kOppositeCorners[corner];
                const glm::dvec3 a = position(tet[others[0]]), b = position(tet[others[1]]),
                                 c = position(tet[others[2]]);
                form[static_cast<std::size_t>(corner)] = {tet[corner],
                                                          glm::cross(b - a, c - a) / (6.0 * volume)};
            }
            assembly_.add(form, volume * static_cast<double>(model_.volume_term.tets[t]), result_.elastic);
        }
    }

    // Hooke's law, which they obey about their shape at rest: V (mu_L e : e + lambda_L / 2 tr(e)^2), with e
    // the small strain.
    void add_neo_hookean_tets() {
        const Range part = part_of(object_.neo_hookean_tets);
        for (std::uint32_t t = part.first; t < part.end(); ++t) {
            const NeoHookeanTet& tet = model_.neo_hookean_tets[t];
            const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
            const double volume = static_cast<double>(tet.gradient_1.w);
            const double mu = 0.75 * static_cast<double>(tet.gradient_2.w);
            const double lambda = static_cast<double>(tet.gradient_3.w) - 5.0 / 6.0 * mu;
            std::array<Slope, 4> form;
            const auto add = [&](const auto& slope_of, double stiffness) {
                for (std::size_t c = 0; c < 4; ++c)
                    form[c] = {nodes_of(tet)[static_cast<int>(c)], slope_of(gradients[c])};
                add_damped(form, volume * stiffness);
            };
            add([](const glm::dvec3& g) { return g; }, lambda);
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j <= i; ++j) {
                    const auto strain = [&](const glm::dvec3& g) {
                        glm::dvec3 slope(0.0);
                        slope[i] += 0.5 * g[j];
                        slope[j] += 0.5 * g[i];
                        return slope;
                    };
                    add(strain, i == j ? 2.0 * mu : 4.0 * mu);
                }
            }
        }
    }

    glm::dvec3 position(std::uint32_t node) const { return glm::dvec3(model_.positions[node]); }

    const Model& model_;
    const ModelObject& object_;
    std::uint32_t part_;
    Assembly assembly_;
    CoarseMatrices result_;
};

bool is_free(const Model& model, const Range& nodes) {
    const auto first = model.positions.begin() + nodes.first;
    return std::all_of(first, first + nodes.count, [](const glm::vec4& p) { return p.w > 0.0f; });
}

// M R (R^T M R)^-1 R^T M, with M the inertia and R the motions of all clusters as one rigid body about the
// first one's middle.
Eigen::MatrixXd rigid_part(const CoarseBasis& basis, const Range& clusters, const Eigen::MatrixXd& inertia) {
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(inertia.rows(), 6);
    for (std::uint32_t k = 0; k < clusters.count; ++k) {
        const glm::dvec3 arm = basis.middles[clusters.first + k] - basis.middles[clusters.first];
        auto rows = motions.middleRows<6>(6 * static_cast<Eigen::Index>(k));
        rows.setIdentity();
        // r x arm
        rows.block<3, 3>(0, 3) << 0.0, arm.z, -arm.y, -arm.z, 0.0, arm.x, arm.y, -arm.x, 0.0;
    }
    const Eigen::MatrixXd moved = inertia * motions;
    return moved * (motions.transpose() * moved).ldlt().solve(moved.transpose());
}

CoarseMatrices object_matrices(const Model& model, const CoarseBasis& basis, std::size_t object) {
    CoarseMatrices matrices = ElementSums::nothing(basis, object);
    const Range& clusters = basis.objects[object];
    if (clusters.count == 0) return matrices;
    std::vector<CoarseMatrices> parts(kParts);
    tbb::parallel_for(std::uint32_t(0), kParts, [&](std::uint32_t part) {
        parts[part] = ElementSums(model, basis, object, part).sum();
    });
    for (const CoarseMatrices& part : parts) {
        matrices.inertia += part.inertia;
        matrices.elastic += part.elastic;
        matrices.viscous += part.viscous;
    }
    for (Eigen::MatrixXd* matrix : {&matrices.inertia, &matrices.elastic, &matrices.viscous})
        matrix->triangularView<Eigen::StrictlyUpper>() = matrix->transpose();
    if (is_free(model, model.objects[object].nodes))
        matrices.rigid = rigid_part(basis, clusters, matrices.inertia);
    return matrices;
}

}  // namespace

Eigen::MatrixXd CoarseMatrices::inverse(double step) const {
    const double against_rigid = kRigid * (elastic.trace() + viscous.trace() / step) / inertia.trace();
    Eigen::MatrixXd matrix = inertia / (step * step) + elastic + viscous / step + against_rigid * rigid;
    matrix.diagonal() *= 1.0 + kLeastStiffness;
    return matrix.ldlt().solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

std::vector<CoarseMatrices> make_coarse_matrices(const Model& model, const CoarseBasis& basis) {
    std::vector<CoarseMatrices> matrices(model.objects.size());
    tbb::parallel_for(std::size_t(0), matrices.size(),
                      [&](std::size_t o) { matrices[o] = object_matrices(model, basis, o); });
    return matrices;
}

}  // namespace gelatin
