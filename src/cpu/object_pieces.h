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

    ObjectPieces() = default;
    /// @param ranges by object
    explicit ObjectPieces(std::span<const Range> ranges) {
        for (std::uint32_t o = 0; o < ranges.size(); ++o)
            for (std::uint32_t first = ranges[o].first; first < ranges[o].end(); first += kMost)
                pieces_.push_back({o, {first, std::min(kMost, ranges[o].end() - first)}});
    }

    /// All but those of some objects. @param left_out by object
    ObjectPieces without(std::span<const std::uint8_t> left_out) const {
        ObjectPieces some;
        for (const Piece& piece : pieces_)
            if (left_out[piece.object] == 0) some.pieces_.push_back(piece);
        return some;
    }

    /// Calls visit(n) for all that objects consist of, or visit(range).
    template <class Visit>
    void for_each(const Visit& visit) const {
        for_each_piece([&](const Range& range) {
            for (std::uint32_t n = range.first; n < range.end(); ++n) visit(n);
        });
    }
    template <class Visit>
    void for_each_piece(const Visit& visit) const {
        for_each_index(0, pieces_.size(), 1, [&](std::size_t p) { visit(pieces_[p].range); });
    }

    /// Of a value of each, by object; they do not depend on the number of threads.
    template <class Value = double, class ValueOf>
    std::vector<Value> sums(const ValueOf& value_of) const {
        std::vector<Value> by_object(pieces_.empty() ? 0 : pieces_.back().object + 1, Value(0));
        gather(
            std::span<Value>(by_object),
            [&](const Piece& piece) {
                Value sum(0);
                for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) sum += value_of(n);
                return sum;
            },
            [](Value& sum, const Value& more) { sum += more; });
        return by_object;
    }

    /// Joins what the pieces of each object have. Threads write once a piece: values of objects lie beside
    /// each other, and threads that write these again and again take the memory from each other.
    /// @param by_object input: values to join with; output: with those of all pieces, in their order
    /// @param of_piece(piece): a value @param join(value, more): joins the value with another one
    template <class Value, class OfPiece, class Join>
    void gather(std::span<Value> by_object, const OfPiece& of_piece, const Join& join) const {
        for_values(of_piece,
                   [&](const Piece& piece, const auto& value) { join(by_object[piece.object], value); });
    }

    /// The sum of what of_piece(piece) gives for all pieces, in their order.
    template <class OfPiece>
    double sum(const OfPiece& of_piece) const {
        double sum = 0.0;
        for_values(of_piece, [&](const Piece&, double value) { sum += value; });
        return sum;
    }

private:
    static constexpr std::uint32_t kMost = 512;

    template <class OfPiece, class Use>
    void for_values(const OfPiece& of_piece, const Use& use) const {
        std::vector<decltype(of_piece(pieces_[0]))> values(pieces_.size());
        for_each_index(0, values.size(), 1, [&](std::size_t p) { values[p] = of_piece(pieces_[p]); });
        for (std::size_t p = 0; p < values.size(); ++p) use(pieces_[p], values[p]);
    }

    std::vector<Piece> pieces_;
};

}  // namespace gelatin::cpu
