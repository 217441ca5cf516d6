#pragma once

#include <set>
#include <string>
#include <vector>

namespace gelatin {

/// A Markdown table whose columns are padded, so that it is legible in a terminal too.
class MarkdownTable {
public:
    /// @param figures the columns that are right-aligned
    MarkdownTable(std::vector<std::string> header, std::set<std::size_t> figures);

    /// @pre as many cells as the header
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

    std::string text() const;

private:
    std::vector<std::vector<std::string>> rows_;  // the header first
    std::set<std::size_t> figures_;
};

/// Three digits or more: 1.34, 51.9, 249, 3619.
std::string format_figure(double value);

}  // namespace gelatin
