#include "mesh/text_scanner.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "gelatin/error.h"

namespace gelatin {
namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

// The mark with which Windows programs begin a text of UTF-8.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

std::string printable(std::string_view value) {
    constexpr std::size_t kLongest = 40;
    std::string text(value.substr(0, kLongest));
    for (char& c : text) {
        if (c < 32 || c == 127) c = '?';
    }
    return value.size() > kLongest ? text + "..." : text;
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

std::string FieldName::text() const {
    return number == 0 ? std::string(name) : fmt::format("{} {}", name, number);
}

TextScanner::TextScanner(const std::filesystem::path& file, std::string_view text, char comment,
                         bool joins_lines)
    : file_(file), text_(text), comment_(comment), joins_lines_(joins_lines) {
    if (text.starts_with(kByteOrderMark)) position_ = kByteOrderMark.size();
}

void TextScanner::skip_blanks(bool stop_at_line_end) {
    while (position_ < text_.size()) {
        const char c = text_[position_];
        if (c == '\n') {
            if (stop_at_line_end) return;
            ++line_;
            ++position_;
        } else if (comment_ != 0 && c == comment_) {
            position_ = std::min(text_.find('\n', position_), text_.size());
        } else if (is_blank(c)) {
            ++position_;
        } else if (joins_next_line()) {
            skip_to(text_.find('\n', position_) + 1);
        } else {
            return;
        }
    }
}

bool TextScanner::joins_next_line() const {
    if (!joins_lines_ || text_[position_] != '\\') return false;
    const std::size_t next = text_.find_first_not_of(" \t\r", position_ + 1);
    return next < text_.size() && text_[next] == '\n';
}

bool TextScanner::at_end() {
    skip_blanks(false);
    return position_ == text_.size();
}

bool TextScanner::at_line_end() {
    skip_blanks(true);
    return position_ == text_.size() || text_[position_] == '\n';
}

void TextScanner::skip_line() {
    while (joins_lines_ && !at_line_end()) word("word");
    position_ = text_.find('\n', position_);
    if (position_ == std::string_view::npos) {
        position_ = text_.size();
    } else {
        ++position_;
        ++line_;
    }
}

std::string_view TextScanner::word(const FieldName& field) {
    if (at_end()) fail_cut_off(field);
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_blank(text_[position_]) && !joins_next_line()) {
        if (comment_ != 0 && text_[position_] == comment_) break;
        ++position_;
    }
    return text_.substr(begin, position_ - begin);
}

std::string_view TextScanner::rest_of_line() {
    const char comment = std::exchange(comment_, '\0');
    const bool is_empty = at_line_end();
    comment_ = comment;
    if (is_empty) return {};
    std::string_view rest = text_.substr(position_, text_.find('\n', position_) - position_);
    position_ += rest.size();
    const auto is_blank_at = [&](std::size_t k) { return k >= rest.size() || is_blank(rest[k]); };
    for (std::size_t k = 0; k < rest.size(); ++k) {
        if (rest[k] == comment_ && is_blank_at(k == 0 ? 1 : k - 1)) rest = rest.substr(0, k);
    }
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    return rest;
}

std::uint64_t TextScanner::integer(const FieldName& field, std::uint64_t low, std::uint64_t high) {
    const std::string_view text = word(field);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    if (!is_number || value < low || value > high) {
        const bool open = high == std::numeric_limits<std::uint64_t>::max();
        fail(field, text,
             open ? fmt::format("must be a whole number of at least {}", low)
                  : fmt::format("must be a whole number from {} to {}", low, high));
    }
    return value;
}

int TextScanner::signed_integer(const FieldName& field) {
    return parse_signed<int>(field);
}

std::int64_t TextScanner::large_integer(const FieldName& field) {
    return parse_signed<std::int64_t>(field);
}

template <class T>
T TextScanner::parse_signed(const FieldName& field) {
    const std::string_view text = word(field);
    T value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        fail(field, text, fmt::format("must be a whole number that fits into {} bits", 8 * sizeof(T)));
    return value;
}

double TextScanner::number(const FieldName& field) {
    const std::string_view text = word(field);
    const char* const end = text.data() + text.size();
    double value = 0.0;
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const auto [stop, error] = std::from_chars(text.data() + (has_plus ? 1 : 0), end, value);
    // Too large or too small for a double: strtod distinguishes them.
    if (error == std::errc::result_out_of_range) return std::strtod(std::string(text).c_str(), nullptr);
    if (error != std::errc() || stop != end) fail(field, text, "must be a number");
    return value;
}

double TextScanner::coordinate(const FieldName& field) {
    const double value = number(field);
    require_coordinate(value, field);
    return value;
}

void TextScanner::require_coordinate(double value, const FieldName& field) const {
    if (std::abs(value) <= std::numeric_limits<float>::max()) return;
    fail(field, fmt::format("{}", value), "coordinates must be finite, and no larger than 3.4e38");
}

std::size_t TextScanner::count(const FieldName& field, std::size_t bytes_each) {
    const std::uint64_t count = integer(field);
    require_room(field, count, bytes_each);
    return static_cast<std::size_t>(count);
}

void TextScanner::require_room(const FieldName& field, std::uint64_t count, std::size_t bytes_each) const {
    // The last one may lack its separator, which is one of its bytes.
    const std::size_t room = text_.size() - position_ + 1;
    if (count <= room / bytes_each) return;
    fail(field, fmt::format("{}", count),
         fmt::format("the file is too short for so many: {} bytes are left", room - 1));
}

std::string_view TextScanner::bytes(std::size_t size, const FieldName& field) {
    knows_line_ = false;
    if (size > text_.size() - position_) fail_cut_off(field);
    const std::string_view result = text_.substr(position_, size);
    position_ += size;
    return result;
}

void TextScanner::skip_to(std::size_t position) {
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(position_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
    position_ = position;
}

void TextScanner::skip_over(std::string_view part) {
    skip_to(static_cast<std::size_t>(part.data() - text_.data()) + part.size());
}

void TextScanner::skip_past(std::string_view text, const FieldName& field) {
    const std::size_t found = text_.find(text, position_);
    if (found == std::string_view::npos) fail_cut_off(field);
    skip_to(found + text.size());
}

void TextScanner::expect(const char* expected) {
    const std::string_view found = word(expected);
    if (found != expected) fail("word", found, fmt::format("must be '{}' here", expected));
}

void TextScanner::fail(const FieldName& field, std::string_view value, const std::string& problem) const {
    throw InvalidInput({file_.string(), knows_line_ ? line_ : 0, field.text(), printable(value), problem});
}

void TextScanner::fail_cut_off(const FieldName& field) const {
    fail(field, {}, "is missing: the file is cut off here");
}

}  // namespace gelatin
