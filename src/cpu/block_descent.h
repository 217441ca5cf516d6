#pragma once

#include <memory>
#include <vector>

#include "cpu/nodes.h"
#include "cpu/spring_hessian.h"
#include "model/model.h"
#include "model/node_colors.h"

namespace gelatin::cpu {

/// Vertex block descent (Chen et al. 2024): a step of implicit Euler as the minimum of
///   G(x) = sum_i m_i / (2 h^2) |x_i - y_i|^2 + E(x),   y = x_t + h v_t + h^2 g,
/// found node by node, each by one Newton step on its own three coordinates, all nodes of one colour at once.
/// Between the sweeps and after the last one, bodies that nothing holds move as rigid ones to where G is
/// least: that keeps their momentum, which sweeps alone lose (docs/physics.md). The same bits for any number
/// of threads. GPU twin: gpu::BlockDescent.
template <class Real>
class BlockDescent {
public:
    BlockDescent(std::shared_ptr<const Model> model, int iterations);

    /// A step of `step` seconds from `previous` to `current`; of this only positions are read, where the
    /// fourth components are.
    void run(Real step, const Nodes<Real>& previous, Nodes<Real>& current);

private:
    struct Step;
    void guess(const Step& step, Nodes<Real>& current);
    void sweep(const Step& step, std::vector<Vec4<Real>>& positions);
    void move_rigidly(const Step& step, std::uint32_t object, std::vector<Vec4<Real>>& positions) const;
    void finish(const Step& step, Nodes<Real>& current) const;

    std::vector<std::uint32_t> hack_starts_, hack_tets_;
    std::vector<double> hack_volumes_;
    double hack_e_ = 0;
public:
    static std::vector<glm::vec4>& hack_rest() { static std::vector<glm::vec4> r; return r; }
private:
    std::shared_ptr<const Model> model_;
    int iterations_;
    NodeColors colors_;
    std::vector<bool> is_free_;  // objects without pins
    std::vector<std::uint8_t> touches_;  // nodes that met a collider in this step
};

}  // namespace gelatin::cpu
