#include "mesh/gltf_document.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/load_bytes.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

using Json = nlohmann::json;

std::string from_base64(std::string_view text) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;  // of bits
    for (const char c : text) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) break;  // padding
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 255);
    }
    return bytes;
}

// %20 and the like, as URIs have them.
std::string without_escapes(const std::string& name) {
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        unsigned value = 0;
        const bool is_escape =
            name[i] == '%' && i + 2 < name.size() && std::sscanf(name.c_str() + i + 1, "%2x", &value) == 1;
        plain += is_escape ? static_cast<char>(value) : name[i];
        if (is_escape) i += 2;
    }
    return plain;
}

struct ComponentType {
    std::size_t number, size;
    double (*load)(std::string_view bytes, std::size_t offset);
    double largest;  // of normalized integers; 1: a float
};

template <class T>
double load(std::string_view bytes, std::size_t offset) {
    return static_cast<double>(load_bytes<T>(bytes, offset, kLittleIsSwapped));
}

constexpr std::array<ComponentType, 6> kComponentTypes = {{{5120, 1, load<std::int8_t>, 127.0},
                                                           {5121, 1, load<std::uint8_t>, 255.0},
                                                           {5122, 2, load<std::int16_t>, 32767.0},
                                                           {5123, 2, load<std::uint16_t>, 65535.0},
                                                           {5125, 4, load<std::uint32_t>, 4294967295.0},
                                                           {5126, 4, load<float>, 1.0}}};

std::size_t components_of(const Json& accessor) {
    const std::string type = accessor.value("type", "");
    return type == "SCALAR" ? 1
           : type == "VEC2" ? 2
           : type == "VEC3" ? 3
           : type == "VEC4" ? 4
           : type == "MAT4" ? 16
                            : 0;
}

}  // namespace

/// Elements in a buffer, all of which are inside it.
struct GltfDocument::Elements {
    std::string_view bytes;
    const ComponentType* type;
    std::size_t components, stride;
    bool is_normalized;

    double at(std::size_t element, std::size_t component) const {
        const double value = type->load(bytes, element * stride + component * type->size);
        return is_normalized ? std::max(value / type->largest, -1.0) : value;
    }
};

GltfDocument::GltfDocument(const std::filesystem::path& file, std::string_view content) : file_(file) {
    parse(content.starts_with("glTF") ? split_binary(content) : content);
    if (!json_.is_object()) fail({}, {}, "is not glTF: its JSON is no object");
    const Json& asset = json_.contains("asset") ? json_.at("asset") : Json::object();
    const std::string version =
        asset.is_object() && asset.contains("version") ? asset.at("version").dump() : "";
    if (!version.starts_with("\"2.")) fail("asset.version", version, "only glTF 2 is read");
    buffers_.resize(list("buffers").size());
}

void GltfDocument::parse(std::string_view text) {
    try {
        json_ = Json::parse(text);
    } catch (const Json::exception& error) {
        fail({}, {}, std::string("cannot be read: ") + error.what());
    }
}

// A header of three numbers, then chunks of a size, a kind and bytes: JSON, and perhaps one of a buffer.
std::string_view GltfDocument::split_binary(std::string_view content) {
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    const auto number = [&](std::size_t offset) {
        return load_bytes<std::uint32_t>(content, offset, kLittleIsSwapped);
    };
    if (content.size() < kHeader) fail({}, {}, "cannot be read: the file is cut off");
    if (number(4) != 2) fail("version", fmt::format("{}", number(4)), "only glTF 2 is read");
    std::optional<std::string_view> text;
    for (std::size_t at = kHeader; at + kChunkHeader <= content.size();) {
        const std::uint64_t size = number(at);
        const std::string_view kind = content.substr(at + 4, 4);
        at += kChunkHeader;
        if (size > content.size() - at) fail("size of chunk", fmt::format("{}", size), "the file is cut off");
        const std::string_view chunk = content.substr(at, size);
        if (kind == "JSON" && !text) text = chunk;
        if (kind == std::string_view("BIN\0", 4) && !binary_chunk_) binary_chunk_ = chunk;
        at += size;
    }
    if (!text) fail({}, {}, "cannot be read: has no chunk of JSON");
    return *text;
}

