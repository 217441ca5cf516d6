#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gelatin {

/// How a VTU file codes the bytes of its arrays.
struct VtuCoding {
    bool is_base64 = true;
    bool is_compressed = false;   ///< by zlib, in blocks
    std::size_t header_size = 4;  ///< bytes of each number in front of an array: UInt32 or UInt64
    bool is_swapped = false;      ///< the numbers in front are in the other byte order
};

/// The bytes of the array that begins at the start of `text`, which may be longer. Allocates no more than
/// about a thousand times its length, which is the most that zlib can make of it.
/// @throws InvalidInput with the problem alone, neither file nor line.
std::string decode_vtu_bytes(std::string_view text, const VtuCoding& coding);

}  // namespace gelatin
