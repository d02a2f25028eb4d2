#include "scenes/input/read_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double day = 86400.0, longest_hours = 8784.0;
constexpr std::size_t most_frames = 100000;

/// The instant that a key says; none, with a mistake, where it is no instant.
std::optional<Instant> instant_of(const Section& section, const std::string& key,
                                  const std::string& text) {
    try {
        return parse_instant(text, key);
    } catch (const InputError& error) {
        section.mistake(key, error.mistakes().front().problem);
        return std::nullopt;
    }
}

/// [s] that local clocks are ahead of UTC, by the end of an instant's text: Z or ±hh:mm.
double offset_of(const std::string& instant) {
    int hours = 0, minutes = 0;
    if (instant.size() < 6) return 0.0;
    const std::string end = instant.substr(instant.size() - 6);
    if ((end[0] != '+' && end[0] != '-') ||
        std::sscanf(end.c_str() + 1, "%2d:%2d", &hours, &minutes) != 2) {
        return 0.0;
    }
    return (end[0] == '-' ? -1.0 : 1.0) * (3600.0 * hours + 60.0 * minutes);
}

/// "05:00-09:00 every 10 min": the same hours of every day, on the clock of the span's start.
struct Window {
    double from, to, every;  // [s] of the day; [s]
};
std::optional<Window> window_of(const std::string& text) {
    int h1 = 0, m1 = 0, h2 = 0, m2 = 0, used = 0;
    double every = 0.0;
    char unit[8] = {};
    if (std::sscanf(text.c_str(), "%2d:%2d-%2d:%2d every %lf %7[a-z]%n", &h1, &m1, &h2, &m2, &every,
                    unit, &used) != 6 ||
        std::size_t(used) != text.size()) {
        return std::nullopt;
    }
    const std::string word = unit;
    const double scale = word == "s" ? 1.0 : word == "min" ? 60.0 : word == "h" ? 3600.0 : 0.0;
    Window window{3600.0 * h1 + 60.0 * m1, 3600.0 * h2 + 60.0 * m2, every * scale};
    const bool within_a_day = window.from < day && window.to <= day && window.from != window.to;
    if (window.to < window.from) window.to += day;  // over midnight
    const bool good = m1 < 60 && m2 < 60 && within_a_day && window.every >= 1.0;
    return good ? std::optional(window) : std::nullopt;
}

void add_window(const Window& window, double offset, const TimeInput& time,
                std::vector<Instant>& frames) {
    const double since = std::chrono::duration<double>(time.start.time_since_epoch()).count();
    const double midnight = std::floor((since + offset) / day) * day - offset;
    // From the day before: a window may go over midnight.
    for (double of_day = midnight - since - day; of_day <= time.duration; of_day += day) {
        const auto count = static_cast<long>((window.to - window.from) / window.every + 1e-9);
        for (long i = 0; i <= count && frames.size() <= most_frames; ++i) {
            const double at = of_day + window.from + double(i) * window.every;
            if (at >= 0.0 && at <= time.duration) frames.push_back(later(time.start, at));
        }
    }
}

