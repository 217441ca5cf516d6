#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "cpu/contact/tuning.h"
#include "cpu/implicit/island_rows.h"
#include "cpu/implicit/rigid_solve.h"
#include "cpu/implicit/step_system.h"
#include "cpu/object_pieces.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

/// The solve of one island of a StepSystem, which has all that is read and written. Newton's method: first on
/// rigid motions alone (RigidSolve), then on all nodes, with conjugate gradients, then on rigid motions again
/// until all bodies are in balance. Blocks precondition: those of nodes, and of bodies as rigid ones, with
/// what is glued to them (GluedNodes).
template <class Real>
class IslandSolve {
public:
    /// @param bodies of the island, ascending, and its rows; of its bodies no others have any
    /// @param pairs of these rows
    IslandSolve(StepSystem<Real>& system, std::span<const std::uint32_t> bodies, const Range& rows,
                std::span<const RowPair> pairs)
        : system_(system),
          bodies_(bodies.begin(), bodies.end()),
          nodes_(nodes_of(*system.model_, bodies)),
          first_row_(rows.first),
          rows_{std::span(system.rows).subspan(rows.first, rows.count),
                std::span(system.tangents_).subspan(rows.first, rows.count),
                std::span(system.row_forces_).subspan(rows.first, rows.count),
                std::span(system.slips_).subspan(rows.first, rows.count)},
          rigid_(*system.model_, system.rigid, free_ones(system.rigid, bodies), rows_, pairs) {
        for (const std::uint32_t o : bodies) places_.push_back(rigid_.place_of(o));
        for (std::uint32_t r = rows.first; r < rows.end(); ++r)
            has_glued_ = has_glued_ || system.glued_.node_of(r) != kNoNode;
    }

    /// @return what it has cost
    SolveCounts run() {
        find_slips();
        const std::vector<Vec3<Real>> expected(rows_.slips.begin(), rows_.slips.end());
        if (rows_.count() > 0) {  // elements hardly resist rigid motions
            nodes_.for_each([&](std::uint32_t n) {
                system_.base_[n] = system_.loads[n] - system_.inertia[n] * system_.displacements[n];
            });
            rigid_newton();
            const bool deforms = std::any_of(bodies_.begin(), bodies_.end(), [&](std::uint32_t o) {
                return !system_.model_->objects[o].is_rigid;
            });
            if (!deforms) return counts_;
        }
        nodes_.for_each([&](std::uint32_t n) {
            system_.elastic.displacements[n] = Vec4<Real>(system_.displacements[n], 0);
        });
        for (const std::uint32_t o : bodies_) system_.elastic.begin_product(system_.model_->objects[o]);
        find_base_residual();
        rows_.find_chords(expected);
        if (std::all_of(rows_.rows.begin(), rows_.rows.end(),
                        [](const auto& row) { return row.is_linear(); })) {
            newton_step(2 * system_.iterations, 0.0, true);
        } else {
            for (std::uint32_t k = 0; k < tuning::kMostLinearisations &&
                                      newton_step(system_.iterations, tuning::kSlightly, k == 0);
                 ++k)
                rows_.find_tangents();
        }
        rigid_newton();
        std::uint64_t nodes = 0;
        for (const std::uint32_t o : bodies_) nodes += system_.model_->objects[o].nodes.count;
        counts_.multiplied_nodes *= nodes;
        return counts_;
    }

private:
    void rigid_newton() {
        if (rigid_.count() == 0 || rows_.count() == 0) return;
        std::vector<Motion> begun(rigid_.count(), Motion::Zero());
        for (std::size_t k = 0; k < bodies_.size(); ++k)
            if (places_[k] != kNoNode && system_.model_->objects[bodies_[k]].is_rigid)
                begun[places_[k]] =
                    system_.rigid.rigid_part(bodies_[k], system_.inertia, system_.displacements);
        for_displacements(rigid_.run(gather_base(), begun),
                          [&](std::size_t n, const Vec3<Real>& d) { system_.displacements[n] += d; });
    }

