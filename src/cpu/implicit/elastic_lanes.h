#pragma once

#include <cstddef>
#include <span>

#include "cpu/elasticity/elements.h"
#include "cpu/implicit/elastic_arrays.h"
#include "cpu/nodes.h"

/// The passes of ElasticSystem<float>, each over a group of kGroup, with SIMD for the processor they run on.
namespace gelatin::cpu {

/// The nodes where a step begins.
struct ElasticStart {
    const Vec4<float>*positions, *velocities;
    float inverse_step;  ///< [1/s]
};

/// ElasticArrays::tet_volumes.
void find_tet_volumes(const ElasticStart& start, std::size_t group, ElasticArrays& arrays);
/// What a group of tets adds to forces and matrices, from `points` if there is a volume term.
void linearise_tets(const ElasticStart& start, std::size_t group, ElasticArrays& arrays);
/// M of a group of edges.
void sum_edges(std::size_t group, ElasticArrays& arrays);
/// The springs of a group of nodes, their forces and what K has on its diagonal.
void linearise_nodes(const ElasticStart& start, std::size_t group, ElasticArrays& arrays, Vec3<float>* forces,
                     SymmetricMatrix<float>* diagonal);
/// K d of some nodes. @param displacements d, xyz; shape [nodes], like the product
void multiply_nodes(const Range& nodes, const ElasticArrays& arrays, const Vec4<float>* displacements,
                    Vec3<float>* product);

}  // namespace gelatin::cpu
