#include "cpu/descent/coarse_correction.h"

#include <tbb/parallel_for.h>

#include <utility>

#include "model/for_each_index.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {

template <class Real>
CoarseCorrection<Real>::CoarseCorrection(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      basis_(make_coarse_basis(*model_)),
      matrices_(make_coarse_matrices(*model_, basis_)),
      inverses_(matrices_.size()),
      clusters_(basis_.cluster_count()) {}

template <class Real>
void CoarseCorrection<Real>::begin(Real step, std::span<const Vec4<Real>> positions) {
    if (step != step_) {
        tbb::parallel_for(std::size_t(0), matrices_.size(), [&](std::size_t o) {
            if (moves(o))
                inverses_[o] = matrices_[o].inverse(static_cast<double>(step)).template cast<Real>();
        });
        step_ = step;
    }
    tbb::parallel_for(std::uint32_t(0), basis_.cluster_count(), [&](std::uint32_t k) {
        const std::span<const std::uint32_t> core = basis_.core_of(k);
        const Vec3<Real> origin(positions[core.front()]), rest_middle(basis_.middles[k]);
        glm::mat<3, 3, Real> moment(0);
        Vec3<Real> sum(0);
        Real mass(0);
        for (const std::uint32_t n : core) {
            const Real m = static_cast<Real>(model_->masses[n]);
            const Vec3<Real> x = Vec3<Real>(positions[n]) - origin;
            moment += glm::outerProduct(m * x, Vec3<Real>(model_->positions[n]) - rest_middle);
            sum += m * x;
            mass += m;
        }
        clusters_[k].middle = origin + sum / mass;
        clusters_[k].orientation = glm::mat<3, 3, Real>(nearest_rotation(glm::dmat3(moment)));
    });
}

template <class Real>
void CoarseCorrection<Real>::find_displacements(std::span<const Vec4<Real>> positions,
                                                std::span<const Vec3<Real>> forces,
                                                std::span<Vec3<Real>> displacements) {
    tbb::parallel_for(std::uint32_t(0), basis_.cluster_count(),
                      [&](std::uint32_t k) { gather(k, positions, forces); });
    tbb::parallel_for(std::size_t(0), inverses_.size(), [&](std::size_t o) {
        if (moves(o)) solve(o);
    });
    for_each_index(positions.size(), [&](std::size_t n) {
        const Vec3<Real> position(positions[n]);
        Vec3<Real> displacement(0);
        for (const CoarseBasis::Part& part : basis_.clusters_of(static_cast<std::uint32_t>(n))) {
            const Cluster& cluster = clusters_[part.index];
            displacement += static_cast<Real>(part.weight) *
                            (cluster.translation + glm::cross(cluster.rotation, position - cluster.middle));
        }
        displacements[n] = displacement;
    });
}

// What acts on the cluster, as it was at rest.
template <class Real>
void CoarseCorrection<Real>::gather(std::uint32_t index, std::span<const Vec4<Real>> positions,
                                    std::span<const Vec3<Real>> forces) {
    Cluster& cluster = clusters_[index];
    Vec3<Real> force(0), moment(0);
    for (const CoarseBasis::Part& part : basis_.nodes_of(index)) {
        const Vec3<Real> f = static_cast<Real>(part.weight) * forces[part.index];
        force += f;
        moment += glm::cross(Vec3<Real>(positions[part.index]) - cluster.middle, f);
    }
    cluster.force = force * cluster.orientation;
    cluster.moment = moment * cluster.orientation;
}

template <class Real>
void CoarseCorrection<Real>::solve(std::size_t object) {
    const Range& range = basis_.objects[object];
    Eigen::Matrix<Real, Eigen::Dynamic, 1> loads(6 * range.count);
    for (std::uint32_t k = 0; k < range.count; ++k) {
        const Cluster& c = clusters_[range.first + k];
        loads.template segment<6>(6 * k) << c.force.x, c.force.y, c.force.z, c.moment.x, c.moment.y,
            c.moment.z;
    }
    const Eigen::Matrix<Real, Eigen::Dynamic, 1> motions = inverses_[object] * loads;
    for (std::uint32_t k = 0; k < range.count; ++k) {
        Cluster& c = clusters_[range.first + k];
        const auto m = motions.template segment<6>(6 * k);
        c.translation = c.orientation * Vec3<Real>(m[0], m[1], m[2]);
        c.rotation = c.orientation * Vec3<Real>(m[3], m[4], m[5]);
    }
}

template class CoarseCorrection<float>;
template class CoarseCorrection<double>;

}  // namespace gelatin::cpu
