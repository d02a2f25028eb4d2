#pragma once

#include <chrono>
#include <cmath>
#include <string>

namespace diurna {

/// A moment in UTC, to the millisecond.
using Instant = std::chrono::sys_time<std::chrono::milliseconds>;

/// Parses ISO 8601 with an explicit offset: 2003-10-17T12:30:30-07:00, 2003-10-17T19:30Z,
/// seconds may have decimals. Throws InputError(where, ...) for anything else.
Instant parse_instant(const std::string& text, const std::string& where = "time");

/// Offset of such a text from UTC [s], positive ahead of it, from its end: Z or ±hh:mm.
double utc_offset_of(const std::string& text);

/// "2003-10-17T19:30:30Z"; with `compact` "20031017T193030Z", suitable for file names. Milliseconds
/// are shown only if not zero.
std::string format_instant(Instant instant, bool compact = false);

/// Seconds from `from` to `to`.
inline double seconds_between(Instant from, Instant to) {
    return std::chrono::duration<double>(to - from).count();
}
inline Instant later(Instant instant, double seconds) {
    return instant + std::chrono::milliseconds(static_cast<long long>(std::llround(seconds * 1e3)));
}

}  // namespace diurna
