#include "support/elastic_cases.h"

#include <random>

#include "support/test_models.h"

namespace gelatin::test {

Model make_elastic_block(MaterialModel kind, double poisson_ratio, double damping) {
    Material material;
    material.model = kind;
    material.youngs_modulus = 1e5;
    material.poisson_ratio = poisson_ratio;
    material.damping = damping;
    // 504 nodes, and several tasks of tets.
    return make_model(make_body(make_block({6, 7, 8}, {0.6, 0.7, 0.8}, 0.2), material));
}

std::vector<ElasticCase> elastic_cases() {
    const auto springs = MaterialModel::mass_spring, neo_hookean = MaterialModel::neo_hookean;
    return {{"springs", make_elastic_block(springs, 0.25)},
            {"springs_with_a_volume_term", make_elastic_block(springs, 0.4)},
            {"springs_with_a_volume_term_that_is_negative", make_elastic_block(springs, 0.1)},
            {"damped_springs", make_elastic_block(springs, 0.4, 0.01)},
            {"neo_hookean", make_elastic_block(neo_hookean, 0.3)},
            {"neo_hookean_with_a_volume_term", make_elastic_block(neo_hookean, 0.45)},
            {"damped_neo_hookean", make_elastic_block(neo_hookean, 0.45, 0.01)},
            {"both", make_lively_tets(0.0)},
            {"both_damped", make_lively_tets(0.01)}};
}

void shake_nodes(Model& model, float extent) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-extent, extent);
    for (glm::vec4& p : model.positions) p += glm::vec4(unit(random), unit(random), unit(random), 0.0f);
}

template <class Real>
std::vector<cpu::Vec3<Real>> random_field(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::vector<cpu::Vec3<Real>> field;
    for (std::size_t n = 0; n < count; ++n) {
        const float x = normal(random), y = normal(random), z = normal(random);
        field.emplace_back(x, y, z);
    }
    return field;
}

template std::vector<cpu::Vec3<float>> random_field(std::size_t count, unsigned seed);
template std::vector<cpu::Vec3<double>> random_field(std::size_t count, unsigned seed);

}  // namespace gelatin::test
