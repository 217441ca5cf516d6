#pragma once

#include <span>

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Springs, neo-Hookean tets, and nodes whose volume term counts.
struct ElasticParts {
    Range nodes, springs, tets;
};

/// The elastic energy of parts of a model [J], in double for any precision of the positions.
template <class Real>
double elastic_energy(const Model& model, const ElasticParts& parts, std::span<const Vec4<Real>> positions);

/// What flat tets of springs hold, which only implicit steps count [J].
template <class Real>
double flat_tet_energy(const Model& model, const Range& tets, std::span<const Vec4<Real>> positions);

/// The elastic energy of a body, with that of flat tets [J].
template <class Real>
double body_energy(const Model& model, const ModelObject& object, std::span<const Vec4<Real>> positions);

}  // namespace gelatin::cpu
