#include "scenes/input/read_time.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/input/read_frames.hpp"

namespace diurna {

namespace {

constexpr double time_day = 86400.0, longest_hours = 8784.0;

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

void read_spin_up(const Section& section, TimeInput& time) {
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
    time.state = section.file_named("state", state);
    time.state_where = section.where("state");
}

}  // namespace

TimeInput read_time(const Section& section, const std::optional<Site>& site) {
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
                time.duration = time_day;
            }
        }
    }
    time.step = section.number_or(
        "step_s", "of the heat balance, rounded so that steps fill each day", 600.0, {1.0, 3600.0});
    read_spin_up(section, time);
    time.days_before = section.integer_or(
        "spin_up_days", "days of weather before the start, at most; the first of them repeated", 3,
        {1, 366});
    Frames frames = read_frames(section, {.begin = time.start,
                                          .end = time.end(),
                                          .utc_offset = time.utc_offset,
                                          .every = 3600.0,
                                          .site = site});
    time.frames = std::move(frames.frame);
    time.frames_note = std::move(frames.note);
    return time;
}

}  // namespace diurna
