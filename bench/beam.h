#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"

namespace gelatin {

constexpr double kBeamStep = 0.01;  // [s]

/// SOFA's beam of 16 x 4 x 4 m along x, held at x = 0, under gravity of 9 m/s^2 across it, of one material.
struct BeamCase {
    std::string body;  ///< "tets" or "springs"
    std::shared_ptr<const Model> model;
};

/// The beam of tets (2000 Pa, nu 0.3, damped by 0.1 s, 50 kg) and of springs (2000 Pa, nu 0.25, undamped, 100
/// kg).
/// @param nodes along x, y and z, each >= 2
std::vector<BeamCase> beam_cases(glm::ivec3 nodes);

/// What SOFA's authors measured: 40 x 10 x 10 nodes, 1,000 steps of 20 iterations by conjugate gradients.
struct PublishedRate {
    const char *body, *device;
    double rate;  ///< [steps/s]
};
std::span<const PublishedRate> published_beam_rates();

}  // namespace gelatin
