#include "mesh/lattice/cut_tet.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "mesh/tet_quality.h"

namespace gelatin::lattice {
namespace {

// A quadrilateral's side that starts at an inner node, or a prism's edge between its two triangles.
struct Rail {
    std::uint32_t from, to;
};

class TetCutter {
public:
    TetCutter(const std::vector<glm::dvec3>& positions, std::vector<glm::uvec4>& tets)
        : positions_(positions), tets_(tets) {}

    void add(const glm::uvec4& tet) { tets_.push_back(tet); }

    // Nearer to its cut: where a diagonal of the two rails' quadrilateral starts.
    bool comes_first(const Rail& a, const Rail& b) const {
        const double la = glm::distance(positions_[a.from], positions_[a.to]);
        const double lb = glm::distance(positions_[b.from], positions_[b.to]);
        return std::tie(la, a.from) < std::tie(lb, b.from);
    }

    // The prism between three rails; diagonals go from the start of each rail to the end of a later one.
    static std::array<glm::uvec4, 3> prism(const Rail& a, const Rail& b, const Rail& c) {
        return {glm::uvec4(a.from, b.from, c.from, c.to), glm::uvec4(a.from, b.from, b.to, c.to),
                glm::uvec4(a.from, a.to, b.to, c.to)};
    }
    void add(const std::array<glm::uvec4, 3>& tets) { tets_.insert(tets_.end(), tets.begin(), tets.end()); }

    double worst(const std::array<glm::uvec4, 3>& tets) const {
        double least = 1.0;
        for (const glm::uvec4& t : tets) {
            least = std::min(least, std::abs(worst_sine(positions_[t[0]], positions_[t[1]], positions_[t[2]],
                                                        positions_[t[3]])));
        }
        return least;
    }

    // Between two inner nodes, p and q, and the cuts on the edges from these to two outer ones. On the two
    // faces that neighbours share, the rule decides; the quadrilateral of the cuts is the boundary and takes
    // the better diagonal.
    void add_wedge(std::uint32_t p, std::uint32_t q, const Rail& first, const Rail& second) {
        const Rail inner{p, q};
        const bool before_first = comes_first({p, first.from}, {q, first.to});
        const bool before_second = comes_first({p, second.from}, {q, second.to});
        if (before_first != before_second)
            return before_first ? add(prism(second, inner, first)) : add(prism(first, inner, second));
        const auto one = before_first ? prism(inner, first, second) : prism(first, second, inner);
        const auto other = before_first ? prism(inner, second, first) : prism(second, first, inner);
        add(worst(one) >= worst(other) ? one : other);
    }

private:
    const std::vector<glm::dvec3>& positions_;
    std::vector<glm::uvec4>& tets_;
};

}  // namespace

void cut_tet(const std::array<std::uint32_t, 4>& tet, const std::array<Side, 4>& sides,
             const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& cut,
             const std::vector<glm::dvec3>& positions, std::vector<glm::uvec4>& tets) {
    std::array<std::uint32_t, 4> corners = tet;  // inside, then on the boundary, then outside
    std::array<int, 3> counts = {};
    for (const Side side : sides) ++counts[static_cast<int>(side)];
    auto next = corners.begin();
    for (const Side side : {Side::inside, Side::boundary, Side::outside}) {
        for (int k = 0; k < 4; ++k) {
            if (sides[k] == side) *next++ = tet[k];
        }
    }
    const auto& [p, q, r, s] = corners;
    const int inside = counts[0], outside = counts[2];
    TetCutter cutter(positions, tets);
    if (outside == 0) {
        cutter.add({p, q, r, s});
    } else if (inside == 1) {
        const auto corner = [&](int k) {
            return k >= 4 - outside ? cut(corners[0], corners[k]) : corners[k];
        };
        cutter.add({p, corner(1), corner(2), corner(3)});
    } else if (inside == 2 && outside == 1) {  // a pyramid with its tip at r
        Rail a{p, cut(p, s)}, b{q, cut(q, s)};
        if (cutter.comes_first(b, a)) std::swap(a, b);
        cutter.add({a.from, b.from, b.to, r});
        cutter.add({a.from, a.to, b.to, r});
    } else if (inside == 2) {
        cutter.add_wedge(p, q, {cut(p, r), cut(q, r)}, {cut(p, s), cut(q, s)});
    } else {
        std::array<Rail, 3> rails = {Rail{p, cut(p, s)}, Rail{q, cut(q, s)}, Rail{r, cut(r, s)}};
        std::sort(rails.begin(), rails.end(),
                  [&](const Rail& a, const Rail& b) { return cutter.comes_first(a, b); });
        cutter.add(TetCutter::prism(rails[0], rails[1], rails[2]));
    }
}

}  // namespace gelatin::lattice
