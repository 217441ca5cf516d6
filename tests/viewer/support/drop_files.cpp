#include "viewer/support/drop_files.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <initializer_list>
#include <thread>

namespace gelatin::test {
namespace {

constexpr long kVersion = 5;

/// A program that something is dragged from.
class Source {
public:
    Source() : display_(XOpenDisplay(nullptr)) {
        if (display_ == nullptr) return;
        window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
    }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    ~Source() {
        if (display_ != nullptr) XCloseDisplay(display_);
    }

    bool is_open() const { return display_ != nullptr; }

    Window find(const std::string& title, Window below = 0) const {
        if (below == 0) below = DefaultRootWindow(display_);
        Window root = 0, parent = 0, *children = nullptr, found = 0;
        unsigned count = 0;
        if (XQueryTree(display_, below, &root, &parent, &children, &count) == 0) return 0;
        for (unsigned i = 0; i < count && found == 0; ++i) {
            char* name = nullptr;
            if (XFetchName(display_, children[i], &name) != 0) {
                if (std::string(name).find(title) != std::string::npos) found = children[i];
                XFree(name);
            }
            if (found == 0) found = find(title, children[i]);
        }
        if (children != nullptr) XFree(children);
        return found;
    }

    void send(Window target, const char* type, std::initializer_list<long> data) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(window_);
        int i = 1;
        for (const long value : data) event.xclient.data.l[i++] = value;
        XSendEvent(display_, target, False, NoEventMask, &event);
        XFlush(display_);
    }

    // Serves who asks for the data meanwhile.
    bool wait_for(const char* type, const std::string& data) const {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        while (std::chrono::steady_clock::now() < end) {
            if (XPending(display_) == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                continue;
            }
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return true;
            if (event.type == SelectionRequest) give(event.xselectionrequest, data);
        }
        return false;
    }

    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

private:
    void give(const XSelectionRequestEvent& request, const std::string& data) const {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(data.data()), static_cast<int>(data.size()));
        XEvent answer{};
        answer.xselection.type = SelectionNotify;
        answer.xselection.requestor = request.requestor;
        answer.xselection.selection = request.selection;
        answer.xselection.target = request.target;
        answer.xselection.property = request.property;
        answer.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &answer);
        XFlush(display_);
    }

    Display* display_;
    Window window_ = 0;
};

}  // namespace

std::string drop_files(const std::string& title, const std::vector<std::filesystem::path>& files) {
    const Source source;
    if (!source.is_open()) return "no display";
    const Window target = source.find(title);
    if (target == 0) return "no window with that title";
    std::string data;
    for (const std::filesystem::path& file : files) data += "file://" + file.string() + "\r\n";
    source.send(target, "XdndEnter", {kVersion << 24, static_cast<long>(source.atom("text/uri-list")), 0, 0});
    const long place = 300L << 16 | 200L;
    source.send(target, "XdndPosition",
                {0, place, CurrentTime, static_cast<long>(source.atom("XdndActionCopy"))});
    if (!source.wait_for("XdndStatus", data)) return "the window does not answer";
    source.send(target, "XdndDrop", {0, CurrentTime});
    if (!source.wait_for("XdndFinished", data)) return "the window does not take it";
    return {};
}

}  // namespace gelatin::test
