#include "gl/timer.h"

#include <epoxy/gl.h>

namespace gelatin::gl {

TimestampStageTimer::~TimestampStageTimer() {
    for (const Pending& pending : pending_) {
        glDeleteQueries(1, &pending.start);
        if (pending.stop != 0) glDeleteQueries(1, &pending.stop);
    }
    if (!free_.empty()) glDeleteQueries(static_cast<GLsizei>(free_.size()), free_.data());
}

unsigned TimestampStageTimer::new_query() {
    if (free_.empty()) {
        free_.resize(32);
        glGenQueries(static_cast<GLsizei>(free_.size()), free_.data());
    }
    const unsigned query = free_.back();
    free_.pop_back();
    return query;
}

void TimestampStageTimer::begin(const std::string& stage) {
    open_.push_back(taken_ + pending_.size());
    pending_.push_back({stage, new_query(), 0});
    glQueryCounter(pending_.back().start, GL_TIMESTAMP);
}

void TimestampStageTimer::end() {
    Pending& last = pending_[open_.back() - taken_];
    open_.pop_back();
    last.stop = new_query();
    glQueryCounter(last.stop, GL_TIMESTAMP);
}

void TimestampStageTimer::collect(bool wait) {
    while (!pending_.empty() && pending_.front().stop != 0) {
        const Pending& oldest = pending_.front();
        GLint available = GL_FALSE;
        glGetQueryObjectiv(oldest.stop, GL_QUERY_RESULT_AVAILABLE, &available);
        if (!available && !wait) return;
        GLuint64 start = 0;
        GLuint64 stop = 0;
        glGetQueryObjectui64v(oldest.start, GL_QUERY_RESULT, &start);
        glGetQueryObjectui64v(oldest.stop, GL_QUERY_RESULT, &stop);
        constexpr double kMillisecondsPerTick = 1e-6;
        times_[oldest.stage].push_back(stop > start ? static_cast<double>(stop - start) * kMillisecondsPerTick
                                                    : 0.0);
        free_.push_back(oldest.start);
        free_.push_back(oldest.stop);
        pending_.pop_front();
        ++taken_;
    }
}

StageTimes TimestampStageTimer::take() {
    collect(false);
    return std::exchange(times_, {});
}

void TimestampStageTimer::finish() {
    collect(true);
}

}  // namespace gelatin::gl
