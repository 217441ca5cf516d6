#include "gpu/chunks.h"

#include <algorithm>
#include <numeric>

namespace gelatin::gpu {

std::vector<Chunk> make_chunks(const Model& model, Range ModelObject::*range) {
    constexpr std::uint32_t kChunk = 256;
    std::vector<Chunk> chunks;
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const Range all = model.objects[o].*range;
        for (std::uint32_t first = all.first; first < all.end(); first += kChunk) {
            chunks.push_back({o, first, std::min(kChunk, all.end() - first), model.objects[o].nodes.first});
        }
    }
    return chunks;
}

std::vector<std::uint32_t> chunk_starts(const std::vector<Chunk>& chunks, std::size_t object_count) {
    std::vector<std::uint32_t> starts(object_count + 1, 0);
    for (const Chunk& chunk : chunks) ++starts[chunk.object + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    return starts;
}

}  // namespace gelatin::gpu
