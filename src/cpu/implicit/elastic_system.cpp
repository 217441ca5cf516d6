#include "cpu/implicit/elastic_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/implicit/elastic_lanes.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// The largest singular value of F is at most this: the root of the largest sum of a row of F^T F
// (Gershgorin).
template <class Real>
Real largest_stretch(const Mat3<Real>& f) {
    Real most = 0;
    for (int i = 0; i < 3; ++i) {
        Real sum = 0;
        for (int j = 0; j < 3; ++j) sum += std::abs(glm::dot(f[i], f[j]));
        most = std::max(most, sum);
    }
    return std::sqrt(most);
}

// Sum of w . K w over the rotations w about three axes, of 1 rad each [J]. @param product shape [nodes]
template <class Real>
double resistance_to_rotations(ElasticSystem<Real>& system, const ModelObject& body,
                               std::span<const Vec4<Real>> positions, std::span<Vec3<Real>> product) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3<Real> w(0);
        w[axis] = Real(1);
        const auto each = [&](const auto& visit) {
            for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); ++n) visit(n);
        };
        each([&](std::uint32_t n) {
            const Vec3<Real> arm(positions[n] - positions[body.nodes.first]);
            system.displacements[n] = Vec4<Real>(glm::cross(w, arm), 0);
        });
        system.begin_product(body);
        system.multiply(body.nodes, product);
        each([&](std::uint32_t n) {
            sum += static_cast<double>(glm::dot(Vec3<Real>(system.displacements[n]), product[n]));
            system.displacements[n] = Vec4<Real>(0);
        });
    }
    return sum;
}

// Once all else is linearised.
template <class Real>
void balance_cavities(ElasticSystem<Real>& system, CavityElements<Real>& cavities, const Model& model,
                      std::span<const Vec4<Real>> positions) {
    if (model.cavities.empty()) return;
    std::vector<Vec3<Real>> product(model.node_count());
    for_each_index(0, model.body_count(), 1, [&](std::size_t o) {
        const ModelObject& body = model.objects[o];
        if (body.cavities.count > 0)
            cavities.balance_rotations(body,
                                       resistance_to_rotations(system, body, positions, std::span(product)));
    });
}

}  // namespace

template <class Real>
ElasticSystem<Real>::ElasticSystem(std::shared_ptr<const Model> model)
    : displacements(model->node_count()),
      model_(std::move(model)),
      node_tets_(make_node_tets(model_->node_count(), model_->tets)),
      spring_starts_(model_->node_count() + 1),
      half_springs_(2 * model_->springs.size()),
      neo_hookean_(model_->neo_hookean_tets.size()),
      corner_forces_(4 * neo_hookean_.size()),
      forces_(model_->node_count()),
      diagonal_(model_->node_count()),
      cavities_(model_) {
    std::copy(model_->incidence.starts.begin(), model_->incidence.starts.end(), spring_starts_.begin());
    for (std::size_t e = 0; e < half_springs_.size(); ++e) {
        const std::uint32_t entry = model_->incidence.entries[e];
        const Spring& spring = model_->springs[entry / 2];
        half_springs_[e].other = entry % 2 == 0 ? spring.j : spring.i;
    }
    slopes_.resize(4 * model_->tets.size());
    slope_weights_.resize(model_->tets.size());
    tet_pressures_.resize(model_->tets.size());
    tet_values_.resize(model_->tets.size());
    ratios_.resize(model_->tets.size());
    if (!model_->volume_term.is_empty()) node_pressures_.resize(model_->node_count());
}

template <class Real>
void ElasticSystem<Real>::linearise(std::span<const Vec4<Real>> positions,
                                    std::span<const Vec4<Real>> velocities, Real inverse_step,
                                    std::span<const double> drives) {
    linearise_springs(positions, velocities, inverse_step);
    linearise_volumes(positions);
    linearise_neo_hookean(positions, velocities, inverse_step);
    for_each_index(model_->node_count(), [&](std::size_t n) {
        for (std::uint32_t e = node_tets_.starts[n]; e < node_tets_.starts[n + 1]; ++e) {
            const std::uint32_t entry = node_tets_.entries[e];
            forces_[n] -= tet_pressures_[entry / 4] * slopes_[entry];
            diagonal_[n].add_outer(slope_weights_[entry / 4], slopes_[entry]);
        }
    });
    cavities_.linearise(positions, drives);
    cavities_.add(forces_, diagonal_);
    balance_cavities(*this, cavities_, *model_, positions);
    if (neo_hookean_.empty()) return;
    const NodeTets& corners = model_->neo_hookean_corners;
    for_each_index(model_->node_count(), [&](std::size_t n) {
        for (std::uint32_t e = corners.starts[n]; e < corners.starts[n + 1]; ++e) {
            const std::uint32_t entry = corners.entries[e];
            const TetStiffness& tet = neo_hookean_[entry / 4];
            const Vec3<Real> g = shape_gradient<Real>(model_->neo_hookean_tets[entry / 4], entry % 4);
            const Vec3<Real> stretched = tet.gradient * g;
            forces_[n] += corner_forces_[entry];
            SymmetricMatrix<Real>& block = diagonal_[n];
            block.add_identity(tet.shear * glm::dot(g, g));
            block.add_outer(tet.stretch, stretched);
            block.add_outer(tet.volume, tet.cofactor * g);
            if (!(tet.viscosity > Real(0))) continue;
            const TetModuli<Real> moduli = tet_moduli<Real>(model_->neo_hookean_tets[entry / 4]);
            for (int k = 0; k < 3; ++k)
                block.add_outer(Real(0.75) * moduli.mu * tet.viscosity * glm::dot(g, g), tet.gradient[k]);
            block.add_outer(tet.viscosity * (moduli.lambda + Real(0.125) * moduli.mu), stretched);
        }
    });
}

