#include "gl/block_access.h"

#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

namespace gelatin::gl {
namespace {

std::string without_comments(const std::string& source) {
    std::string text;
    for (std::size_t i = 0; i < source.size(); ++i) {
        if (source.compare(i, 2, "//") == 0) {
            i = source.find('\n', i);
            if (i == std::string::npos) break;
        } else if (source.compare(i, 2, "/*") == 0) {
            i = source.find("*/", i + 2);
            if (i == std::string::npos) break;
            ++i;
            continue;
        }
        text += source[i];
    }
    return text;
}

// Leaves out what #ifdef and its like leave out.
class Conditionals {
public:
    std::string resolve(const std::string& source) {
        std::istringstream lines(source);
        std::string kept;
        for (std::string line; std::getline(lines, line);) {
            std::smatch match;
            static const std::regex directive(R"(^\s*#\s*(\w+)\s*(.*?)\s*$)");
            if (line.find('#') != std::string::npos && std::regex_match(line, match, directive)) {
                follow(match[1], match[2]);
            } else if (is_kept()) {
                kept += line + "\n";
            }
        }
        return kept;
    }

private:
    // One #if until its #endif.
    struct Level {
        bool outer_is_kept;
        bool is_kept;
        bool is_over;  // a branch was taken for certain: no later one is
    };

    bool is_kept() const { return levels_.empty() || levels_.back().is_kept; }

    void follow(const std::string& directive, const std::string& rest) {
        if (directive == "define" && is_kept()) {
            defined_.insert(rest.substr(0, rest.find_first_of(" \t(")));
        } else if (directive == "undef" && is_kept()) {
            defined_.erase(rest);
        } else if (directive == "ifdef") {
            open(defined_.contains(rest));
        } else if (directive == "ifndef") {
            open(!defined_.contains(rest));
        } else if (directive == "if") {
            open(value_of(rest));
        } else if (levels_.empty()) {
            return;
        } else if (directive == "elif") {
            branch(value_of(rest));
        } else if (directive == "else") {
            branch(true);
        } else if (directive == "endif") {
            levels_.pop_back();
        }
    }

    void open(std::optional<bool> condition) {
        levels_.push_back({is_kept(), false, false});
        branch(condition);
    }

    void branch(std::optional<bool> condition) {
        Level& level = levels_.back();
        level.is_kept = level.outer_is_kept && !level.is_over && condition.value_or(true);
        if (condition == true) level.is_over = true;
    }

    // Nothing where it takes more than `defined`.
    std::optional<bool> value_of(const std::string& condition) const {
        static const std::regex pattern(R"((!?)\s*defined\s*\(?\s*(\w+)\s*\)?)");
        std::smatch match;
        if (!std::regex_match(condition, match, pattern)) return {};
        return defined_.contains(match[2]) != (match[1].length() > 0);
    }

    std::set<std::string> defined_;
    std::vector<Level> levels_;
};

}  // namespace

std::map<std::string, BlockAccess> block_accesses(const std::string& source) {
    const std::string text = Conditionals().resolve(without_comments(source));
    static const std::regex declaration(R"(\bbuffer\s+(\w+)\s*\{)");
    std::map<std::string, BlockAccess> accesses;
    for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it) {
        // Qualifiers stand between the statement before and the word `buffer`.
        const std::string before = text.substr(0, static_cast<std::size_t>(it->position()));
        const std::size_t statement_end = before.find_last_of(";{}");
        const std::string qualifiers =
            statement_end == std::string::npos ? before : before.substr(statement_end);
        const bool read_only = qualifiers.find("readonly") != std::string::npos;
        const bool write_only = qualifiers.find("writeonly") != std::string::npos;
        const auto [entry, is_new] = accesses.try_emplace((*it)[1], BlockAccess{false, false});
        entry->second.reads |= !write_only;
        entry->second.writes |= !read_only;
    }
    return accesses;
}

}  // namespace gelatin::gl
