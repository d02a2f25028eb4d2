#include "scenes/charts/clock_names.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "terrain/place/local_time.hpp"

namespace diurna {

std::string clock_time(Instant instant, double utc_offset) {
    const std::string text = format_local(instant, utc_offset);  // 2026-07-15T05:12:00-04:00
    const std::string seconds = text.substr(16, text.size() - 6 - 16);
    return text.substr(11, 5) + (seconds == ":00" ? "" : seconds);
}

std::string clock_day(Instant instant, double utc_offset) {
    static constexpr std::array months = {"January",   "February", "March",    "April",
                                          "May",       "June",     "July",     "August",
                                          "September", "October",  "November", "December"};
    const std::string text = format_local(instant, utc_offset);
    const auto month = static_cast<std::size_t>(std::stoi(text.substr(5, 2)) - 1);
    return fmt::format("{} {}", std::stoi(text.substr(8, 2)), months.at(month));
}

std::string clock_zone(double utc_offset) {
    const int minutes = static_cast<int>(std::lround(std::abs(utc_offset) / 60.0));
    return fmt::format("UTC{}{:02}:{:02}", utc_offset < 0.0 ? "−" : "+", minutes / 60,
                       minutes % 60);
}

}  // namespace diurna
