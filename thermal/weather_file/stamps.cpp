#include "thermal/weather_file/stamps.hpp"

#include <cmath>
#include <cstdio>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// "202307070030" of FLUXNET as "2023-07-07T00:30", also with seconds or without a clock.
void spread_digits(std::string& text) {
    if (text.find_first_not_of("0123456789") != std::string::npos) return;
    if (text.size() != 8 && text.size() != 12 && text.size() != 14) return;
    const std::string digits = text + (text.size() == 8 ? "0000" : "");
    text = digits.substr(0, 4) + "-" + digits.substr(4, 2) + "-" + digits.substr(6, 2) + "T" +
           digits.substr(8, 2) + ":" + digits.substr(10, 2);
    if (digits.size() == 14) text += ":" + digits.substr(12, 2);
}

}  // namespace

Instant stamp_in(std::string text, double offset_h, const std::string& where) {
    constexpr std::size_t date_length = 10;  // of 2022-01-01
    constexpr double day = 86400.0;          // [s]
    spread_digits(text);
    if (text.size() >= date_length && text[4] == '/' && text[7] == '/') text[4] = text[7] = '-';
    if (const std::size_t mark = text.find_first_of("/."); mark == 1 || mark == 2) {
        throw InputError(where, "found '" + text.substr(0, 40) + "', expected ISO 8601",
                         "write it as 2003-10-17T12:30:30-07:00, or declare its order: "
                         "[weather.columns] time = \"time_mdy -07:00\" (month first) or "
                         "\"time_dmy -07:00\" (day first)");
    }
    if (text.size() > date_length && text[date_length] == ' ') text[date_length] = 'T';
    // The end of a day.
    const bool midnight = text.size() > date_length + 5 && text.substr(date_length, 6) == "T24:00";
    if (midnight) {
        text.replace(date_length, 6, "T00:00");
        return later(stamp_in(text, offset_h, where), day);
    }
    if (text.size() > date_length + 4 && text.ends_with(" UTC")) {
        text.replace(text.size() - 4, 4, "Z");
    }
    const bool has_offset =
        text.size() > date_length && text.find_first_of("Z+-", date_length) != std::string::npos;
    if (!has_offset && std::isnan(offset_h)) {
        parse_instant(text + "Z", where);  // throws where that is not all it lacks
        throw InputError(where, "found '" + text + "' without a UTC offset",
                         "add it to each time, 2003-10-17T12:30:30-07:00, or set it once: "
                         "[weather.columns] time = \"time -07:00\"");
    }
    // pandas' %z: "+0000", or "+00".
    const std::size_t sign = has_offset ? text.find_last_of("+-") : std::string::npos;
    if (sign != std::string::npos && sign > date_length &&
        text.find_first_not_of("0123456789", sign + 1) == std::string::npos) {
        const std::size_t digits = text.size() - sign - 1;
        if (digits == 4) text.insert(sign + 3, ":");
        if (digits == 2) text += ":00";
    }
    if (has_offset) return parse_instant(text, where);
    return later(parse_instant(text + "Z", where), -3600.0 * offset_h);
}

bool offset_in(const std::string& word, double& offset_h) {
    if (word == "UTC" || word == "Z" || word == "GMT") {
        offset_h = 0.0;
        return true;
    }
    int hours = 0, minutes = 0, taken = 0;
    char sign = 0;
    if (std::sscanf(word.c_str(), "%c%2d:%2d%n", &sign, &hours, &minutes, &taken) != 3 ||
        taken != int(word.size()) || (sign != '+' && sign != '-') || hours > 15 || minutes > 59) {
        return false;
    }
    offset_h = (sign == '-' ? -1.0 : 1.0) * (hours + minutes / 60.0);
    return true;
}

}  // namespace diurna
