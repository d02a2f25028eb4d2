#include "scenes/job/input/read_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "materials/base/error.hpp"
#include "scenes/job/input/frames_at_sun.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

constexpr double seconds_per_day = 86400.0;
constexpr std::size_t most_frames = 100000;
constexpr double shortest = 1e-3;  // [s] between pictures: instants are whole milliseconds

/// "12:00" or "12:00:30" as seconds of the day; moves on behind it.
std::optional<double> clock_time(const char*& text) {
    int h = 0, m = 0, used = 0;
    if (std::sscanf(text, "%2d:%2d%n", &h, &m, &used) != 2 || m > 59) return std::nullopt;
    text += used;
    int s = 0;
    if (*text == ':') {
        if (std::sscanf(text, ":%2d%n", &s, &used) != 1 || s > 59) return std::nullopt;
        text += used;
    }
    return 3600.0 * h + 60.0 * m + s;
}

/// "05:00-09:00 every 10 min": the same hours of every day, on the clock of the span's start.
struct Window {
    double from, to, every;  // [s] of the day; [s]
};
std::optional<Window> window_of(const std::string& text) {
    const char* at = text.c_str();
    const auto from = clock_time(at);
    if (!from || *at++ != '-') return std::nullopt;
    const auto to = clock_time(at);
    double every = 0.0;
    char unit[8] = {};
    int used = 0;
    if (!to || std::sscanf(at, " every %lf %7[a-z]%n", &every, unit, &used) != 2 || at[used]) {
        return std::nullopt;
    }
    const std::string word = unit;
    const double scale = word == "s" ? 1.0 : word == "min" ? 60.0 : word == "h" ? 3600.0 : 0.0;
    Window window{*from, *to, every * scale};
    const bool within_a_day =
        window.from < seconds_per_day && window.to <= seconds_per_day && window.from != window.to;
    if (window.to < window.from) window.to += seconds_per_day;  // over midnight
    return within_a_day && window.every >= shortest ? std::optional(window) : std::nullopt;
}

void add_window(const Window& window, const FrameSpan& span, std::vector<Instant>& frames) {
    const double duration = seconds_between(span.begin, span.end);
    const double since = std::chrono::duration<double>(span.begin.time_since_epoch()).count();
    const double midnight =
        std::floor((since + span.utc_offset) / seconds_per_day) * seconds_per_day - span.utc_offset;
    // From the day before: a window may go over midnight.
    for (double of_day = midnight - since - seconds_per_day; of_day <= duration;
         of_day += seconds_per_day) {
        const auto count = static_cast<long>((window.to - window.from) / window.every + 1e-9);
        for (long i = 0; i <= count && frames.size() <= most_frames; ++i) {
            const double at = of_day + window.from + double(i) * window.every;
            if (at >= 0.0 && at <= duration) frames.push_back(later(span.begin, at));
        }
    }
}

std::string outside(const std::string& text, const FrameSpan& span) {
    return fmt::format("{} is outside {}, {} to {}", text, span.said,
                       format_local(span.begin, span.utc_offset),
                       format_local(span.end, span.utc_offset));
}

/// The instant or the window that a text says.
void add_text(const Section& section, const std::string& text, const FrameSpan& span,
              std::vector<Instant>& frames) {
    if (const auto window = window_of(text)) {
        const std::size_t before = frames.size();
        add_window(*window, span, frames);
        if (frames.size() == before) {
            section.mistake("frames", outside(text, span));
        }
        return;
    }
    try {
        frames.push_back(parse_instant(text, "frames"));
    } catch (const InputError&) {
        section.mistake(
            "frames",
            fmt::format("found '{}', expected an instant such as 2026-07-15T06:00:00-04:00 or a "
                        "window such as 05:00-09:00 every 10 min",
                        text.substr(0, 60)));
        return;
    }
    if (frames.back() < span.begin || frames.back() > span.end) {
        section.mistake("frames", outside(text, span));
    }
}

}  // namespace

Frames read_frames(const Section& section, const FrameSpan& span) {
    Frames all;
    std::vector<Instant>& frames = all.frame;
    const std::vector<std::string> texts = section.texts_or(
        "frames",
        "instants of pictures, instead of frame_every_s: with UTC offset, or windows of every day, "
        "\"05:00-09:00 every 10 min\" (s, min, h), on the clock of start; a window includes both "
        "ends: 25 pictures",
        {});
    if (section.has("frames") && texts.empty() && !section.has_mistakes()) {
        section.mistake("frames", "found no instant, expected at least one, or windows of the day",
                        "without this key, pictures are taken every frame_every_s");
    }
    for (const std::string& text : texts) add_text(section, text, span, frames);
    const double every = section.number_or(
        "frame_every_s", "interval between frames, from the start; the end is excluded",
        {span.every, span.every_said}, {shortest, 366.0 * seconds_per_day});
    if (section.has("frames_at_sun")) {
        for (const char* key : {"frames", "frame_every_s"}) {
            if (section.has(key)) {
                section.mistake(key, "cannot be combined with frames_at_sun");
            }
        }
        return read_frames_at_sun(section, span);
    }
    if (texts.empty()) {
        const double duration = seconds_between(span.begin, span.end);
        const auto count = static_cast<std::size_t>(std::ceil(duration / every - 1e-9));
        for (std::size_t i = 0; i < std::min(count, most_frames + 1); ++i) {
            frames.push_back(later(span.begin, double(i) * every));
        }
    } else if (section.has("frame_every_s")) {
        section.mistake("frame_every_s", "cannot be combined with frames");
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    if (frames.size() > most_frames) {
        section.mistake(texts.empty() ? "frame_every_s" : "frames",
                        fmt::format("makes more than {} pictures", most_frames));
    }
    return all;
}

}  // namespace diurna
