#include "scenes/job/input/read_time.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/input/read_frames.hpp"

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

void read_spin_up(const Section& section, TimeInput& time) {
    time.spin_up = section.choice_or(
        "spin_up",
        "start of the heat balance: weather of the days before (default if the file has them), the "
        "first 24 hours repeated without their trend (default otherwise), the balance of the first "
        "day's mean, or the saved state of an earlier run (default if state is given)",
        SpanStart::known,
        {{"auto", SpanStart::known},
         {"weather", SpanStart::weather},
         {"periodic", SpanStart::periodic},
         {"steady", SpanStart::steady},
         {"state", SpanStart::state}});
    const std::string state = section.text_or(
        "state", "state file of an earlier run of this scene with output.state that ended at start",
        "");
    if (state.empty()) {
        if (time.spin_up == SpanStart::state) {
            section.mistake("spin_up", "needs a state file, but the key state is missing");
        }
        return;
    }
    if (time.spin_up != SpanStart::known && time.spin_up != SpanStart::state) {
        section.mistake("state", "cannot be combined with a spin_up other than \"state\"");
    }
    time.spin_up = SpanStart::state;
    time.state = section.file_named("state", state);
    time.state_where = section.where("state");
}

}  // namespace

TimeInput read_time(const Section& section, const std::optional<Site>& site) {
    TimeInput time;
    const std::string said = section.moment("start", "start of the span, with its UTC offset");
    const auto start = instant_of(section, "start", said);
    if (start) time.start = *start;
    time.utc_offset = utc_offset_of(said);
    const double hours = section.number_or("duration_h", "length of the span, minutes to a year",
                                           24.0, {1.0 / 60.0, longest_hours});
    time.duration = 3600.0 * hours;
    if (section.has("end")) {
        const auto end = instant_of(
            section, "end", section.moment("end", "end of the span, instead of duration_h"));
        if (section.has("duration_h")) {
            section.mistake("end", "cannot be combined with duration_h");
        } else if (end && start) {
            time.duration = seconds_between(*start, *end);
            if (!(time.duration >= 60.0 && time.duration <= 3600.0 * longest_hours)) {
                section.mistake("end",
                                fmt::format("is {:g} h after start, expected a minute to {:g} h",
                                            time.duration / 3600.0, longest_hours));
                time.duration = time_day;
            }
        }
    }
    time.step = section.number_or(
        "step_s",
        "step of the heat balance, rounded so that a whole number of steps fills a day; weather "
        "between two steps is not used, so under clouds of minutes as short as the weather's rows",
        600.0, {1.0, 3600.0});
    read_spin_up(section, time);
    time.days_before = section.integer_or(
        "spin_up_days",
        "largest number of days of weather before the start; the first of them is repeated", 3,
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
