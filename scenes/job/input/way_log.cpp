#include "scenes/job/input/way_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

namespace diurna {

namespace {

const std::vector<std::string> known = {
    "time",     "time_s",      "east_m",    "north_m",  "latitude_deg", "longitude_deg",
    "height_m", "heading_deg", "pitch_deg", "roll_deg", "qw",           "qx",
    "qy",       "qz"};

/// Columns of which a file has one or the other.
constexpr std::array<std::array<const char*, 2>, 6> either = {{{"time", "time_s"},
                                                               {"east_m", "latitude_deg"},
                                                               {"east_m", "longitude_deg"},
                                                               {"north_m", "latitude_deg"},
                                                               {"north_m", "longitude_deg"},
                                                               {"heading_deg", "qw"}}};

/// Columns that mean nothing without another.
constexpr std::array<std::array<const char*, 2>, 5> together = {{{"pitch_deg", "heading_deg"},
                                                                 {"roll_deg", "heading_deg"},
                                                                 {"qx", "qw"},
                                                                 {"qy", "qw"},
                                                                 {"qz", "qw"}}};

std::array<std::size_t, 3> log_columns(const CsvTable& table, std::array<const char*, 3> names) {
    return {table.column(names[0]), table.column(names[1]), table.column(names[2])};
}

/// The file, and where what stands in it goes.
struct Reader {
    const CsvTable& table;
    WayLog& log;

    bool has(const char* column) const { return table.has(column); }
    void check_columns() const;
    void read_times() const;
    void read_places() const;
    void read_attitudes() const;
    Eigen::Vector3d numbers(std::size_t row, std::span<const std::size_t> column) const;
};

void Reader::check_columns() const {
    const std::vector<std::string>& header = table.header;
    for (auto name = header.begin(); name != header.end(); ++name) {
        const std::string where = table.path.string();
        if (std::find(known.begin(), known.end(), *name) == known.end()) {
            throw InputError(where, fmt::format("unknown column '{}'", *name),
                             did_you_mean(*name, known));
        }
        if (std::find(header.begin(), name, *name) != name) {
            throw InputError(where, fmt::format("has column '{}' twice", *name));
        }
    }
    for (const auto& [one, other] : either) {
        if (!has(one) || !has(other)) continue;
        throw InputError(
            table.path.string(),
            fmt::format("has columns '{}' and '{}', expected only one of them", one, other));
    }
    for (const auto& [part, of] : together) {
        if (!has(part) || has(of)) continue;
        throw InputError(table.path.string(),
                         fmt::format("has column '{}' without '{}'", part, of));
    }
}

void Reader::read_places() const {
    const auto place =
        log_columns(table, log.geodetic ? std::array{"longitude_deg", "latitude_deg", "height_m"}
                                        : std::array{"east_m", "north_m", "height_m"});
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const Eigen::Vector3d at = numbers(row, place);
        if (log.geodetic && !(std::abs(at.y()) <= 90.0 && std::abs(at.x()) <= 360.0)) {
            throw InputError(
                table.where(row, place[1]),
                fmt::format("latitude {:g}, longitude {:g} is not a place", at.y(), at.x()));
        }
        log.way.place.push_back(at);
    }
}

Eigen::Vector3d Reader::numbers(std::size_t row, std::span<const std::size_t> column) const {
    return {table.number(row, column[0]), table.number(row, column[1]),
            table.number(row, column[2])};
}

/// Seconds from the start, or instants of which the first is the start.
void Reader::read_times() const {
    const bool instants = table.has("time");
    const std::size_t column = table.column(instants ? "time" : "time_s");
    std::vector<double>& seconds = log.way.seconds;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::string where = table.where(row, column);
        if (instants) {
            const Instant when = parse_instant(table.rows[row][column], where);
            if (row == 0) log.start = when;
            seconds.push_back(seconds_between(*log.start, when));
        } else {
            seconds.push_back(table.number(row, column));
        }
        if (row > 0 && !(seconds[row] > seconds[row - 1])) {
            throw InputError(where, fmt::format("found {}, not later than the previous row",
                                                table.rows[row][column]));
        }
    }
}

void Reader::read_attitudes() const {
    std::vector<Eigen::Quaterniond>& attitudes = log.way.attitude;
    if (table.has("qw")) {
        const auto vector = log_columns(table, {"qx", "qy", "qz"});
        const std::size_t scalar = table.column("qw");
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            const Eigen::Vector3d v = numbers(row, vector);
            const Eigen::Quaterniond turn(table.number(row, scalar), v.x(), v.y(), v.z());
            if (std::abs(turn.norm() - 1.0) > 1e-2) {
                throw InputError(
                    table.where(row, scalar),
                    fmt::format("found a quaternion of length {:g}, expected 1", turn.norm()));
            }
            attitudes.push_back(turn.normalized());
        }
    } else if (table.has("heading_deg")) {
        const std::size_t heading = table.column("heading_deg");
        const auto or_level = [&](std::size_t row, const char* name) {
            return table.has(name) ? table.number(row, table.column(name)) : 0.0;
        };
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            attitudes.push_back(attitude(table.number(row, heading), or_level(row, "pitch_deg"),
                                         or_level(row, "roll_deg")));
        }
    }
}

}  // namespace

WayLog read_way_log(const std::filesystem::path& file) {
    const CsvTable table = read_csv(file);
    if (table.rows.size() < 2) {
        throw InputError(file.string(), "has fewer than two rows, expected a trajectory");
    }
    WayLog log;
    log.geodetic = table.has("latitude_deg") || table.has("longitude_deg");
    const Reader reader{table, log};
    reader.check_columns();
    reader.read_times();
    reader.read_places();
    reader.read_attitudes();
    return log;
}

}  // namespace diurna