    // W^T of what elements and inertia lack.
    std::vector<Motion> gather_base() const {
        std::vector<Motion> sums(rigid_.count(), Motion::Zero());
        nodes_.for_values(
            [&](const ObjectPieces::Piece& piece) -> Motion {
                glm::dvec3 force(0.0), moment(0.0);
                for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                    const glm::dvec3 r(system_.base_[n]);
                    force += r;
                    moment += glm::cross(glm::dvec3(system_.rigid.arm(n)), r);
                }
                return motion(force, moment);
            },
            [&](const ObjectPieces::Piece& piece, const Motion& part) {
                if (places_[piece.object] != kNoNode) sums[places_[piece.object]] += part;
            });
        return sums;
    }

    // With the product of the displacements begun.
    void find_base_residual() {
        ++counts_.multiplied_nodes;
        nodes_.for_each_piece([&](const ObjectPieces::Piece& piece) {
            system_.elastic.multiply(piece.range, system_.product_);
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                const Real inertia = system_.inertia[n];
                system_.base_[n] =
                    inertia > Real(0)
                        ? system_.loads[n] - (system_.product_[n] + inertia * system_.displacements[n])
                        : Vec3<Real>(0);
            }
        });
    }

    // A Newton step on all nodes, from the tangents that are set. @param is_first of this system
    // @return whether there was any to make
    bool newton_step(int most_iterations, double forcing, bool is_first) {
        prepare_preconditioner(!is_first);
        rows_.set_forces([&](std::size_t r) { return rows_.tangents[r].force(rows_.slips[r]); });
        nodes_.for_each([&](std::uint32_t n) {
            system_.residual_[n] =
                system_.inertia[n] > Real(0) ? system_.base_[n] + of_rows(n) : Vec3<Real>(0);
        });
        if (conjugate_gradients(most_iterations, forcing) == 0) return false;
        // A times the step, without rows: what the residual lost, less what rows did.
        std::vector<Vec3<Real>> changes(rows_.count());
        rows_.set_forces([&](std::size_t r) {
            changes[r] = relative<Real>(rows_.rows[r], system_.step_);
            return rows_.tangents[r].force(rows_.slips[r] + changes[r]);
        });
        glm::dvec2 sum(0.0);
        nodes_.for_values(
            [&](const ObjectPieces::Piece& piece) {
                glm::dvec2 of_piece(0.0);
                for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                    if (system_.inertia[n] == Real(0)) continue;
                    const Vec3<Real> step = system_.step_[n],
                                     resists = system_.base_[n] + of_rows(n) - system_.residual_[n];
                    system_.product_[n] = resists;
                    of_piece += glm::dvec2(glm::dot(step, system_.base_[n]), glm::dot(step, resists));
                }
                return of_piece;
            },
            [&](const ObjectPieces::Piece&, const glm::dvec2& more) { sum += more; });
        const auto part =
            static_cast<Real>(rows_.count() == 0 ? 1.0 : rows_.line_search(changes, sum.x, sum.y));
        nodes_.for_each([&](std::uint32_t n) {
            if (system_.inertia[n] == Real(0)) return;
            system_.displacements[n] += part * system_.step_[n];
            system_.base_[n] -= part * system_.product_[n];
        });
        find_slips();
        return true;
    }

    void prepare_preconditioner(bool only_rows) {
        const GluedNodes<Real>& glued = system_.glued_;
        felt_.assign(rows_.tangents.begin(), rows_.tangents.end());
        // What moves leaders moves what is glued to them.
        for (std::size_t r = 0; r < rows_.count(); ++r)
            if (const std::uint32_t n = glued.node_of(first_row_ + r); n != kNoNode)
                felt_[r].stiffness = block_of(n);
        const auto find_block = [&](std::uint32_t n) {
            const bool has_rows = system_.row_starts_[n] < system_.row_starts_[n + 1];
            if (system_.inertia[n] == Real(0) || (only_rows && !has_rows)) return;
            SymmetricMatrix<Real> block = block_of(n);
            if (const std::uint32_t row = glued.row_of(n); row != kNoNode) {
                block.diagonal += system_.tangents_[row].stiffness.diagonal;
                block.beside += system_.tangents_[row].stiffness.beside;
            }
            system_.inverse_blocks_[n] = inverse_of(block);
        };
        // Nodes of rigid bodies have no step of their own: their blocks stay 0, and what is left of
        // iterations are those in the space of rigid motions.
        nodes_.for_each_piece([&](const ObjectPieces::Piece& piece) {
            if (system_.model_->objects[bodies_[piece.object]].is_rigid) return;
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) find_block(n);
        });
        rigid_.find_matrix(felt_);
    }

    // Of A on its diagonal, but for what glues the node. Leaders of one node go together: of the matrix of
    // their weights the sums of rows, which are no less.
    SymmetricMatrix<Real> block_of(std::uint32_t node) const {
        SymmetricMatrix<Real> block = system_.elastic.diagonal()[node];
        block.add_identity(system_.inertia[node]);
        for (const auto [row, place] : system_.rows_at(node)) {
            if (row == system_.glued_.row_of(node)) continue;
            const Real weight = system_.rows[row].weights[place];
            const SymmetricMatrix<Real>& stiffness = felt_[row - first_row_].stiffness;
            Real share = weight * weight;
            if (system_.glued_.node_of(row) != kNoNode)
                share = std::abs(weight) * weight_of_leaders(system_.rows[row]);
            block.diagonal += share * stiffness.diagonal;
            block.beside += share * stiffness.beside;
        }
        return block;
    }

    // From no step, with the linear residual in residual_. A step makes one iteration at least: what elements
    // exert counts, however short it is.
    // @param forcing part of what is lacking at first that may be left @return iterations
    int conjugate_gradients(int count, double forcing) {
        bool is_enough = false;
        double rz = precondition([&](std::uint32_t n) { return system_.residual_[n]; }, is_enough);
        const double enough_of_all = forcing * rz;
        std::vector<Vec4<Real>>& p = system_.elastic.displacements;
        nodes_.for_each([&](std::uint32_t n) {  // held ones, too
            p[n] = Vec4<Real>(0);
            system_.step_[n] = Vec3<Real>(0);
        });
        Real b = 0;
        int k = 0;
        while (k < count && ((!is_enough && rz > enough_of_all) || (counts_.iterations == 0 && rz > 0.0))) {
            for_displacements(rigid_z_, [&](std::size_t n, const Vec3<Real>& rigid_part) {
                if (system_.inertia[n] > Real(0))
                    p[n] = Vec4<Real>(system_.z_[n] + rigid_part + b * Vec3<Real>(p[n]), 0);
            });
            ++counts_.iterations;
            const double curvature = multiply_direction();
            if (!(curvature > 0.0)) return k;
            ++k;
            const auto a = static_cast<Real>(rz / curvature);
            const double next = precondition(
                [&](std::uint32_t n) {
                    system_.step_[n] += a * Vec3<Real>(p[n]);
                    return system_.residual_[n] - a * system_.product_[n];
                },
                is_enough);
            b = static_cast<Real>(next / rz);
            rz = next;
        }
        return k;
    }

    // product_ = A p, rows among it. @return p . A p
    double multiply_direction() {
        ++counts_.multiplied_nodes;
        const std::vector<Vec4<Real>>& p = system_.elastic.displacements;
        rows_.set_forces(
            [&](std::size_t r) { return rows_.tangents[r].stiffness * relative<Real>(rows_.rows[r], p); });
        for (const std::uint32_t o : bodies_) system_.elastic.begin_product(system_.model_->objects[o]);
        double curvature = 0.0;
        nodes_.for_values(
            [&](const ObjectPieces::Piece& piece) {
                system_.elastic.multiply(piece.range, system_.product_);
                double sum = 0.0;
                for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                    if (system_.inertia[n] == Real(0)) continue;
                    const Vec3<Real> d(p[n]), all = system_.product_[n] + system_.inertia[n] * d + of_rows(n);
                    system_.product_[n] = all;
                    sum += static_cast<double>(glm::dot(d, all));
                }
                return sum;
            },
            [&](const ObjectPieces::Piece&, double sum) { curvature += sum; });
        return curvature;
    }

    // z = M^-1 r: z_ by nodes' blocks, and the rigid level. update(n): of free nodes, what residual_ becomes.
    // @param is_enough output: whether no body may lack more of its least energy than it should @return r . z
    template <class Update>
    double precondition(const Update& update, bool& is_enough) {
        struct Part {
            double lack = 0.0;  // r . z
            glm::dvec3 force{0.0}, moment{0.0};
        };
        if (has_glued_)  // before any of them is gathered
            nodes_.for_each([&](std::uint32_t n) {
                if (system_.inertia[n] > Real(0)) system_.residual_[n] = update(n);
            });
        std::vector<Part> parts(bodies_.size());
        nodes_.for_values(
            [&](const ObjectPieces::Piece& piece) {
                Part part;
                for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
                    if (system_.inertia[n] == Real(0)) continue;
                    if (!has_glued_) system_.residual_[n] = update(n);
                    const Vec3<Real> r = has_glued_ ? with_glued(n) : system_.residual_[n],
                                     z = system_.inverse_blocks_[n] * r;
                    system_.z_[n] = z;
                    part.lack += static_cast<double>(glm::dot(r, z));
                    if (system_.glued_.row_of(n) != kNoNode) continue;
                    const glm::dvec3 force(r);
                    part.force += force;
                    part.moment += glm::cross(glm::dvec3(system_.rigid.arm(n)), force);
                }
                return part;
            },
            [&](const ObjectPieces::Piece& piece, const Part& more) {
                Part& sum = parts[piece.object];
                sum.lack += more.lack;
                sum.force += more.force;
                sum.moment += more.moment;
            });
        std::vector<Motion> forces(rigid_.count());
        for (std::size_t k = 0; k < parts.size(); ++k)
            if (places_[k] != kNoNode) forces[places_[k]] = motion(parts[k].force, parts[k].moment);
        rigid_z_.resize(forces.size());
        if (has_glued_) {
            rigid_z_ = forces;
            rigid_.solve(rigid_z_, tuning::kRigidForcing);
            move_glued();
        } else {
            for (std::size_t b = 0; b < forces.size(); ++b) rigid_z_[b] = rigid_.precondition(b, forces[b]);
        }
        is_enough = true;
        double sum = 0.0;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const std::uint32_t b = places_[k];
            const double of_rigid = b == kNoNode ? 0.0 : forces[b].dot(rigid_z_[b]);
            sum += parts[k].lack + of_rigid;
            const double lack = parts[k].lack + std::max(of_rigid, 0.0);
            is_enough = is_enough && lack <= system_.enough[bodies_[k]];
        }
        return sum;
    }

    // The residual, as a force on all that a node takes along.
    Vec3<Real> with_glued(std::uint32_t node) const {
        Vec3<Real> r = system_.residual_[node];
        for (const auto [row, place] : system_.rows_at(node)) {
            const std::uint32_t glued = system_.glued_.node_of(row);
            if (glued != kNoNode && glued != node)
                r -= system_.rows[row].weights[place] * system_.residual_[glued];
        }
        return r;
    }

    // Adds to z what leaders take glued nodes along by, in place of the rigid motion of these nodes' own
    // body.
    void move_glued() {
        const auto by_body = [&](std::uint32_t object, std::uint32_t n) {
            const std::uint32_t b = rigid_.place_of(object);
            return b == kNoNode ? Vec3<Real>(0) : displacement(rigid_z_[b], system_.rigid.arm(n));
        };
        for_each_index(rows_.count(), [&](std::size_t r) {
            const std::uint32_t n = system_.glued_.node_of(first_row_ + r);
            if (n == kNoNode) return;
            const ContactRow<Real>& row = rows_.rows[r];
            Vec3<Real> z = system_.z_[n] - by_body(row.other, n);
            for (std::uint32_t k = 1; k < row.count; ++k) {
                const std::uint32_t j = row.nodes[k];
                if (system_.inertia[j] > Real(0))
                    z -= row.weights[k] * (system_.z_[j] + by_body(row.object, j));
            }
            system_.z_[n] = z;
        });
    }

    // use(node, displacement [m]) for all nodes; 0 for bodies that are not free.
    template <class Use>
    void for_displacements(std::span<const Motion> motions, const Use& use) const {
        nodes_.for_each_piece([&](const ObjectPieces::Piece& piece) {
            const std::uint32_t b = places_[piece.object];
            const Motion motion = b == kNoNode ? Motion(Motion::Zero()) : motions[b];
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n)
                use(n, displacement(motion, system_.rigid.arm(n)));
        });
    }

    // What rows add to the forces on a node.
    Vec3<Real> of_rows(std::uint32_t node) const {
        Vec3<Real> sum(0);
        for (const auto [row, place] : system_.rows_at(node)) {
            sum += system_.rows[row].weights[place] * system_.row_forces_[row];
        }
        return sum;
    }

    void find_slips() const {
        for_each_index(rows_.count(), [&](std::size_t r) {
            rows_.slips[r] = slip<Real>(rows_.rows[r], system_.displacements);
        });
    }

    // The sum of the sizes of the weights of those that a glued node follows.
    static Real weight_of_leaders(const ContactRow<Real>& row) {
        Real sum = 0;
        for (std::uint32_t k = 1; k < row.count; ++k) sum += std::abs(row.weights[k]);
        return sum;
    }

    static std::vector<Range> nodes_of(const Model& model, std::span<const std::uint32_t> bodies) {
        std::vector<Range> ranges;
        for (const std::uint32_t o : bodies) ranges.push_back(model.objects[o].nodes);
        return ranges;
    }

    static std::vector<std::uint32_t> free_ones(const RigidLevel<Real>& rigid,
                                                std::span<const std::uint32_t> bodies) {
        std::vector<std::uint32_t> some;
        std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(some),
                     [&](std::uint32_t o) { return rigid.is_free(o); });
        return some;
    }

    StepSystem<Real>& system_;
    std::vector<std::uint32_t> bodies_;  // objects
    std::vector<std::uint32_t> places_;  // of each body among the free ones, or kNoNode
    ObjectPieces nodes_;                 // by body
    std::uint32_t first_row_;
    bool has_glued_ = false;
    IslandRows<Real> rows_;
    std::vector<RowTangent<Real>> felt_;  // tangents, but of glue what leaders feel: the glued node
    RigidSolve<Real> rigid_;
    std::vector<Motion> rigid_z_;  // what z has beside z_, of the rigid level
    SolveCounts counts_;
};

}  // namespace gelatin::cpu
