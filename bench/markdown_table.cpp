#include "bench/markdown_table.h"

#include <fmt/core.h>

#include <algorithm>

namespace gelatin {

MarkdownTable::MarkdownTable(std::vector<std::string> header, std::set<std::size_t> figures)
    : rows_{std::move(header)}, figures_(std::move(figures)) {}

std::string MarkdownTable::text() const {
    std::vector<std::size_t> widths(rows_.front().size(), 3);  // smallest width of the rule below the header
    for (const auto& row : rows_) {
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
    }
    std::string text;
    for (const auto& row : rows_) {
        for (std::size_t c = 0; c < row.size(); ++c) {
            text += figures_.count(c) != 0 ? fmt::format("| {:>{}} ", row[c], widths[c])
                                           : fmt::format("| {:<{}} ", row[c], widths[c]);
        }
        text += "|\n";
        if (&row != &rows_.front()) continue;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const bool right = figures_.count(c) != 0;
            text += fmt::format("| {:-<{}}{} ", "", right ? widths[c] - 1 : widths[c], right ? ":" : "");
        }
        text += "|\n";
    }
    return text;
}

std::string format_figure(double value) {
    return fmt::format("{:.{}f}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0);
}

}  // namespace gelatin
