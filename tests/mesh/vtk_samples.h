#pragma once

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tet_file_fixture.h"

namespace gelatin {

// kPair between a triangle and a hexahedron's worth of other cells, with attributes 3 and -5.
inline const std::string kVtkText =
    "# vtk DataFile Version 3.0\ntwo tets, by hand\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n" +
    kPositions +
    "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 0 2 1 4\n\nCELL_TYPES 3\n5 10 10\n"
    "CELL_DATA 3\nSCALARS quality float 1\nLOOKUP_TABLE default\n0.5 1 1\n"
    "FIELD FieldData 2\nstress 2 3 double\n1 2 3 4 5 6\nmaterial 1 3 int\n7 3 -5\n";
inline const std::string kVtk5Text =
    "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "FIELD FieldData 1\nTIME 1 1 double\n0.25\nMETADATA\nINFORMATION 0\n\n"
    "POINTS 5 double\n" +
    kPositions +
    "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n"
    "CELLS 4 11\nOFFSETS vtktypeint64\n0 3 7 11\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3 0 2 1 4\n"
    "CELL_TYPES 3\n5\n10\n10\n\n"
    "POINT_DATA 5\nVECTORS velocity double\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
    "CELL_DATA 3\nSCALARS material int\nLOOKUP_TABLE default\n7 3 -5\n";

// Legacy binary files are big-endian.
inline std::string vtk_binary(bool is_version_5) {
    Bytes bytes(true);
    bytes.text(
        fmt::format("# vtk DataFile Version {}\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n",
                    is_version_5 ? "5.1" : "2.0"));
    for (const glm::dvec3& p : kPair.positions) bytes.add(Doubles{p.x, p.y, p.z});
    if (is_version_5) {
        bytes.text("\nCELLS 4 11\nOFFSETS vtktypeint64\n").add(Sizes{0, 3, 7, 11});
        bytes.text("\nCONNECTIVITY vtktypeint64\n").add(Sizes{0, 1, 2, 0, 1, 2, 3, 0, 2, 1, 4});
    } else {
        bytes.text("\nCELLS 3 14\n").add(Ints{3, 0, 1, 2, 4, 0, 1, 2, 3, 4, 0, 2, 1, 4});
    }
    bytes.text("\nCELL_TYPES 3\n").add(Ints{5, 10, 10});
    bytes.text("\nPOINT_DATA 5\nCOLOR_SCALARS shade 1\n\n\xff z ");
    bytes.text("\nCELL_DATA 3\nSCALARS material short\nLOOKUP_TABLE default\n");
    return bytes.add(std::vector<std::int16_t>{7, 3, -5}).text("\n").all();
}

struct VtuChoice {
    enum class Format { ascii, inline_base64, appended_raw, appended_base64 };
    Format format = Format::ascii;
    bool is_compressed = false, has_large_header = false, is_big_endian = false;
};

inline std::string base64_of(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

// kPair in any of VTK's codings; compressed in blocks of 16 bytes, so that the last one is shorter.
class VtuSample {
public:
    explicit VtuSample(const VtuChoice& choice) : choice_(choice) {}

    std::string text() {
        Doubles points;
        for (const glm::dvec3& p : kPair.positions) points.insert(points.end(), {p.x, p.y, p.z});
        const bool is_appended =
            choice_.format == Format::appended_raw || choice_.format == Format::appended_base64;
        std::string out = fmt::format(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"{}\" "
            "byte_order=\"{}\"{}{}>\n",
            choice_.has_large_header ? "1.0" : "0.1", choice_.is_big_endian ? "BigEndian" : "LittleEndian",
            choice_.has_large_header ? " header_type=\"UInt64\"" : "",
            choice_.is_compressed ? " compressor=\"vtkZLibDataCompressor\"" : "");
        out += "<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<Points>\n";
        out += array("Float64", "Points\" NumberOfComponents=\"3", points);
        out += "</Points>\n<Cells>\n";
        out += array("Int32", "connectivity", Ints{0, 1, 2, 0, 1, 2, 3, 0, 2, 1, 4});
        out += array("Int64", "offsets", std::vector<std::int64_t>{3, 7, 11});
        out += array("UInt8", "types", std::vector<std::uint8_t>{5, 10, 10});
        out += "</Cells>\n<CellData>\n";
        out += array("Float64", "quality", Doubles{0.5, 1.0, 1.0});
        out += array("Int16", "material", std::vector<std::int16_t>{7, 3, -5});
        out += "</CellData>\n</Piece>\n</UnstructuredGrid>\n";
        if (is_appended) {
            out += fmt::format("<AppendedData encoding=\"{}\">\n_{}\n</AppendedData>\n",
                               choice_.format == Format::appended_raw ? "raw" : "base64", appended_);
        }
        return out + "</VTKFile>\n";
    }

private:
    using Format = VtuChoice::Format;

    template <class T>
    std::string array(const char* type, const char* name, const std::vector<T>& values) {
        const std::string head = fmt::format("<DataArray type=\"{}\" Name=\"{}\" ", type, name);
        if (choice_.format == Format::ascii) {
            std::string numbers;
            for (const T value : values) numbers += fmt::format(" {}", value);
            return head + "format=\"ascii\">\n" + numbers + "\n</DataArray>\n";
        }
        const auto [header, data] = packed(Bytes(choice_.is_big_endian).add(values).all());
        if (choice_.format == Format::inline_base64)
            return head + "format=\"binary\">\n  " + coded(header, data) + "\n</DataArray>\n";
        const std::size_t offset = appended_.size();
        appended_ += choice_.format == Format::appended_raw ? header + data : coded(header, data);
        return head + fmt::format("format=\"appended\" offset=\"{}\"/>\n", offset);
    }

    // The header of a compressed array is coded apart.
    std::string coded(const std::string& header, const std::string& data) const {
        return choice_.is_compressed ? base64_of(header) + base64_of(data) : base64_of(header + data);
    }

    std::string header_of(const Sizes& numbers) const {
        Bytes bytes(choice_.is_big_endian);
        if (choice_.has_large_header) return bytes.add(numbers).all();
        return bytes.add(std::vector<std::uint32_t>(numbers.begin(), numbers.end())).all();
    }

    std::pair<std::string, std::string> packed(const std::string& bytes) const {
        constexpr std::size_t kBlock = 16;
        if (!choice_.is_compressed) return {header_of({bytes.size()}), bytes};
        Sizes header = {(bytes.size() + kBlock - 1) / kBlock, kBlock, bytes.size() % kBlock};
        std::string data;
        for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
            const std::string block = bytes.substr(at, kBlock);
            std::string squeezed(::compressBound(block.size()), '\0');
            uLongf length = squeezed.size();
            ::compress(reinterpret_cast<Bytef*>(squeezed.data()), &length,
                       reinterpret_cast<const Bytef*>(block.data()), block.size());
            header.push_back(length);
            data += squeezed.substr(0, length);
        }
        return {header_of(header), data};
    }

    VtuChoice choice_;
    std::string appended_;
};

// All that a file can be.
inline std::vector<VtuChoice> vtu_choices() {
    using Format = VtuChoice::Format;
    std::vector<VtuChoice> choices = {{}};
    for (const Format format : {Format::inline_base64, Format::appended_raw, Format::appended_base64}) {
        for (const int bits : {0, 1, 2, 3, 4, 5, 6, 7})
            choices.push_back({format, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
    }
    return choices;
}

inline std::string describe(const VtuChoice& choice) {
    return fmt::format("format {}{}{}{}", static_cast<int>(choice.format),
                       choice.is_compressed ? ", zlib" : "", choice.has_large_header ? ", UInt64" : "",
                       choice.is_big_endian ? ", BigEndian" : "");
}

}  // namespace gelatin
