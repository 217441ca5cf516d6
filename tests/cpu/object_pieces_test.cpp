#include "cpu/object_pieces.h"

#include <gmock/gmock.h>

#include <numeric>
#include <string>
#include <vector>

namespace gelatin {
namespace {

using testing::ElementsAre;
using Piece = cpu::ObjectPieces::Piece;

TEST(ObjectPieces, JoinWhatEachObjectHas) {
    std::vector<int> values(5000);
    std::iota(values.begin(), values.end(), 1);
    const std::vector<Range> ranges{{0, 3}, {3, 4096}, {4099, 0}, {4100, 512}, {4612, 1}};
    const auto sum_of = [&](const Piece& piece) {
        return std::accumulate(values.begin() + piece.range.first, values.begin() + piece.range.end(), 0);
    };
    std::vector<int> sums{1, 0, 7, 0, 0};
    cpu::ObjectPieces(ranges).for_values(sum_of,
                                         [&](const Piece& piece, int more) { sums[piece.object] += more; });
    const auto sum_to = [](int last) { return last * (last + 1) / 2; };
    EXPECT_THAT(sums, ElementsAre(1 + 6, sum_to(4099) - 6, 7, sum_to(4612) - sum_to(4100), 4613));
}

// So that sums do not depend on the number of threads.
TEST(ObjectPieces, AreJoinedInTheirOrder) {
    const auto start_of = [](const Piece& piece) { return std::to_string(piece.range.first) + ' '; };
    std::vector<std::string> starts(2);
    cpu::ObjectPieces(std::vector<Range>{{0, 1100}, {1100, 600}})
        .for_values(start_of,
                    [&](const Piece& piece, const std::string& more) { starts[piece.object] += more; });
    EXPECT_THAT(starts, ElementsAre("0 512 1024 ", "1100 1612 "));
}

TEST(ObjectPieces, OfNothingAreNone) {
    cpu::ObjectPieces(std::vector<Range>{})
        .for_values([](const Piece&) { return 1; }, [](const Piece&, int) { FAIL(); });
}

}  // namespace
}  // namespace gelatin
