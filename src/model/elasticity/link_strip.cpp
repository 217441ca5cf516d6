#include "model/elasticity/link_strip.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace gelatin {
namespace {

constexpr std::uint32_t kNone = StripStep::kNoTriangle;

bool contains(const LinkTriangle& triangle, std::uint32_t vertex) {
    return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

// Of `a` that `b` has not; none or one, where they have an edge in common.
std::optional<std::uint32_t> other_vertex(const LinkTriangle& a, const LinkTriangle& b) {
    for (const std::uint32_t vertex : a) {
        if (!contains(b, vertex)) return vertex;
    }
    return {};
}

bool is_reversed(const LinkTriangle& triangle, const LinkTriangle& order) {
    const auto first = std::find(triangle.begin(), triangle.end(), order[0]) - triangle.begin();
    return triangle[static_cast<std::size_t>(first + 1) % 3] != order[1];
}

class StripMaker {
public:
    explicit StripMaker(std::span<const LinkTriangle> triangles)
        : triangles_(triangles), neighbors_(triangles.size()), is_taken_(triangles.size(), false) {
        struct Edge {
            std::uint32_t low, high, triangle;
        };
        std::vector<Edge> edges;
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax({triangles[t][k], triangles[t][(k + 1) % 3]});
                edges.push_back({low, high, t});
            }
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
        });
        for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
            const Edge &a = edges[e], &b = edges[e + 1];
            if (a.low != b.low || a.high != b.high) continue;
            if (!other_vertex(triangles[a.triangle], triangles[b.triangle])) continue;
            neighbors_[a.triangle].push_back(b.triangle);
            neighbors_[b.triangle].push_back(a.triangle);
        }
    }

    std::vector<StripStep> make() {
        std::size_t left = triangles_.size();
        while (left > 0) {
            const std::vector<std::uint32_t> path = longest_path(left);
            for (const std::uint32_t t : path) is_taken_[t] = true;
            left -= path.size();
            append(path);
        }
        return std::move(steps_);
    }

private:
    // From some start, of those not taken; the first one found of all of them.
    std::vector<std::uint32_t> longest_path(std::size_t left) {
        std::vector<std::uint32_t> longest;
        for (std::uint32_t start = 0; start < triangles_.size() && longest.size() < left; ++start) {
            if (is_taken_[start]) continue;
            std::vector<std::uint32_t> path{start};
            is_taken_[start] = true;
            extend(path);
            std::reverse(path.begin(), path.end());
            extend(path);
            for (const std::uint32_t t : path) is_taken_[t] = false;
            if (path.size() > longest.size()) longest = path;
        }
        return longest;
    }

    // Always to the neighbour that has the fewest free ones left (Warnsdorff's rule).
    void extend(std::vector<std::uint32_t>& path) {
        for (;;) {
            std::uint32_t next = kNone;
            std::ptrdiff_t fewest = 0;
            for (const std::uint32_t t : neighbors_[path.back()]) {
                if (is_taken_[t]) continue;
                const std::ptrdiff_t free =
                    std::count_if(neighbors_[t].begin(), neighbors_[t].end(),
                                  [&](std::uint32_t other) { return !is_taken_[other]; });
                if (next != kNone && free >= fewest) continue;
                next = t;
                fewest = free;
            }
            if (next == kNone) return;
            is_taken_[next] = true;
            path.push_back(next);
        }
    }

    void append(const std::vector<std::uint32_t>& path) {
        for (std::size_t k = 0; k < path.size(); ++k) {
            const LinkTriangle& triangle = triangles_[path[k]];
            const auto vertex =
                k == 0 ? std::optional<std::uint32_t>() : other_vertex(triangle, triangles_[path[k - 1]]);
            if (vertex && contains(triangle, last_[2])) {
                const bool keeps_oldest = contains(triangle, last_[0]);
                step(*vertex, keeps_oldest, path[k]);
            } else {
                begin(path[k], k + 1 < path.size() ? triangles_[path[k + 1]] : triangle);
            }
        }
    }

    // With the vertex first that the next triangle has not.
    void begin(std::uint32_t index, const LinkTriangle& next) {
        const LinkTriangle& triangle = triangles_[index];
        const auto leaving = other_vertex(triangle, next).value_or(triangle[0]);
        const auto first =
            static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), leaving) - triangle.begin());
        step(triangle[first], false, kNone);
        step(triangle[(first + 1) % 3], false, kNone);
        step(triangle[(first + 2) % 3], false, index);
    }

    void step(std::uint32_t vertex, bool keeps_oldest, std::uint32_t triangle) {
        last_ = {keeps_oldest ? last_[0] : last_[1], last_[2], vertex};
        const bool reversed = triangle != kNone && is_reversed(triangles_[triangle], last_);
        steps_.push_back({vertex, keeps_oldest, triangle, reversed});
    }

    std::span<const LinkTriangle> triangles_;
    std::vector<std::vector<std::uint32_t>> neighbors_;
    std::vector<bool> is_taken_;
    LinkTriangle last_{};  // the oldest first
    std::vector<StripStep> steps_;
};

}  // namespace

std::vector<StripStep> make_link_strip(std::span<const LinkTriangle> triangles) {
    return StripMaker(triangles).make();
}

}  // namespace gelatin
