#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/archive.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Tells when all bodies rest, so that steps may be left out until something moves (docs/contact.md).
template <class Real>
class RestWatch {
public:
    /// @param thicknesses of objects [m]
    RestWatch(std::shared_ptr<const Model> model, std::span<const double> thicknesses);

    /// To be called when nodes were set from outside.
    void restart() { places_.clear(); }
    void archive(Archive& archive);

    /// Whether no node has moved for a while, and nothing is about to move one.
    /// @param step that comes next [s] @param positions where it starts, with held nodes in their new places
    /// @param load_factors of the model's loads @param is_pulled whether a hand holds a body
    /// @param held_at where the last step left the held nodes [m], shape [Model::handle_nodes]
    bool rests(double step, std::span<const Vec4<Real>> positions, std::span<const float> load_factors,
               bool is_pulled, std::span<const Vec3<Real>> held_at);

private:
    bool moves_handle(std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> held_at) const;
    bool leaves_place(std::span<const Vec4<Real>> positions) const;

    std::shared_ptr<const Model> model_;
    std::vector<double> thicknesses_;
    std::vector<Vec4<Real>> places_;  // that nodes have kept to; empty at the start
    double time_ = 0.0;               // for which they have [s]
    std::vector<float> load_factors_;
};

}  // namespace gelatin::cpu
