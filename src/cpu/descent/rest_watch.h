#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contacts.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Tells when all bodies rest, so that steps may be left out until something moves (docs/contact.md).
template <class Real>
class RestWatch {
public:
    explicit RestWatch(std::shared_ptr<const Model> model);

    /// To be called when nodes were set from outside.
    void restart() { places_.clear(); }

    /// Whether no node has moved for a while, and nothing is about to move one.
    /// @param step that comes next [s] @param positions where it starts, with held nodes in their new places
    /// @param load_factors of the model's loads @param is_pulled whether a hand holds a body
    bool rests(double step, std::span<const Vec4<Real>> positions, std::span<const float> load_factors,
               bool is_pulled, const Contacts<Real>& contacts);

private:
    bool moves_handle(std::span<const Vec4<Real>> positions, const Contacts<Real>& contacts) const;
    bool leaves_place(std::span<const Vec4<Real>> positions, const Contacts<Real>& contacts) const;

    std::shared_ptr<const Model> model_;
    std::vector<Vec4<Real>> places_;  // that nodes have kept to; empty at the start
    double time_ = 0.0;               // for which they have [s]
    std::vector<float> load_factors_;
};

}  // namespace gelatin::cpu
