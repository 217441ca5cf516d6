#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace gelatin {

/// The meaning of a value in a mesh file, for messages: "vertex 12", or just "version".
struct FieldName {
    std::string_view name;
    std::uint64_t number = 0;  ///< 0: none

    // Implicit, so that a call reads scanner.integer("version").
    // NOLINTNEXTLINE(google-explicit-constructor)
    FieldName(const char* text, std::uint64_t n = 0) : name(text), number(n) {}
    std::string text() const;
};

/// The part of a value from a file that a message can show: binary files have long and unprintable ones.
std::string printable(std::string_view value);

/// With the letters A to Z as small ones.
std::string lower_case(std::string_view text);

/// Reads a mesh file word by word, or byte by byte between words. Every problem is an InvalidInput with file
/// and line. Keeps references to its arguments.
class TextScanner {
public:
    /// @param comment the character that begins a comment, which ends with its line; 0 if the format has none
    /// @param joins_lines whether a backslash at the end of a line joins the next one to it
    TextScanner(const std::filesystem::path& file, std::string_view text, char comment = '#',
                bool joins_lines = false);

    /// Skips blanks and comments. True at the end of the file.
    bool at_end();
    /// Skips blanks and comments on this line. True at the end of the line.
    bool at_line_end();
    void skip_line();

    /// The next word, on any line. @throws InvalidInput at the end of the file.
    std::string_view word(const FieldName& field);
    /// The words that are left on this line, with the blanks between them. A comment character within a word,
    /// as in a name, begins no comment; nor does one that the first word begins with, as in "#ff0000".
    std::string_view rest_of_line();
    /// Reads the next word. @throws InvalidInput if it is another one.
    void expect(const char* expected);
    std::uint64_t integer(const FieldName& field, std::uint64_t low = 0,
                          std::uint64_t high = std::numeric_limits<std::uint64_t>::max());
    int signed_integer(const FieldName& field);
    std::int64_t large_integer(const FieldName& field);  ///< of 64 bits, with a sign
    double number(const FieldName& field);
    /// A number that fits into a float: mesh files with others are refused.
    double coordinate(const FieldName& field);

    /// The number of items that take at least `bytes_each` each. @throws InvalidInput if the rest of the file
    /// is too short for them, so that a caller may allocate what the file claims.
    std::size_t count(const FieldName& field, std::size_t bytes_each);
    void require_room(const FieldName& field, std::uint64_t count, std::size_t bytes_each) const;

    /// The next `size` bytes as they are. From there on, line numbers are unknown.
    std::string_view bytes(std::size_t size, const FieldName& field);
    std::size_t bytes_left() const { return text_.size() - position_; }

    /// Continues after a part of the text that lies ahead, as a copy of this scanner has read it.
    void skip_over(std::string_view part);
    /// Continues at this byte, which must not lie behind the place where it is.
    void skip_to(std::size_t position);
    /// Continues after `text`. @throws InvalidInput if it does not occur.
    void skip_past(std::string_view text, const FieldName& field);

    [[noreturn]] void fail(const FieldName& field, std::string_view value, const std::string& problem) const;
    [[noreturn]] void fail_cut_off(const FieldName& field) const;
    /// @throws InvalidInput unless `value` is finite and fits into a float.
    void require_coordinate(double value, const FieldName& field) const;

private:
    void skip_blanks(bool stop_at_line_end);
    bool joins_next_line() const;  // a backslash is here, and nothing behind it
    template <class T>
    T parse_signed(const FieldName& field);

    const std::filesystem::path& file_;
    std::string_view text_;
    char comment_;
    bool joins_lines_;
    std::size_t position_ = 0;
    int line_ = 1;  // of the word that was read last
    bool knows_line_ = true;
};

}  // namespace gelatin