std::vector<Instant> read_frames(const Section& section, double offset, const TimeInput& time) {
    std::vector<Instant> frames;
    const std::vector<std::string> texts = section.texts_or(
        "frames",
        "when pictures are taken, in place of frame_every_s: instants with their offset from UTC, "
        "or windows of every day, \"05:00-09:00 every 10 min\" (s, min, h), on the clock of start",
        {});
    if (section.has("frames") && texts.empty()) {
        section.mistake("frames", "found no instant, expected one or more, or windows of a day",
                        "without the key a picture is taken every frame_every_s");
    }
    for (const std::string& text : texts) {
        if (const auto window = window_of(text)) {
            add_window(*window, offset, time, frames);
            continue;
        }
        try {
            frames.push_back(parse_instant(text, "frames"));
        } catch (const InputError&) {
            section.mistake("frames", fmt::format("found '{}', expected an instant as "
                                                  "2026-07-15T06:00:00-04:00 or a window as "
                                                  "05:00-09:00 every 10 min",
                                                  text.substr(0, 60)));
            continue;
        }
        if (frames.back() < time.start || frames.back() > time.end()) {
            section.mistake("frames", fmt::format("{} lies outside the span", text));
        }
    }
    const double every =
        section.number_or("frame_every_s", "between pictures from the start on, without the end",
                          3600.0, {1.0, 366.0 * day});
    if (texts.empty()) {
        const auto count = static_cast<std::size_t>(std::ceil(time.duration / every - 1e-9));
        for (std::size_t i = 0; i < std::min(count, most_frames + 1); ++i) {
            frames.push_back(later(time.start, double(i) * every));
        }
    } else if (section.has("frame_every_s")) {
        section.mistake("frame_every_s", "stands beside frames, expected one of the two");
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    if (frames.size() > most_frames) {
        section.mistake(texts.empty() ? "frame_every_s" : "frames",
                        fmt::format("asks for more than {} pictures", most_frames));
    }
    return frames;
}

void read_spin_up(const Section& section, const std::filesystem::path& folder, TimeInput& time) {
    time.spin_up = section.choice_or(
        "spin_up",
        "what went before: the weather of the days before (default where the file has them), the "
        "first 24 hours repeated without their trend (default else), the balance of the first "
        "day's mean, or the state that an earlier run left (default where state is given)",
        SpanStart::known,
        {{"auto", SpanStart::known},
         {"weather", SpanStart::weather},
         {"periodic", SpanStart::periodic},
         {"steady", SpanStart::steady},
         {"state", SpanStart::state}});
    const std::string state = section.text_or(
        "state", "file of an earlier run of this scene with output.state, that ended at start", "");
    if (state.empty()) {
        if (time.spin_up == SpanStart::state) {
            section.mistake("spin_up", "goes on from a state, but no file is given as state");
        }
        return;
    }
    if (time.spin_up != SpanStart::known && time.spin_up != SpanStart::state) {
        section.mistake("state", "stands beside a spin_up that does not go on from it");
    }
    time.spin_up = SpanStart::state;
    time.state = folder / state;
    time.state_where = section.where("state");
    if (!std::filesystem::is_regular_file(time.state)) {
        section.mistake("state", fmt::format("no such file: {}", time.state.string()));
    }
}

}  // namespace

TimeInput read_time(const Section& section, const std::filesystem::path& folder) {
    TimeInput time;
    const std::string said = section.moment("start", "of the span, with its offset from UTC");
    const auto start = instant_of(section, "start", said);
    if (start) time.start = *start;
    time.utc_offset = offset_of(said);
    const double hours = section.number_or("duration_h", "of the span, minutes to a year", 24.0,
                                           {1.0 / 60.0, longest_hours});
    time.duration = 3600.0 * hours;
    if (section.has("end")) {
        const auto end =
            instant_of(section, "end", section.moment("end", "of the span, for duration_h"));
        if (section.has("duration_h")) {
            section.mistake("end", "stands beside duration_h, expected one of the two");
        } else if (end && start) {
            time.duration = seconds_between(*start, *end);
            if (!(time.duration >= 60.0 && time.duration <= 3600.0 * longest_hours)) {
                section.mistake("end", fmt::format("lies {:g} h after start, expected a minute to "
                                                   "{:g} h",
                                                   time.duration / 3600.0, longest_hours));
                time.duration = day;
            }
        }
    }
    time.step = section.number_or(
        "step_s", "of the heat balance, rounded so that steps fill each day", 600.0, {1.0, 3600.0});
    read_spin_up(section, folder, time);
    time.days_before = section.integer_or(
        "spin_up_days", "days of weather before the start, at most; the first of them repeated", 3,
        {1, 366});
    time.frames = read_frames(section, time.utc_offset, time);
    return time;
}

}  // namespace diurna
