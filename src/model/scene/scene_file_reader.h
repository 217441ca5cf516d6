#pragma once

#include <toml++/toml.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gelatin/error.h"
#include "model/scene/limits.h"
#include "model/scene/names.h"

namespace gelatin {

/// The parser's complaint without line breaks, which it quotes from the file.
std::string describe(const toml::parse_error& error);

/// Source path of nodes that an override made begins with this; they have no line.
inline constexpr std::string_view kOverridePrefix = "--set ";

/// What is wrong at `node`: its file (or override), line and value. `file` stands in where the node knows
/// none.
InputProblem problem_at(const toml::node& node, const std::string& file, const std::string& field,
                        const std::string& problem);

/// Reads one table of a scene file into values that keep their defaults where the table is silent.
///
/// Each getter notes its key as known, checks its type, and throws InvalidInput naming file, line, dotted
/// key, value and what is allowed; what values may be is for validate() to say. `finish` then reports keys
/// that nobody asked for. Refers to the parsed document, which must outlive it.
class TableReader {
public:
    /// @param path dotted, for messages ("object.ball"); empty for the whole file
    TableReader(const toml::table& table, std::string path, const std::string& file)
        : table_(&table), path_(std::move(path)), file_(&file) {}

    /// The key is one of the known ones from then on.
    bool has(const char* key) { return find(key) != nullptr; }
    int line() const;
    /// Of the value at `key`; 0: there is none, or it is not from the file.
    int line_of(const char* key);

    /// For messages: names the table by what is inside it ("object.ball" instead of "object[0]").
    void set_path(std::string path) { path_ = std::move(path); }

    void require(std::initializer_list<const char*> keys);
    /// The one key of `keys` that the table has.
    std::string require_one_of(const std::vector<std::string>& keys);
    /// The same where the table may have none of them: empty then.
    std::string at_most_one_of(const std::vector<std::string>& keys);

    void read(const char* key, double& value);
    void read(const char* key, std::optional<double>& value);
    void read(const char* key, int& value);
    void read(const char* key, std::optional<int>& value);
    void read(const char* key, bool& value);
    void read(const char* key, std::optional<bool>& value);
    void read(const char* key, std::string& value);
    /// A name, which may be left out, but must not be empty.
    void read_name(const char* key, std::string& name);
    void read(const char* key, glm::dvec2& value);
    void read(const char* key, glm::dvec3& value);
    void read(const char* key, glm::ivec3& value);
    /// A direction of any length, made unit where that can be.
    void read_direction(const char* key, glm::dvec3& value);
    /// Holds the number at `key`, or each of a list of them, against a limit: for what validate() does not
    /// see.
    /// @pre it was read
    void check(const char* key, const Limit& limit) const;

    template <class Enum>
    void read(const char* key, Enum& value, const std::vector<std::pair<std::string, Enum>>& choices) {
        std::string name;
        read(key, name);
        if (!has(key)) return;
        std::vector<std::string> names;
        for (const auto& [choice, meaning] : choices) {
            if (choice == name) {
                value = meaning;
                return;
            }
            names.push_back(choice);
        }
        fail_choice(key, name, names);
    }

    /// A list of at least one of `names`, none twice.
    std::vector<std::string> read_names(const char* key, const std::vector<std::string>& names);

    /// A list of two texts.
    std::pair<std::string, std::string> read_two_texts(const char* key);

    /// A list of two points, which messages call `points`: "corners".
    std::pair<glm::dvec3, glm::dvec3> read_two_points(const char* key, const char* points);

    std::optional<TableReader> table(const char* key);
    std::vector<TableReader> tables(const char* key);

    /// The value at `key`, or null; for keys of more than one type.
    const toml::node* find(const char* key);

    [[noreturn]] void fail(std::string_view key, const std::string& problem) const;
    /// Fails at the first of `keys` that is there. They do not count as known ones.
    void refuse(const std::vector<std::string>& keys, const std::string& problem) const;
    /// @throws InvalidInput for the first key in the file that no getter asked for.
    void finish() const;

private:
    std::vector<std::string> present_of(const std::vector<std::string>& keys) const;
    std::string field(std::string_view key) const;
    [[noreturn]] void fail_choice(const char* key, const std::string& name,
                                  const std::vector<std::string>& names) const;
    [[noreturn]] void fail_at(const toml::node& node, std::string_view key, const std::string& problem) const;
    double number(const toml::node& node, std::string_view key) const;
    int whole_number(const toml::node& node, std::string_view key) const;
    const toml::array& list_of(std::size_t count, const toml::node& node, const char* key) const;
    template <class Vector>
    void read_numbers(const char* key, Vector& value);

    const toml::table* table_;
    std::string path_;
    const std::string* file_;
    std::vector<std::string> known_;
};

}  // namespace gelatin
