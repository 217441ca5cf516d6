#include "start_screen.h"

#include <GLFW/glfw3.h>
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <utility>

#include "core/log.h"
#include "render/image.h"

namespace gelatin::viewer {
namespace {

constexpr float kCardWidth = 230.0f;  // at least, at the usual density
constexpr float kPictureShape = 9.0f / 16.0f;
constexpr float kPadding = 8.0f;
constexpr float kTextLines = 4.0f;  // the name, and its line in up to three

constexpr ImU32 kCard = IM_COL32(40, 43, 50, 255), kPointedCard = IM_COL32(55, 68, 84, 255),
                kNoPicture = IM_COL32(30, 32, 37, 255), kSelection = IM_COL32(107, 189, 232, 255),
                kName = IM_COL32_WHITE, kLine = IM_COL32(165, 170, 178, 255);

std::string name_of(const RecentFiles::Files& files) {
    const std::string name = files.front().filename().string();
    return files.size() == 1 ? name : fmt::format("{} and {} more", name, files.size() - 1);
}

bool is_any_missing(const RecentFiles::Files& files) {
    std::error_code error;
    return std::any_of(files.begin(), files.end(),
                       [&](const auto& file) { return !std::filesystem::exists(file, error); });
}

// Whether the lines below the name are enough for it.
bool fits(const std::string& text, float width) {
    const float most = (kTextLines - 0.5f) * ImGui::GetTextLineHeight();
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y < most;
}

}  // namespace

StartScreen::StartScreen(RecentFiles recent) : recent_(std::move(recent)), samples_(sample_scenes()) {
    list_recent();
    for (const SampleScene& sample : samples_)
        items_.push_back({{sample.file}, sample.file.stem().string(), sample.line});
}

void StartScreen::remember(const RecentFiles::Files& files) {
    recent_.add(files);
    list_recent();
}

void StartScreen::list_recent() {
    items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(recent_count_));
    std::vector<Item> recent;
    for (const RecentFiles::Files& files : recent_.all()) {
        std::string paths;
        for (const auto& file : files) paths += (paths.empty() ? "" : "\n") + file.string();
        recent.push_back({files, name_of(files), std::move(paths), is_any_missing(files)});
    }
    recent_count_ = recent.size();
    items_.insert(items_.begin(), std::make_move_iterator(recent.begin()),
                  std::make_move_iterator(recent.end()));
    boxes_.clear();
    selected_.reset();
}

// A scene of the user's own has none.
void StartScreen::read_pictures() {
    for (std::size_t s = 0; s < samples_.size(); ++s) {
        std::error_code error;
        if (!std::filesystem::exists(samples_[s].picture, error)) continue;
        try {
            items_[recent_count_ + s].picture = PictureTexture(render::read_png(samples_[s].picture));
        } catch (const std::exception& problem) {  // a damaged file may claim any size, too
            log_warning(problem.what());
        }
    }
}

bool StartScreen::take(const KeyPress& press) {
    constexpr int kPage = 3;  // rows
    if (press.with_control || press.with_shift || boxes_.size() != items_.size() || items_.empty())
        return false;
    const auto go = [&](Direction direction, int times) {
        if (!selected_) {
            selected_ = 0;
            --times;
        }
        for (int k = 0; k < times; ++k) selected_ = next_item(boxes_, *selected_, direction);
    };
    switch (press.key) {
        case GLFW_KEY_LEFT:
            go(Direction::left, 1);
            break;
        case GLFW_KEY_RIGHT:
            go(Direction::right, 1);
            break;
        case GLFW_KEY_UP:
            go(Direction::up, 1);
            break;
        case GLFW_KEY_DOWN:
            go(Direction::down, 1);
            break;
        case GLFW_KEY_PAGE_UP:
            go(Direction::up, kPage);
            break;
        case GLFW_KEY_PAGE_DOWN:
            go(Direction::down, kPage);
            break;
        case GLFW_KEY_HOME:
            selected_ = 0;
            break;
        case GLFW_KEY_END:
            selected_ = items_.size() - 1;
            break;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
            chosen_ = selected_;
            return true;
        default:
            return false;
    }
    follows_selection_ = true;
    return true;
}

