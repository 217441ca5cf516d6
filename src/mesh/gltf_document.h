#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gelatin {

/// Numbers of an accessor, as doubles: normalized integers are divided by their largest value.
struct GltfArray {
    std::vector<double> values;  ///< shape [count][components]
    std::size_t count = 0, components = 1;
};

/// The JSON of a glTF 2.0 file, text or binary, and the data that it refers to: accessors, buffers, images.
/// All of its functions throw InvalidInput with the file and the item where that is wrong.
class GltfDocument {
public:
    using Json = nlohmann::json;

    /// Keeps a reference to `file`, and to `content`, which must outlive it.
    GltfDocument(const std::filesystem::path& file, std::string_view content);

    const Json& json() const { return json_; }

    /// The array `name` of the document; empty if there is none.
    const Json& list(const char* name) const;
    /// The object at `index` of the array `name` of the document.
    const Json& item(const char* name, std::size_t index) const;

    /// The whole number `key` of an object. `what` names the object in messages.
    std::size_t whole_number(const Json& object, const char* key, const std::string& what) const;
    std::optional<std::size_t> optional_number(const Json& object, const char* key,
                                               const std::string& what) const;
    /// `Size` numbers; nothing if the key is not there.
    std::optional<std::vector<double>> numbers(const Json& object, const char* key, std::size_t size,
                                               const std::string& what) const;

    GltfArray read_accessor(std::size_t index);
    /// The bytes of an image: of a file beside this one, of a data URI, or of a buffer.
    std::string read_image(std::size_t index);

    [[noreturn]] void fail(const std::string& field, const std::string& value,
                           const std::string& problem) const;

private:
    void parse(std::string_view text);
    std::string_view split_binary(std::string_view content);
    std::string read_uri(const std::string& uri) const;
    std::string_view buffer(std::size_t index);
    std::string_view view(std::size_t index, std::size_t* stride);
    struct Elements;
    Elements elements(const Json& place, std::size_t component_type, std::size_t components,
                      std::size_t count, const std::string& what);
    void read_sparse(const Json& sparse, std::size_t type, bool is_normalized, GltfArray& array,
                     const std::string& what);

    const std::filesystem::path& file_;
    Json json_;
    std::optional<std::string_view> binary_chunk_;
    std::vector<std::optional<std::string>> buffers_;  // those of files and data URIs that were read
};

}  // namespace gelatin
