#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "input.h"
#include "item_boxes.h"
#include "panels.h"
#include "picture_texture.h"
#include "recent_files.h"
#include "sample_scenes.h"

namespace gelatin::viewer {

/// A gallery: the files opened last, and the scenes that come with Gelatin, each with a picture and a line.
/// Its items are chosen with the mouse, or with the arrow keys and Enter.
class StartScreen {
public:
    /// Reads pictures when it is first drawn.
    explicit StartScreen(RecentFiles recent = RecentFiles());

    /// What was opened will be among the files opened last.
    void remember(const RecentFiles::Files& files);

    /// @return false if the key is none of its own
    bool take(const KeyPress& press);

    /// @param can_close whether something is behind it
    /// @pre between Window::begin_frame and Window::draw_panels
    void draw(float scale, bool can_close, Requests& requests);

    /// What an item opens, in the order in which they are drawn; and where that was [pixels]. For tests.
    std::size_t item_count() const { return items_.size(); }
    const RecentFiles::Files& files_of(std::size_t item) const { return items_[item].files; }
    const std::vector<ItemBox>& boxes() const { return boxes_; }
    std::optional<std::size_t> selected() const { return selected_; }

private:
    struct Item {
        RecentFiles::Files files;
        std::string name, line;
        bool is_missing = false;
        PictureTexture picture = {};
    };
    void list_recent();
    void read_pictures();
    void draw_recent(float scale);
    void draw_samples(float scale);
    void draw_card(const Item& item, float scale) const;
    void finish_item(std::size_t index, bool is_clicked, float scale);

    RecentFiles recent_;
    std::vector<SampleScene> samples_;
    std::vector<Item> items_;  // first what was opened last
    std::size_t recent_count_ = 0;
    bool has_pictures_ = false;
    std::vector<ItemBox> boxes_;  // of the items, in the last picture
    std::optional<std::size_t> selected_, chosen_;
    bool follows_selection_ = false;
};

}  // namespace gelatin::viewer
