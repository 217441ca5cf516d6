#include "bench/bar_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/markdown_table.h"

namespace gelatin {
namespace {

// Grey, blue and orange of Okabe and Ito (2008), which colour-blind people can distinguish.
constexpr std::array<const char*, 3> kColors{"#9a9a9a", "#0072b2", "#e69f00"};

// Pixels.
constexpr double kWidth = 860, kMargin = 24, kLabels = 250, kValues = 60;
constexpr double kBar = 13, kBarGap = 2, kGroupGap = 12, kPanelGap = 26;
constexpr double kTitle = 68;  // title and legend
constexpr double kPanelTitle = 28, kAxis = 24;

std::string escape(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&') {
            escaped += "&amp;";
        } else if (c == '<') {
            escaped += "&lt;";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

class Picture {
public:
    explicit Picture(const BarChart& chart);
    std::string draw();

private:
    double x(double value) const;
    void rectangle(double x, double y, double width, double height, const char* color);
    void line(double x0, double y0, double x1, double y1, const char* color);
    void text(double x, double y, const std::string& text, const char* style);

    void draw_legend();
    void draw_panel(const BarChart::Panel& panel);
    void draw_axis(double height);
    void draw_bar(const BarChart::Bar& bar);

    const BarChart& chart_;
    double low_ = 1e300, high_ = 0.0;  // exponents of ten at the ends of the axis
    double y_ = kTitle;
    std::string body_;
};

double height_of(const BarChart::Panel& panel) {
    double height = kGroupGap;
    for (const BarChart::Group& group : panel.groups)
        height += static_cast<double>(group.bars.size()) * (kBar + kBarGap) + kGroupGap;
    return height;
}

Picture::Picture(const BarChart& chart) : chart_(chart) {
    double least = 1e300, most = 0.0;
    for (const BarChart::Panel& panel : chart.panels) {
        for (const BarChart::Group& group : panel.groups) {
            for (const BarChart::Bar& bar : group.bars) {
                least = std::min(least, bar.low);
                most = std::max(most, bar.high);
            }
        }
    }
    if (most == 0.0) least = most = 1.0;         // no bars
    low_ = std::floor(std::log10(least) - 0.1);  // a bar at the very end would have no length
    high_ = std::ceil(std::log10(most));
}

double Picture::x(double value) const {
    const double left = kMargin + kLabels, right = kWidth - kMargin - kValues;
    return left + (right - left) * (std::log10(value) - low_) / (high_ - low_);
}

void Picture::rectangle(double x, double y, double width, double height, const char* color) {
    body_ += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)", x, y,
                         width, height, color) +
             "\n";
}

void Picture::line(double x0, double y0, double x1, double y1, const char* color) {
    body_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}"/>)", x0, y0, x1,
                         y1, color) +
             "\n";
}

void Picture::text(double x, double y, const std::string& text, const char* style) {
    body_ +=
        fmt::format(R"(<text x="{:.1f}" y="{:.1f}" class="{}">{}</text>)", x, y, style, escape(text)) + "\n";
}

void Picture::draw_legend() {
    text(kMargin, 30, chart_.title, "title");
    double left = kMargin + kLabels;
    for (std::size_t s = 0; s < chart_.series.size(); ++s) {
        rectangle(left, 44, kBar, kBar, kColors[s]);
        text(left + kBar + 6, 55, chart_.series[s], "label");
        left += 130;
    }
}

void Picture::draw_axis(double height) {
    for (double decade = low_; decade <= high_; ++decade) {
        const double value = std::pow(10.0, decade);
        line(x(value), y_, x(value), y_ + height, "#d8d8d8");
        text(x(value), y_ + height + 16, fmt::format("{:g}", value), "tick");
    }
}

void Picture::draw_bar(const BarChart::Bar& bar) {
    const double left = x(std::pow(10.0, low_)), middle = y_ + kBar / 2;
    rectangle(left, y_, x(bar.value) - left, kBar, kColors[bar.series]);
    if (bar.high > bar.low) {
        line(x(bar.low), middle, x(bar.high), middle, "#222");
        for (const double end : {bar.low, bar.high}) line(x(end), middle - 3, x(end), middle + 3, "#222");
    }
    text(x(bar.high) + 5, y_ + kBar - 3, format_figure(bar.value), "value");
    y_ += kBar + kBarGap;
}

void Picture::draw_panel(const BarChart::Panel& panel) {
    text(kMargin, y_ + 18, panel.title, "panel");
    y_ += kPanelTitle;
    const double height = height_of(panel);
    draw_axis(height);
    y_ += kGroupGap;
    for (const BarChart::Group& group : panel.groups) {
        const double group_height = static_cast<double>(group.bars.size()) * (kBar + kBarGap);
        text(kMargin + kLabels - 10, y_ + group_height / 2 + 3, group.label, "group");
        for (const BarChart::Bar& bar : group.bars) draw_bar(bar);
        y_ += kGroupGap;
    }
    y_ += kAxis + kPanelGap;
}

std::string Picture::draw() {
    draw_legend();
    for (const BarChart::Panel& panel : chart_.panels) draw_panel(panel);
    return fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}">
<style>
text {{ font: 12px system-ui, "DejaVu Sans", sans-serif; fill: #222; }}
.title {{ font-size: 16px; font-weight: bold; }}
.panel {{ font-size: 14px; font-weight: bold; }}
.group {{ text-anchor: end; }}
.tick {{ text-anchor: middle; fill: #666; font-size: 11px; }}
.value {{ font-size: 11px; }}
</style>
<rect width="100%" height="100%" fill="#fff"/>
{2}</svg>
)",
        kWidth, y_ - kPanelGap + 10, body_);
}

}  // namespace

std::string to_svg(const BarChart& chart) {
    return Picture(chart).draw();
}

}  // namespace gelatin
