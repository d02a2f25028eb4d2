#include "scenes/job/input/frames_at_sun.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terrain/place/local_time.hpp"
#include "terrain/place/sun_passages.hpp"

namespace diurna {

namespace {

constexpr double day_length = 86400.0;

/// The day of an instant on the clock of the span.
std::string date_of(Instant when, const FrameSpan& span) {
    return format_local(when, span.utc_offset).substr(0, 10);
}

/// The days that the span is part of and that have no passage, from the first of each run of them
/// to its last.
std::string missed_days(const std::vector<Instant>& passage, Instant midnight, Instant end,
                        const FrameSpan& span) {
    std::vector<std::pair<Instant, Instant>> runs;
    std::size_t days = 0, missed = 0;
    for (Instant at = midnight; at < end; at = later(at, day_length)) {
        ++days;
        const auto first = std::lower_bound(passage.begin(), passage.end(), at);
        if (first != passage.end() && *first < later(at, day_length)) continue;
        ++missed;
        if (!runs.empty() && later(runs.back().second, day_length) == at) {
            runs.back().second = at;
        } else {
            runs.emplace_back(at, at);
        }
    }
    if (missed == 0) return "";
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(runs.size(), 4); ++i) {
        const auto& [from, to] = runs[i];
        text += (i > 0 ? ", " : "") + date_of(from, span);
        if (to > from) text += " to " + date_of(to, span);
    }
    if (runs.size() > 4) text += ", ...";
    return fmt::format("on {} of {} days the sun does not reach it: {}", missed, days, text);
}

}  // namespace

Frames read_frames_at_sun(const Section& section, const FrameSpan& span) {
    const Section sun =
        section.section("frames_at_sun",
                        "replaces frames and frame_every_s (needs [site]): one picture, to the "
                        "second, whenever the sun reaches an azimuth or an elevation");
    const bool by_azimuth = sun.has("azimuth_deg");
    double azimuth = 0.0, elevation = 0.0;
    DayHalf half = DayHalf::both;
    if (by_azimuth) {
        azimuth =
            sun.number("azimuth_deg", "azimuth of the sun, clockwise from north, while it is up",
                       {-360.0, 360.0});
        for (const char* key : {"elevation_deg", "half"}) {
            if (sun.has(key)) sun.mistake(key, "cannot be combined with azimuth_deg");
        }
    } else {
        elevation = sun.number(
            "elevation_deg",
            "elevation of the sun above the horizon, without refraction; or give azimuth_deg",
            {-20.0, 90.0});
        half =
            sun.choice_or("half", "half of the day: before noon, after it, or both", DayHalf::both,
                          {{"morning", DayHalf::morning},
                           {"afternoon", DayHalf::afternoon},
                           {"both", DayHalf::both}});
    }
    if (sun.has_mistakes()) return {};
    if (!span.site) {
        section.mistake(
            "frames_at_sun",
            "depends on the sun's position, expected [site] with latitude_deg and longitude_deg");
        return {};
    }
    Site site = *span.site;
    if (std::isnan(site.height)) site.height = 0.0;
    const double since = std::chrono::duration<double>(span.begin.time_since_epoch()).count();
    const Instant midnight =
        later(span.begin, std::floor((since + span.utc_offset) / day_length) * day_length -
                              span.utc_offset - since);
    const double days = std::ceil(seconds_between(midnight, span.end) / day_length - 1e-9);
    const Instant end = later(midnight, days * day_length);
    const std::vector<Instant> passage =
        by_azimuth ? sun_at_azimuth(site, midnight, end, azimuth)
                   : sun_at_elevation(site, midnight, end, elevation, half);
    Frames frames;
    std::copy_if(passage.begin(), passage.end(), std::back_inserter(frames.frame),
                 [&](Instant at) { return at >= span.begin && at <= span.end; });
    frames.note = missed_days(passage, midnight, end, span);
    if (frames.frame.empty()) {
        section.mistake("frames_at_sun",
                        frames.note.empty()
                            ? "the sun reaches this position only outside " + span.said
                            : fmt::format("has no picture: {}", frames.note));
    }
    return frames;
}

}  // namespace diurna
