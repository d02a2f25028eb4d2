#include "thermal/point/schedule_clock.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace diurna {

double scheduled(const Schedule& schedule, double otherwise, double utc_offset, Instant when) {
    if (schedule.empty()) return otherwise;
    const double seconds = std::chrono::duration<double>(when.time_since_epoch()).count();
    double hour = std::fmod((seconds + utc_offset) / 3600.0, 24.0);
    if (hour < 0.0) hour += 24.0;
    if (hour < schedule.front()[0]) hour += 24.0;
    for (std::size_t i = 0; i < schedule.size(); ++i) {
        const bool last = i + 1 == schedule.size();
        const double from = schedule[i][0];
        const double to = last ? schedule.front()[0] + 24.0 : schedule[i + 1][0];
        if (hour > to) continue;
        const double next = last ? schedule.front()[1] : schedule[i + 1][1];
        return to > from ? std::lerp(schedule[i][1], next, (hour - from) / (to - from)) : next;
    }
    return schedule.front()[1];
}

std::string schedule_key(const ThermalSurface& surface) {
    if (!surface.internal_schedule.empty()) return "internal_schedule";
    const auto* room = std::get_if<Interior>(&surface.bottom);
    return room && !room->schedule.empty() ? "bottom.schedule" : "";
}

std::string schedule_clock_note(const Site& site, double utc_offset) {
    constexpr double day = 86400.0;
    // Mean solar time less the clock's, to the nearer side of the day.
    double ahead = std::remainder(site.longitude_deg * 240.0 - utc_offset, day);
    if (std::abs(ahead) < 60.0) return "";
    const int clock = int(std::lround(std::abs(utc_offset) / 60.0));
    const int apart = int(std::lround(std::abs(ahead) / 60.0));
    return fmt::format(
        "hours are on the clock of time.start, UTC{}{:02}:{:02}, like the operating hours of "
        "objects; earlier versions used local mean solar time, which is {} h {:02} min {} that "
        "clock at this site",
        utc_offset < 0.0 ? '-' : '+', clock / 60, clock % 60, apart / 60, apart % 60,
        ahead > 0.0 ? "ahead of" : "behind");
}

}  // namespace diurna