// A damper over a step makes of a spring another one, as cpu::damped_spring says.
template <class Real>
void ElasticSystem<Real>::linearise_springs(std::span<const Vec4<Real>> positions,
                                            std::span<const Vec4<Real>> velocities, Real inverse_step) {
    for_each_index(model_->node_count(), [&](std::size_t n) {
        NodeTerms<Real> terms;
        for (std::uint32_t e = spring_starts_[n]; e < spring_starts_[n + 1]; ++e) {
            HalfSpring& half = half_springs_[e];
            const Spring& spring = model_->springs[model_->incidence.entries[e] / 2];
            const Vec3<Real> apart(positions[half.other] - positions[n]);
            const Real inverse = inverse_length<Real>(apart);
            const Real damping = Real(0.5) * (velocities[n].w + velocities[half.other].w) * inverse_step;
            const SpringLaw<Real> law = damped_spring<Real>(
                {static_cast<Real>(spring.rest_length), static_cast<Real>(spring.stiffness)},
                Real(1) / inverse, damping);
            const Real pull = law.stiffness - law.stiffness * law.rest_length * inverse;
            half.across = std::max(pull, Real(0));
            half.stretch = std::sqrt(law.stiffness - half.across) * inverse * apart;
            terms.force += pull * apart;
            terms.hessian.add_identity(half.across);
            terms.hessian.add_outer(Real(1), half.stretch);
        }
        forces_[n] = terms.force;
        diagonal_[n] = terms.hessian;
    });
}

// Of each tet the bound of the volume term (cpu/elasticity/tet_volume.inl), and what resists being flat.
template <class Real>
void ElasticSystem<Real>::linearise_volumes(std::span<const Vec4<Real>> positions) {
    const Model& model = *model_;
    for_each_index(model.tets.size(), [&](std::size_t t) {
        const glm::uvec4& tet = model.tets[t];
        const Real inverse = Real(1) / (Real(6) * static_cast<Real>(model.tet_rests[t].volume));
        const auto at = [&](int k) { return Vec3<Real>(positions[tet[k]]); };
        for (int c = 0; c < 4; ++c) {
            const auto& others = kOppositeCorners[c];
            slopes_[4 * t + static_cast<std::size_t>(c)] =
                volume_slope(at(others[1]) - at(others[0]), at(others[2]) - at(others[0]), inverse);
        }
        ratios_[t] = glm::dot(at(0) - at(1), slopes_[4 * t]);
    });
    if (!node_pressures_.empty()) {
        const VolumeTerm& term = model.volume_term;
        for_each_index(model.node_count(), [&](std::size_t n) {
            Real volume = 0;
            for (std::uint32_t e = node_tets_.starts[n]; e < node_tets_.starts[n + 1]; ++e) {
                const std::uint32_t t = node_tets_.entries[e] / 4;
                volume += Real(0.25) * ratios_[t] * static_cast<Real>(model.tet_rests[t].volume);
            }
            const glm::vec<2, Real> rest(term.nodes[n]);
            node_pressures_[n] = rest.x > Real(0) ? volume_stress(volume / rest.x, rest.y) : Real(0);
        });
    }
    for_each_index(model.tets.size(), [&](std::size_t t) {
        const TetRest& rest = model.tet_rests[t];
        const auto volume = static_cast<Real>(rest.volume);
        Real pressure = 0, weight = 0;
        if (!node_pressures_.empty()) {
            Real sum = 0;
            for (int k = 0; k < 4; ++k) sum += node_pressures_[model.tets[t][k]];
            pressure = Real(0.25) * volume * sum;
            weight = volume * static_cast<Real>(model.volume_term.tets[t]);
        }
        if (const Real lack = Real(kFlattest) - ratios_[t]; lack > Real(0)) {
            const Real stiffness = volume * static_cast<Real>(rest.modulus);
            pressure -= stiffness * lack;
            weight += stiffness;
        }
        tet_pressures_[t] = pressure;
        slope_weights_[t] = weight;
    });
}

