#pragma once

namespace gelatin::python {

/// Has the library's messages wait for tell_messages. They come from any thread, and may not wait for the
/// interpreter's lock there: the thread that has it may be waiting for theirs.
void collect_messages();

/// Gives the messages that wait to Python's logger "gelatin". Needs the interpreter's lock.
void tell_messages() noexcept;

/// Reports messages where it ends, also by an exception.
struct MessagesAtEnd {
    MessagesAtEnd() = default;
    MessagesAtEnd(const MessagesAtEnd&) = delete;
    MessagesAtEnd& operator=(const MessagesAtEnd&) = delete;
    ~MessagesAtEnd() { tell_messages(); }
};

}  // namespace gelatin::python
