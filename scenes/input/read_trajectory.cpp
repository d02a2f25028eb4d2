#include "scenes/input/read_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

namespace diurna {

namespace {

using Heights = TrajectoryInput::Heights;

constexpr double fastest = 1e4;  // [m/s]

/// A table of a way in a file: which of its columns hold what.
class WayTable {
 public:
    explicit WayTable(const std::filesystem::path& file) : table_(read_csv(file)) {
        if (table_.rows.size() < 2) {
            throw InputError(file.string(), "has fewer than two rows, expected a way");
        }
    }

    bool geodetic() const { return table_.has("latitude_deg") || table_.has("longitude_deg"); }
    bool has(const char* column) const { return table_.has(column); }

    void read(TrajectoryInput& input) const {
        read_times(input);
        const auto place = geodetic() ? columns({"longitude_deg", "latitude_deg", "height_m"})
                                      : columns({"east_m", "north_m", "height_m"});
        for (std::size_t row = 0; row < table_.rows.size(); ++row) {
            const Eigen::Vector3d at = numbers(row, place);
            if (geodetic() && !(std::abs(at.y()) <= 90.0 && std::abs(at.x()) <= 360.0)) {
                throw InputError(
                    table_.where(row, place[1]),
                    fmt::format("latitude {:g}, longitude {:g} is no place", at.y(), at.x()));
            }
            input.way.place.push_back(at);
        }
        read_attitudes(input);
    }

 private:
    template <std::size_t count>
    std::array<std::size_t, count> columns(const std::array<const char*, count>& names) const {
        std::array<std::size_t, count> found{};
        for (std::size_t i = 0; i < count; ++i) found[i] = table_.column(names[i]);
        return found;
    }
    std::array<std::size_t, 3> columns(std::initializer_list<const char*> names) const {
        std::array<std::size_t, 3> found{};
        std::transform(names.begin(), names.end(), found.begin(),
                       [&](const char* name) { return table_.column(name); });
        return found;
    }
    Eigen::Vector3d numbers(std::size_t row, const std::array<std::size_t, 3>& column) const {
        return {table_.number(row, column[0]), table_.number(row, column[1]),
                table_.number(row, column[2])};
    }

    /// Seconds from the start, or instants of which the first is the start.
    void read_times(TrajectoryInput& input) const {
        const bool instants = table_.has("time");
        const std::size_t column = table_.column(instants ? "time" : "time_s");
        std::vector<double>& seconds = input.way.seconds;
        for (std::size_t row = 0; row < table_.rows.size(); ++row) {
            const std::string where = table_.where(row, column);
            if (instants) {
                const Instant when = parse_instant(table_.rows[row][column], where);
                if (row == 0) input.start = when;
                seconds.push_back(seconds_between(input.start, when));
            } else {
                seconds.push_back(table_.number(row, column));
            }
            if (row > 0 && !(seconds[row] > seconds[row - 1])) {
                throw InputError(where, fmt::format("found {}, not later than the row before",
                                                    table_.rows[row][column]));
            }
        }
    }

    void read_attitudes(TrajectoryInput& input) const {
        std::vector<Eigen::Quaterniond>& attitudes = input.way.attitude;
        if (table_.has("qw")) {
            const auto vector = columns({"qx", "qy", "qz"});
            const std::size_t scalar = table_.column("qw");
            for (std::size_t row = 0; row < table_.rows.size(); ++row) {
                const Eigen::Vector3d v = numbers(row, vector);
                const Eigen::Quaterniond turn(table_.number(row, scalar), v.x(), v.y(), v.z());
                if (std::abs(turn.norm() - 1.0) > 1e-2) {
                    throw InputError(
                        table_.where(row, scalar),
                        fmt::format("found a quaternion of length {:g}, expected 1", turn.norm()));
                }
                attitudes.push_back(turn.normalized());
            }
        } else if (table_.has("heading_deg")) {
            const std::size_t heading = table_.column("heading_deg");
            const auto or_level = [&](std::size_t row, const char* name) {
                return table_.has(name) ? table_.number(row, table_.column(name)) : 0.0;
            };
            for (std::size_t row = 0; row < table_.rows.size(); ++row) {
                attitudes.push_back(attitude(table_.number(row, heading),
                                             or_level(row, "pitch_deg"),
                                             or_level(row, "roll_deg")));
            }
        }
    }