void StartScreen::draw(float scale, bool can_close, Requests& requests) {
    if (!std::exchange(has_pictures_, true)) read_pictures();
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::SetNextWindowBgAlpha(can_close ? 0.97f : 0.6f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("start", nullptr,
                 (ImGuiWindowFlags_NoDecoration & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
    if (ImGui::IsWindowAppearing()) list_recent();
    boxes_.clear();
    ImGui::TextUnformatted("Gelatin");
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("Choose a scene, or drop a scene or a mesh onto this window. %s",
                        can_close ? "Esc: back. F1: help" : "F1: help");
    ImGui::PopTextWrapPos();
    draw_recent(scale);
    draw_samples(scale);
    ImGui::End();
    ImGui::PopStyleVar();
    follows_selection_ = false;
    if (const auto chosen = std::exchange(chosen_, {})) requests.opened = items_[*chosen].files;
}

// As many buttons in a line as fit.
void StartScreen::draw_recent(float scale) {
    if (recent_count_ == 0) return;
    ImGui::Spacing();
    ImGui::TextUnformatted("Opened last");
    const ImGuiStyle& style = ImGui::GetStyle();
    const float end = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    float x = end;  // where the next one would begin
    for (std::size_t i = 0; i < recent_count_; ++i) {
        const Item& item = items_[i];
        const std::string label = item.is_missing ? item.name + " (missing)" : item.name;
        const float width = std::min(ImGui::CalcTextSize(label.c_str()).x + 2.0f * style.FramePadding.x,
                                     ImGui::GetContentRegionAvail().x);
        if (i > 0 && x + width <= end) ImGui::SameLine();
        if (item.is_missing) ImGui::PushStyleColor(ImGuiCol_Text, style.Colors[ImGuiCol_TextDisabled]);
        const bool is_clicked = ImGui::Button(fmt::format("{}##{}", label, i).c_str(), {width, 0.0f});
        if (item.is_missing) ImGui::PopStyleColor();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", item.line.c_str());
        x = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + style.ItemSpacing.x;
        finish_item(i, is_clicked, scale);
    }
}

void StartScreen::draw_samples(float scale) {
    if (samples_.empty()) return;
    ImGui::Spacing();
    ImGui::TextUnformatted("Scenes");
    const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(static_cast<int>((room + gap) / (kCardWidth * scale + gap)), 1);
    // Whole pixels: Dear ImGui rounds places towards 0, and so otherwise than above the upper edge.
    const float width = std::max(
        std::floor((room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns)), 1.0f);
    const float height =
        std::ceil(width * kPictureShape + kTextLines * ImGui::GetTextLineHeight() + 2.0f * kPadding * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {gap, gap});
    for (std::size_t i = recent_count_; i < items_.size(); ++i) {
        if ((i - recent_count_) % static_cast<std::size_t>(columns) != 0) ImGui::SameLine();
        const bool is_clicked = ImGui::InvisibleButton(items_[i].name.c_str(), {width, height});
        draw_card(items_[i], scale);
        finish_item(i, is_clicked, scale);
    }
    ImGui::PopStyleVar();
}

// Over the last item.
void StartScreen::draw_card(const Item& item, float scale) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const float rounding = ImGui::GetStyle().FrameRounding, padding = kPadding * scale;
    list.AddRectFilled(low, high, ImGui::IsItemHovered() ? kPointedCard : kCard, rounding);
    const ImVec2 corner = {high.x, low.y + (high.x - low.x) * kPictureShape};  // of the picture
    if (item.picture.name() == 0) {
        list.AddRectFilled(low, corner, kNoPicture, rounding, ImDrawFlags_RoundCornersTop);
    } else {
        // Dear ImGui's backend takes OpenGL's names.
        // NOLINTNEXTLINE(performance-no-int-to-ptr)
        const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(item.picture.name()));
        list.AddImageRounded(texture, low, corner, {0.0f, 0.0f}, {1.0f, 1.0f}, IM_COL32_WHITE, rounding,
                             ImDrawFlags_RoundCornersTop);
    }
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 text = {low.x + padding, corner.y + padding};
    const ImVec4 clip = {text.x, text.y, high.x - padding, text.y + kTextLines * line};
    const auto write = [&](const std::string& words, float y, ImU32 color) {
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {text.x, y}, color, words.data(),
                     words.data() + words.size(), clip.z - clip.x, &clip);
    };
    write(item.name, text.y, kName);
    write(item.line, text.y + line, kLine);
    if (ImGui::IsItemHovered() && !fits(item.line, clip.z - clip.x)) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(320.0f * scale);
        ImGui::TextUnformatted(item.line.c_str());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

// What all items have in common, behind each.
void StartScreen::finish_item(std::size_t index, bool is_clicked, float scale) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    boxes_.push_back({{low.x, low.y}, {high.x, high.y}});
    if (is_clicked) chosen_ = index;
    if (selected_ != index) return;
    ImGui::GetWindowDrawList()->AddRect(low, high, kSelection, ImGui::GetStyle().FrameRounding, 0,
                                        2.0f * scale);
    if (!follows_selection_) return;
    const float margin = ImGui::GetStyle().WindowPadding.y, top = ImGui::GetWindowPos().y + margin,
                bottom = top + ImGui::GetWindowSize().y - 2.0f * margin;
    if (low.y < top) ImGui::SetScrollY(ImGui::GetScrollY() + low.y - top);
    if (high.y > bottom) ImGui::SetScrollY(ImGui::GetScrollY() + high.y - bottom);
}

}  // namespace gelatin::viewer