// The second derivative of a tet's energy is
//   shear dF + pressure d cof F + 2 mu / (I + 1)^2 F (F : dF) + lambda cof F (cof F : dF)
// with the factors of NeoHookeanStress. d cof F has no sign of its own: limited to what `shear` outweighs,
// whichever way a tet is stretched, the sum is not negative. At rest that is all of it, so rotations are
// free.
template <class Real>
void ElasticSystem<Real>::linearise_neo_hookean(std::span<const Vec4<Real>> positions,
                                                std::span<const Vec4<Real>> velocities, Real inverse_step) {
    for_each_index(neo_hookean_.size(), [&](std::size_t t) {
        const NeoHookeanTet& tet = model_->neo_hookean_tets[t];
        const TetModuli<Real> moduli = tet_moduli<Real>(tet);
        TetStiffness& out = neo_hookean_[t];
        const Mat3<Real> f = gradient_of(tet, at_corners(tet, positions.data()));
        out.gradient = f;
        out.cofactor = cofactor<Real>(f);
        const Real squares = double_dot(f, f), ratio = glm::dot(f[0], out.cofactor[0]);
        const Real inverse = Real(1) / (squares + Real(1));
        const NeoHookeanStress<Real> stress = neo_hookean_stress(squares, inverse, ratio, moduli);
        out.shear = stress.shear;
        out.stretch = Real(2) * moduli.mu * inverse * inverse;
        out.volume = moduli.lambda;
        const Real most = stress.shear / std::max(largest_stretch<Real>(f), Real(1e-6));
        out.pressure = std::clamp(stress.pressure, -most, most);
        const Real damping_time = mean_damping_time(tet, velocities.data());
        out.viscosity = damping_time * inverse_step * viscous_share(squares);
        for (std::uint32_t c = 0; c < 4; ++c) {
            const Vec3<Real> g = shape_gradient<Real>(tet, c);
            corner_forces_[4 * t + c] = -(stress.shear * (f * g) + stress.pressure * (out.cofactor * g)) +
                                        opening_force(g, squares, moduli.mu);
        }
    });
}

template <class Real>
void ElasticSystem<Real>::begin_product(const ModelObject& body) {
    cavities_.begin_product(body, displacements);
    const Model& model = *model_;
    const auto at = [&](std::uint32_t n) { return Vec3<Real>(displacements[n]); };
    for_each_index(body.tets, [&](std::uint32_t t) {
        Real sum = 0;
        for (int c = 0; c < 4; ++c)
            sum += glm::dot(slopes_[4 * t + static_cast<std::uint32_t>(c)], at(model.tets[t][c]));
        tet_values_[t] = slope_weights_[t] * sum;
    });
    for_each_index(body.neo_hookean_tets, [&](std::uint32_t t) {
        const NeoHookeanTet& tet = model.neo_hookean_tets[t];
        const TetStiffness& k = neo_hookean_[t];
        const Mat3<Real> df =
            gradient_of<Real>(tet, {at(tet.node_0), at(tet.node_1), at(tet.node_2), at(tet.node_3)});
        const Mat3<Real>& f = k.gradient;
        const Mat3<Real> dcof(glm::cross(df[1], f[2]) + glm::cross(f[1], df[2]),
                              glm::cross(df[2], f[0]) + glm::cross(f[2], df[0]),
                              glm::cross(df[0], f[1]) + glm::cross(f[0], df[1]));
        Mat3<Real> stress = k.shear * df + k.pressure * dcof + (k.stretch * double_dot(f, df)) * f +
                            (k.volume * double_dot(k.cofactor, df)) * k.cofactor;
        for (std::uint32_t c = 1; c < 4; ++c) {
            const Vec3<Real> g = shape_gradient<Real>(tet, c);
            Vec3<Real> force = stress * g;
            if (k.viscosity > Real(0))
                force += k.viscosity * (f * viscous_traction<Real>(g, f, df, tet_moduli<Real>(tet)));
            corner_forces_[4 * t + c] = force;
        }
        corner_forces_[4 * t] =
            -(corner_forces_[4 * t + 1] + corner_forces_[4 * t + 2] + corner_forces_[4 * t + 3]);
    });
}

