#include "terrain/place/instant.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

using namespace std::chrono;

/// Takes text from the front; any mismatch makes the whole parse fail.
class Reader {
 public:
    explicit Reader(std::string_view text) : rest_(text) {}

    bool character(char c) {
        if (rest_.empty() || rest_.front() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }
    bool digits(std::size_t count, int& value) {
        if (rest_.size() < count) return false;
        for (std::size_t i = 0; i < count; ++i) {
            if (rest_[i] < '0' || rest_[i] > '9') return false;
        }
        std::from_chars(rest_.data(), rest_.data() + count, value);
        rest_.remove_prefix(count);
        return true;
    }
    /// Decimals of a second, rounded to milliseconds.
    bool fraction(int& milliseconds_value) {
        double value = 0.0, unit = 0.1;
        std::size_t count = 0;
        for (; count < rest_.size() && rest_[count] >= '0' && rest_[count] <= '9'; ++count) {
            value += unit * (rest_[count] - '0');
            unit *= 0.1;
        }
        rest_.remove_prefix(count);
        milliseconds_value = static_cast<int>(std::lround(value * 1e3));
        return count > 0;
    }
    bool at_end() const { return rest_.empty(); }

 private:
    std::string_view rest_;
};

}  // namespace

Instant parse_instant(const std::string& text, const std::string& where) {
    const auto refuse = [&](const std::string& why) {
        return InputError(where, fmt::format("found '{}'; {}", text, why),
                          "write it as 2003-10-17T12:30:30-07:00 or 2003-10-17T19:30:30Z");
    };
    Reader read(text);
    int y = 0, mo = 0, d = 0, h = 0, mi = 0, s = 0, ms = 0;
    if (!(read.digits(4, y) && read.character('-') && read.digits(2, mo) && read.character('-') &&
          read.digits(2, d) && read.character('T') && read.digits(2, h) && read.character(':') &&
          read.digits(2, mi))) {
        throw refuse("expected a date and time in ISO 8601");
    }
    if (read.character(':')) {
        if (!read.digits(2, s)) throw refuse("expected two digits of seconds");
        if (read.character('.') && !read.fraction(ms)) throw refuse("expected digits after '.'");
    }
    int offset_min = 0;
    if (!read.character('Z')) {
        const bool east = read.character('+');
        int oh = 0, om = 0;
        if ((!east && !read.character('-')) || !read.digits(2, oh) || !read.character(':') ||
            !read.digits(2, om)) {
            throw refuse("expected 'Z' or a UTC offset such as -07:00");
        }
        if (oh > 15 || om > 59) throw refuse("the UTC offset is too large");
        offset_min = (east ? 1 : -1) * (60 * oh + om);
    }
    if (!read.at_end()) throw refuse("found more text after the UTC offset");

    const year_month_day date{year(y), month(static_cast<unsigned>(mo)),
                              day(static_cast<unsigned>(d))};
    if (!date.ok()) throw refuse("the date does not exist");
    if (h > 23 || mi > 59 || s > 59) throw refuse("the time of day does not exist");
    return Instant(sys_days(date)) + hours(h) + minutes(mi) + seconds(s) + milliseconds(ms) -
           minutes(offset_min);
}

double utc_offset_of(const std::string& text) {
    if (text.size() < 6) return 0.0;
    Reader read(std::string_view(text).substr(text.size() - 6));
    const bool east = read.character('+');
    int hour = 0, minute = 0;
    if ((!east && !read.character('-')) || !read.digits(2, hour) || !read.character(':') ||
        !read.digits(2, minute)) {
        return 0.0;
    }
    return (east ? 1.0 : -1.0) * (3600.0 * hour + 60.0 * minute);
}

std::string format_instant(Instant instant, bool compact) {
    const auto midnight = floor<days>(instant);
    const year_month_day date(midnight);
    const hh_mm_ss time(instant - midnight);
    const auto ms = time.subseconds().count();
    const std::string decimals = ms == 0 ? "" : fmt::format(".{:03}", ms);
    const char* pattern =
        compact ? "{:04}{:02}{:02}T{:02}{:02}{:02}{}Z" : "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}Z";
    return fmt::format(fmt::runtime(pattern), static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       time.hours().count(), time.minutes().count(), time.seconds().count(),
                       decimals);
}

}  // namespace diurna
