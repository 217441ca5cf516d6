#pragma once

#include <array>
#include <utility>

#include "gelatin/scene.h"

namespace gelatin::python {

/// The names of an enumeration's values, as in scene files.
template <class Enum>
struct Names;

template <>
struct Names<SolverKind> {
    static constexpr std::array<std::pair<const char*, SolverKind>, 6> kAll{
        {{"explicit_euler", SolverKind::explicit_euler},
         {"semi_implicit_euler", SolverKind::semi_implicit_euler},
         {"midpoint", SolverKind::midpoint},
         {"rk4", SolverKind::rk4},
         {"implicit", SolverKind::implicit},
         {"vbd", SolverKind::implicit}}};
};
template <>
struct Names<ForceMethod> {
    static constexpr std::array<std::pair<const char*, ForceMethod>, 2> kAll{
        {{"divide_and_merge", ForceMethod::divide_and_merge}, {"fused", ForceMethod::fused}}};
};
template <>
struct Names<BroadPhase> {
    static constexpr std::array<std::pair<const char*, BroadPhase>, 4> kAll{
        {{"none", BroadPhase::none},
         {"boxes", BroadPhase::boxes},
         {"hierarchy", BroadPhase::hierarchy},
         {"depth", BroadPhase::depth}}};
};
template <>
struct Names<CollisionDetection> {
    static constexpr std::array<std::pair<const char*, CollisionDetection>, 2> kAll{
        {{"discrete", CollisionDetection::discrete}, {"continuous", CollisionDetection::continuous}}};
};
template <>
struct Names<CollisionResponse> {
    static constexpr std::array<std::pair<const char*, CollisionResponse>, 2> kAll{
        {{"restore", CollisionResponse::restore}, {"contact", CollisionResponse::contact}}};
};
template <>
struct Names<Axis> {
    static constexpr std::array<std::pair<const char*, Axis>, 3> kAll{
        {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}}};
};
template <>
struct Names<MaterialModel> {
    static constexpr std::array<std::pair<const char*, MaterialModel>, 2> kAll{
        {{"mass_spring", MaterialModel::mass_spring}, {"neo_hookean", MaterialModel::neo_hookean}}};
};
template <>
struct Names<MesherKind> {
    static constexpr std::array<std::pair<const char*, MesherKind>, 3> kAll{
        {{"auto", MesherKind::automatic}, {"tetgen", MesherKind::tetgen}, {"lattice", MesherKind::lattice}}};
};
template <>
struct Names<GasLaw> {
    static constexpr std::array<std::pair<const char*, GasLaw>, 2> kAll{
        {{"sealed", GasLaw::sealed}, {"constant", GasLaw::constant}}};
};
template <>
struct Names<Interpolation> {
    static constexpr std::array<std::pair<const char*, Interpolation>, 2> kAll{
        {{"linear", Interpolation::linear}, {"smooth", Interpolation::smooth}}};
};
template <>
struct Names<WhenBlocked> {
    static constexpr std::array<std::pair<const char*, WhenBlocked>, 2> kAll{
        {{"goes_on", WhenBlocked::goes_on}, {"stops", WhenBlocked::stops}}};
};

}  // namespace gelatin::python