template <class Real>
void ElasticSystem<Real>::multiply(const Range& nodes, std::span<Vec3<Real>> product) const {
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const Vec3<Real> own(displacements[n]);
        Vec3<Real> sum(0);
        for (std::uint32_t e = spring_starts_[n]; e < spring_starts_[n + 1]; ++e) {
            const HalfSpring& half = half_springs_[e];
            const Vec3<Real> change = own - Vec3<Real>(displacements[half.other]);
            sum += half.across * change + glm::dot(half.stretch, change) * half.stretch;
        }
        for (std::uint32_t e = node_tets_.starts[n]; e < node_tets_.starts[n + 1]; ++e)
            sum += tet_values_[node_tets_.entries[e] / 4] * slopes_[node_tets_.entries[e]];
        if (!neo_hookean_.empty()) {
            const NodeTets& corners = model_->neo_hookean_corners;
            for (std::uint32_t e = corners.starts[n]; e < corners.starts[n + 1]; ++e)
                sum += corner_forces_[corners.entries[e]];
        }
        product[n] = sum;
    }
    cavities_.multiply(nodes, displacements, product);
}

template class ElasticSystem<double>;

ElasticSystem<float>::ElasticSystem(std::shared_ptr<const Model> model)
    : displacements(model->node_count()),
      model_(std::move(model)),
      arrays_(*model_),
      left_out_nodes_(arrays_.groups.size()),
      left_out_tets_(arrays_.tets.size()),
      forces_(model_->node_count()),
      diagonal_(model_->node_count()),
      cavities_(model_) {}

void ElasticSystem<float>::leave_out(std::span<const std::uint8_t> asleep) {
    const auto is_asleep = [&](std::uint32_t node) {
        const std::uint32_t object = model_->node_objects[node];
        return object < asleep.size() && asleep[object] != 0;
    };
    for (std::size_t g = 0; g < left_out_nodes_.size(); ++g)
        left_out_nodes_[g] = is_asleep(arrays_.groups[g].first) ? 1 : 0;
    for (std::size_t g = 0; g < left_out_tets_.size(); ++g) {
        const auto& nodes = arrays_.tets[g].nodes[0];
        left_out_tets_[g] = std::all_of(std::begin(nodes), std::end(nodes), is_asleep) ? 1 : 0;
    }
}

void ElasticSystem<float>::linearise(std::span<const Vec4<float>> positions,
                                     std::span<const Vec4<float>> velocities, float inverse_step,
                                     std::span<const double> drives) {
    arrays_.is_damped =
        std::any_of(velocities.begin(), velocities.end(), [](const auto& v) { return v.w > 0.0f; });
    const ElasticStart start{positions.data(), velocities.data(), inverse_step};
    const auto for_each_group = [](std::size_t count, const auto& visit) {
        constexpr std::size_t kGrain = 32;
        for_each_index(0, count, kGrain, visit);
    };
    if (arrays_.has_volume_term) {
        for_each_group(arrays_.tets.size(), [&](std::size_t g) {
            if (left_out_tets_[g] == 0) find_tet_volumes(start, g, arrays_);
        });
        find_points(positions);
    }
    for_each_group(arrays_.tets.size(), [&](std::size_t g) {
        if (left_out_tets_[g] == 0) linearise_tets(start, g, arrays_);
    });
    arrays_.has_matrices =
        !model_->neo_hookean_tets.empty() ||
        std::any_of(arrays_.resists.begin(), arrays_.resists.end(), [](auto r) { return r != 0; });
    if (arrays_.has_matrices)
        for_each_group(arrays_.edges.size(), [&](std::size_t g) { sum_edges(g, arrays_); });
    for_each_group(arrays_.groups.size(), [&](std::size_t g) {
        if (left_out_nodes_[g] == 0) linearise_nodes(start, g, arrays_, forces_.data(), diagonal_.data());
    });
    cavities_.linearise(positions, drives);
    cavities_.add(forces_, diagonal_);
    balance_cavities(*this, cavities_, *model_, positions);
}

// The volume term's stress, as above.
void ElasticSystem<float>::find_points(std::span<const Vec4<float>> positions) {
    for_each_index(arrays_.node_count, [&](std::size_t n) {
        float volume = 0.0f;
        for (std::uint32_t e = arrays_.node_tets.starts[n]; e < arrays_.node_tets.starts[n + 1]; ++e)
            volume += arrays_.tet_volumes[arrays_.node_tets.entries[e] / 4];
        const glm::vec2& rest = model_->volume_term.nodes[n];
        const float stress = rest.x > 0.0f ? volume_stress(volume / rest.x, rest.y) : 0.0f;
        arrays_.points[n] = glm::vec4(Vec3<float>(positions[n]), stress);
    });
}

void ElasticSystem<float>::multiply(const Range& nodes, std::span<Vec3<float>> product) const {
    multiply_nodes(nodes, arrays_, displacements.data(), product.data());
    cavities_.multiply(nodes, displacements, product);
}

}  // namespace gelatin::cpu
