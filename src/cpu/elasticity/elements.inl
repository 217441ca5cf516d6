// The formulas of elements, each once, for any scalar. cpu/elasticity/elements.h includes them for float and
// double, cpu/elasticity/elements-inl.h for lanes of floats, once for each instruction set. Both provide
// Vec3<Real> and Mat3<Real> (of columns) with their operators, dot and cross, and what cpu/scalars.h has.
// Constructors are written out: those that compilers make themselves are not compiled for the instruction
// set.

#include "cpu/elasticity/node_terms.inl"

#include "cpu/elasticity/point_spring.inl"

#include "cpu/elasticity/spring.inl"

#include "cpu/elasticity/tet_volume.inl"

#include "cpu/elasticity/neo_hookean.inl"
