#pragma once

#include <vector>

#include "model/model.h"

namespace gelatin {

/// Of values of a model's handles, those of the scene's: but for pins of programs. Checkpoints and recordings
/// have these. @param values shape [Model::handles], or empty
template <class T>
std::vector<T> of_own_handles(const Model& model, const std::vector<T>& values) {
    std::vector<T> own;
    for (std::size_t h = 0; h < values.size(); ++h)
        if (!model.handles[h].is_added) own.push_back(values[h]);
    return own;
}

/// The reverse. @param present values of all, of which those of pins of programs stay
template <class T>
std::vector<T> with_own_handles(const Model& model, const std::vector<T>& own, std::vector<T> present) {
    auto next = own.begin();
    for (std::size_t h = 0; h < present.size(); ++h)
        if (!model.handles[h].is_added) present[h] = *next++;
    return present;
}

}  // namespace gelatin
