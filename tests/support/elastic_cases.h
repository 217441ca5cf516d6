#pragma once

#include <string>
#include <vector>

#include "cpu/nodes.h"
#include "model/model.h"

/// Bodies of all elements, to hold the stiffness of a step against.
namespace gelatin::test {

struct ElasticCase {
    std::string name;  ///< of letters, digits and underscores
    Model model;
};

/// Springs and neo-Hookean tets, with and without the volume term and dampers.
std::vector<ElasticCase> elastic_cases();
/// A block of 504 nodes.
Model make_elastic_block(MaterialModel kind, double poisson_ratio, double damping = 0.0);

/// With an extent of 0.03 m, some tets of the cases are flat or inside out.
void shake_nodes(Model& model, float extent);

/// Normally distributed; the same numbers for float and double.
template <class Real>
std::vector<cpu::Vec3<Real>> random_field(std::size_t count, unsigned seed);

}  // namespace gelatin::test