void GltfDocument::fail(const std::string& field, const std::string& value,
                        const std::string& problem) const {
    throw InvalidInput({file_.string(), 0, field, printable(value), problem});
}

const Json& GltfDocument::list(const char* name) const {
    static const Json empty = Json::array();
    const auto found = json_.find(name);
    if (found == json_.end()) return empty;
    if (!found->is_array()) fail(name, {}, "must be an array");
    return *found;
}

const Json& GltfDocument::item(const char* name, std::size_t index) const {
    const Json& items = list(name);
    if (index >= items.size()) {
        fail(name, fmt::format("{}", index), fmt::format("is not there: the file has {}", items.size()));
    }
    if (!items.at(index).is_object()) fail(fmt::format("{}[{}]", name, index), {}, "must be an object");
    return items.at(index);
}

std::optional<std::size_t> GltfDocument::optional_number(const Json& object, const char* key,
                                                         const std::string& what) const {
    const auto found = object.find(key);
    if (found == object.end()) return {};
    if (!found->is_number_unsigned()) fail(what + "." + key, found->dump(), "must be a whole number");
    return found->get<std::size_t>();
}

std::size_t GltfDocument::whole_number(const Json& object, const char* key, const std::string& what) const {
    const std::optional<std::size_t> number = optional_number(object, key, what);
    if (!number) fail(what + "." + key, {}, "is missing");
    return *number;
}

std::optional<std::vector<double>> GltfDocument::numbers(const Json& object, const char* key,
                                                         std::size_t size, const std::string& what) const {
    const auto found = object.find(key);
    if (found == object.end()) return {};
    const bool are_numbers =
        found->is_array() && found->size() == size &&
        std::all_of(found->begin(), found->end(), [](const Json& value) { return value.is_number(); });
    if (!are_numbers) fail(what + "." + key, found->dump(), fmt::format("must be {} numbers", size));
    return found->get<std::vector<double>>();
}

std::string GltfDocument::read_uri(const std::string& uri) const {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos || uri.find(";base64") > comma)
            fail("uri", uri, "data must be coded in base64");
        return from_base64(std::string_view(uri).substr(comma + 1));
    }
    const std::filesystem::path beside = file_.parent_path() / uri;
    return read_file(std::filesystem::exists(beside) ? beside : file_.parent_path() / without_escapes(uri));
}

std::string_view GltfDocument::buffer(std::size_t index) {
    const Json& buffer = item("buffers", index);
    const std::string what = fmt::format("buffers[{}]", index);
    const auto uri = buffer.find("uri");
    if (uri == buffer.end()) {
        if (index == 0 && binary_chunk_) return *binary_chunk_;
        fail(what, {}, "has no data that can be read");
    }
    if (!uri->is_string()) fail(what + ".uri", uri->dump(), "must be text");
    if (!buffers_[index]) {
        try {
            buffers_[index] = read_uri(uri->get<std::string>());
        } catch (const InvalidInput& error) {
            fail(what + ".uri", uri->get<std::string>(), error.problem().problem);
        }
    }
    return *buffers_[index];
}

std::string_view GltfDocument::view(std::size_t index, std::size_t* stride) {
    const Json& view = item("bufferViews", index);
    const std::string what = fmt::format("bufferViews[{}]", index);
    const std::string_view bytes = buffer(whole_number(view, "buffer", what));
    const std::size_t offset = optional_number(view, "byteOffset", what).value_or(0),
                      length = whole_number(view, "byteLength", what);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        fail(what, fmt::format("{} bytes from byte {}", length, offset),
             fmt::format("its buffer has {} bytes", bytes.size()));
    }
    if (stride != nullptr) *stride = optional_number(view, "byteStride", what).value_or(0);
    return bytes.substr(offset, length);
}