    CsvTable table_;
};

constexpr const char* file_says =
    "CSV in place of waypoints_m: time_s or time (ISO 8601); east_m, north_m or latitude_deg, "
    "longitude_deg; height_m; and, unless it faces its way, heading_deg, pitch_deg, roll_deg or "
    "qw, qx, qy, qz (of its right, forward, up to east, north, up)";

void read_file(const Section& section, const Reading& reading, TrajectoryInput& input) {
    input.file = reading.file(section, "file", file_says);
    if (!std::filesystem::is_regular_file(input.file)) return;
    try {
        const WayTable table(input.file);
        if (section.has("start") && table.has("time")) {
            section.mistake("start", "stands beside a file whose column time says it");
        }
        table.read(input);
        input.geodetic = table.geodetic();
    } catch (const InputError& error) {
        section.mistake("file", error.what());
    }
}

/// Waypoints of the scene file with their seconds, or with a speed.
void read_waypoints(const Section& section, TrajectoryInput& input) {
    for (const std::vector<double>& row : section.rows(
             "waypoints_m", "[[east, north, height], ...], with times_s or speed_m_s", 3, 2)) {
        input.way.place.emplace_back(row[0], row[1], row[2]);
    }
    const std::size_t count = input.way.place.size();
    if (section.has("speed_m_s")) {
        input.way.seconds = seconds_at_speed(
            input.way.place,
            section.number("speed_m_s", "all the way, in place of times_s", {0.01, fastest}));
        if (section.has("times_s")) {
            section.mistake("times_s", "stands beside speed_m_s, expected one of the two");
        }
    } else {
        input.way.seconds =
            section.numbers("times_s", "of the waypoints, from `start` on; or speed_m_s");
        if (input.way.seconds.size() != count) {
            section.mistake("times_s", fmt::format("has {} numbers for {} waypoints",
                                                   input.way.seconds.size(), count));
        }
    }
    for (std::size_t i = 1; i < input.way.seconds.size(); ++i) {
        if (input.way.seconds[i] > input.way.seconds[i - 1]) continue;
        section.mistake(section.has("speed_m_s") ? "waypoints_m" : "times_s",
                        fmt::format("number {} is not later than number {}", i + 1, i));
        break;
    }
}

/// What a way must be to be gone: else one that can be takes its place, and the mistake is told.
void check_way(const Section& section, TrajectoryInput& input) {
    Trajectory& way = input.way;
    const std::string key = input.file.empty() ? "waypoints_m" : "file";
    const bool ascending = std::is_sorted(way.seconds.begin(), way.seconds.end());
    if (way.place.size() < 2 || way.seconds.size() != way.place.size() || !ascending) {
        way = {.seconds = {0.0, 1.0}, .place = {{0, 0, 1}, {0, 0, 1}}};
        input.geodetic = false;
        return;
    }
    if (way.smooth && way.place.size() < 3) {
        section.mistake("curve", fmt::format("has {} places, expected 3 or more of a smooth curve",
                                             way.place.size()));
        way.smooth = false;
    }
    if (input.geodetic) return;
    for (std::size_t i = 1; i < way.place.size(); ++i) {
        const double speed =
            (way.place[i] - way.place[i - 1]).norm() / (way.seconds[i] - way.seconds[i - 1]);
        if (speed <= fastest) continue;
        section.mistake(key, fmt::format("goes at {:.0f} m/s from row {} to row {}, expected at "
                                         "most {:g}",
                                         speed, i, i + 1, fastest));
        break;
    }
}

TrajectoryInput read_trajectory(const Section& section, const Reading& reading,
                                const TimeInput& time) {
    TrajectoryInput input;
    input.where = section.where();
    input.name = section.text("name", "by which observers and objects name it");
    input.start = time.start;
    if (section.has("start")) {
        const std::string said =
            section.moment("start", "of second 0; else the span's, or the file's first");
        try {
            input.start = parse_instant(said, "start");
        } catch (const InputError& error) {
            section.mistake("start", error.mistakes().front().problem);
        }
    }
    if (section.has("file")) {
        read_file(section, reading, input);
        if (section.has("waypoints_m")) {
            section.mistake("waypoints_m", "stands beside file, expected one of the two");
        }
    } else {
        read_waypoints(section, input);
    }
    input.way.smooth = section.choice_or(
        "curve",
        "between places: straight at even speed, or smooth, a cubic, through three or more", false,
        {{"straight", false}, {"smooth", true}});
    input.heights = section.choice_or(
        "heights",
        "what its heights are above: the ground beneath at every "
        "instant, the sea, or, of latitudes and longitudes, the ellipsoid",
        Heights::ground,
        {{"ground", Heights::ground}, {"sea", Heights::sea}, {"ellipsoid", Heights::ellipsoid}});
    check_way(section, input);
    if (input.heights == Heights::ellipsoid && !input.geodetic) {
        section.mistake("heights", "\"ellipsoid\" is for files of latitudes and longitudes");
    }
    return input;
}

}  // namespace

std::vector<TrajectoryInput> read_trajectories(const Section& root, const Reading& reading,
                                               const TimeInput& time) {
    std::vector<TrajectoryInput> ways;
    for (const Section& section :
         root.sections("trajectory", "a way that observers and objects go")) {
        TrajectoryInput way = read_trajectory(section, reading, time);
        if (find_trajectory(ways, way.name) != nullptr) {
            section.mistake("name", fmt::format("another trajectory is named \"{}\"", way.name));
        }
        ways.push_back(std::move(way));
    }
    return ways;
}

const TrajectoryInput* find_trajectory(const std::vector<TrajectoryInput>& ways,
                                       const std::string& name) {
    const auto found = std::find_if(ways.begin(), ways.end(),
                                    [&](const TrajectoryInput& way) { return way.name == name; });
    return found == ways.end() ? nullptr : &*found;
}

}  // namespace diurna
