#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/for_each_index.h"
#include "model/model.h"
#include "model/range.h"

namespace gelatin::cpu {

/// The nodes of each object.
inline std::vector<Range> node_ranges(const Model& model) {
    std::vector<Range> ranges;
    for (const ModelObject& object : model.objects) ranges.push_back(object.nodes);
    return ranges;
}

/// What objects consist of, such as their nodes, in pieces that threads share. Large objects have several.
class ObjectPieces {
public:
    struct Piece {
        std::uint32_t object;
        Range range;
    };

    /// @param ranges by object
    explicit ObjectPieces(std::span<const Range> ranges) {
        for (std::uint32_t o = 0; o < ranges.size(); ++o)
            for (std::uint32_t first = ranges[o].first; first < ranges[o].end(); first += kMost)
                pieces_.push_back({o, {first, std::min(kMost, ranges[o].end() - first)}});
    }

    /// Calls visit(n) for all that objects consist of, or visit(piece).
    template <class Visit>
    void for_each(const Visit& visit) const {
        for_each_piece([&](const Piece& piece) {
            for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) visit(n);
        });
    }
    template <class Visit>
    void for_each_piece(const Visit& visit) const {
        for_each_index(0, pieces_.size(), 1, [&](std::size_t p) { visit(pieces_[p]); });
    }

    /// use(piece, value) of what of_piece(piece) gives for each, in their order, whatever the number of
    /// threads. These write once a piece: such values lie beside each other, and threads that write them
    /// again and again take the memory from each other.
    template <class OfPiece, class Use>
    void for_values(const OfPiece& of_piece, const Use& use) const {
        std::vector<decltype(of_piece(pieces_[0]))> values(pieces_.size());
        for_each_index(0, values.size(), 1, [&](std::size_t p) { values[p] = of_piece(pieces_[p]); });
        for (std::size_t p = 0; p < values.size(); ++p) use(pieces_[p], values[p]);
    }

private:
    static constexpr std::uint32_t kMost = 512;

    std::vector<Piece> pieces_;
};

}  // namespace gelatin::cpu