GltfDocument::Elements GltfDocument::elements(const Json& place, std::size_t component_type,
                                              std::size_t components, std::size_t count,
                                              const std::string& what) {
    const auto type =
        std::find_if(kComponentTypes.begin(), kComponentTypes.end(),
                     [&](const ComponentType& known) { return known.number == component_type; });
    if (type == kComponentTypes.end())
        fail(what + ".componentType", fmt::format("{}", component_type), "must be one from 5120 to 5126");
    std::size_t stride = 0;
    std::string_view bytes = view(whole_number(place, "bufferView", what), &stride);
    const std::size_t offset = optional_number(place, "byteOffset", what).value_or(0),
                      size = type->size * components;
    if (stride == 0) stride = size;
    const bool has_room = offset <= bytes.size() && count > 0 && bytes.size() - offset >= size &&
                          (bytes.size() - offset - size) / stride >= count - 1;
    if (!has_room && count > 0) {
        fail(what, fmt::format("{} elements of {} bytes", count, size),
             fmt::format("its bufferView has {} bytes", bytes.size()));
    }
    return {bytes.substr(std::min(offset, bytes.size())), &*type, components, stride, false};
}

GltfArray GltfDocument::read_accessor(std::size_t index) {
    const Json& accessor = item("accessors", index);
    const std::string what = fmt::format("accessors[{}]", index);
    const std::size_t components = components_of(accessor), count = whole_number(accessor, "count", what),
                      type = whole_number(accessor, "componentType", what);
    if (components == 0) fail(what + ".type", {}, "must be SCALAR, VEC2, VEC3, VEC4 or MAT4");
    const bool is_normalized = accessor.value("normalized", false), is_sparse = accessor.contains("sparse");
    GltfArray array{{}, count, components};
    if (accessor.contains("bufferView")) {
        Elements from = elements(accessor, type, components, count, what);
        from.is_normalized = is_normalized;
        array.values.reserve(count * components);
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t c = 0; c < components; ++c) array.values.push_back(from.at(k, c));
        }
    } else if (!is_sparse) {
        fail(what, {}, "has no bufferView");
    }
    if (is_sparse) read_sparse(accessor.at("sparse"), type, is_normalized, array, what + ".sparse");
    return array;
}

void GltfDocument::read_sparse(const Json& sparse, std::size_t type, bool is_normalized, GltfArray& array,
                               const std::string& what) {
    const std::size_t count = whole_number(sparse, "count", what);
    const Elements places =
        elements(sparse.at("indices"), whole_number(sparse.at("indices"), "componentType", what), 1, count,
                 what + ".indices");
    Elements from = elements(sparse.at("values"), type, array.components, count, what + ".values");
    from.is_normalized = is_normalized;
    constexpr std::size_t kMostZeros = 1024;  // for each value: nothing else limits what a small file claims
    if (array.values.empty() && array.count / kMostZeros > count)
        fail(what + ".count", fmt::format("{}", count), fmt::format("too few of {} elements", array.count));
    array.values.resize(array.count * array.components, 0.0);
    for (std::size_t k = 0; k < count; ++k) {
        const double place = places.at(k, 0);
        if (!(place >= 0.0 && place < static_cast<double>(array.count)))
            fail(what + ".indices", fmt::format("{}", place), fmt::format("must be below {}", array.count));
        for (std::size_t c = 0; c < array.components; ++c)
            array.values[static_cast<std::size_t>(place) * array.components + c] = from.at(k, c);
    }
}

std::string GltfDocument::read_image(std::size_t index) {
    const Json& image = item("images", index);
    const auto uri = image.find("uri");
    if (uri != image.end() && uri->is_string()) return read_uri(uri->get<std::string>());
    return std::string(view(whole_number(image, "bufferView", fmt::format("images[{}]", index)), nullptr));
}

}  // namespace gelatin
