#include "scenes/job/input/read_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "materials/base/error.hpp"
#include "scenes/job/input/way_log.hpp"

namespace diurna {

namespace {

constexpr double fastest_object = 1e4;  // [m/s]

constexpr const char* file_says =
    "CSV file instead of waypoints_m: time_s or time (ISO 8601); east_m, north_m or latitude_deg, "
    "longitude_deg; height_m; and, unless the front is the direction of motion, heading_deg, "
    "pitch_deg, roll_deg or qw, qx, qy, qz (of its right, forward, up to east, north, up)";

void read_file(const Section& section, TrajectoryInput& input) {
    input.file = section.file("file", file_says);
    if (!std::filesystem::is_regular_file(input.file)) return;
    try {
        WayLog log = read_way_log(input.file);
        if (section.has("start") && log.start) {
            section.mistake("start", "cannot be combined with a file that has a column time");
        }
        if (log.start) input.start = *log.start;
        input.way = std::move(log.way);
        input.geodetic = log.geodetic;
    } catch (const InputError& error) {
        section.mistake("file", error.what());
    }
}

const char* waypoints_key(const Section& section) {
    return section.has("waypoints") ? "waypoints" : "waypoints_m";
}

/// East, north [m] and height.
void read_waypoint_places(const Section& section, const ScenePlaces& places,
                          TrajectoryInput& input) {
    if (!section.has("waypoints")) {
        for (const std::vector<double>& row : section.rows(
                 "waypoints_m", "[[east, north, height], ...], with times_s or speed_m_s", 3, 2)) {
            input.way.place.emplace_back(row[0], row[1], row[2]);
        }
        return;
    }
    if (section.has("waypoints_m")) {
        section.mistake("waypoints_m", "cannot be combined with waypoints");
    }
    const std::vector<std::vector<double>> rows = section.rows(
        "waypoints",
        "[[latitude, longitude, height], ...] instead of waypoints_m, or in the CRS of place_crs",
        3, 2);
    const std::vector<Geodetic> found = places.geodetic(section, "waypoints", rows);
    bool sound = !section.has_mistakes();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const HeightInput height{rows[i][2], input.heights};
        Eigen::Vector2d at(double(i), 0.0);  // another one after a mistake, which is reported once
        if (sound) at = places.at(section, "waypoints", found[i], height);
        sound = sound && !section.has_mistakes();
        input.way.place.emplace_back(at.x(), at.y(), height.metres);
    }
}

/// Waypoints of the scene file with their seconds, or with a speed.
void read_waypoints(const Section& section, const ScenePlaces& places, TrajectoryInput& input) {
    read_waypoint_places(section, places, input);
    const std::size_t count = input.way.place.size();
    if (section.has("speed_m_s")) {
        input.way.seconds = seconds_at_speed(
            input.way.place, section.number("speed_m_s", "constant speed, instead of times_s",
                                            {0.01, fastest_object}));
        if (section.has("times_s")) {
            section.mistake("times_s", "cannot be combined with speed_m_s");
        }
    } else {
        input.way.seconds =
            section.numbers("times_s", "times of the waypoints after `start`; or give speed_m_s");
        if (input.way.seconds.size() != count && !section.has_mistakes()) {
            section.mistake("times_s", fmt::format("has {} numbers for {} waypoints",
                                                   input.way.seconds.size(), count));
        }
    }
    for (std::size_t i = 1; i < input.way.seconds.size(); ++i) {
        if (!(input.way.seconds[i] <= input.way.seconds[i - 1])) continue;
        if (section.has("speed_m_s")) {
            section.mistake(waypoints_key(section),
                            fmt::format("waypoint {} has the place of waypoint {}, which a "
                                        "constant speed does not permit",
                                        i + 1, i),
                            "use times_s instead of speed_m_s for a stop");
        } else {
            section.mistake("times_s", fmt::format("time {} is not later than time {}", i + 1, i));
        }
        break;
    }
}

/// What a way must be to be gone: else one that can be takes its place, and the mistake is
/// reported.
void check_way(const Section& section, TrajectoryInput& input) {
    Trajectory& way = input.way;
    const std::string key = input.file.empty() ? waypoints_key(section) : "file";
    const bool ascending =
        std::adjacent_find(way.seconds.begin(), way.seconds.end(),
                           [](double a, double b) { return !(b > a); }) == way.seconds.end();
    if (way.place.size() < 2 || way.seconds.size() != way.place.size() || !ascending) {
        way = {.seconds = {0.0, 1.0}, .place = {{0, 0, 1}, {0, 0, 1}}};
        input.geodetic = false;
        return;
    }
    if (way.smooth && way.place.size() < 3) {
        section.mistake(
            "curve",
            fmt::format("has {} places, expected at least 3 for a smooth curve", way.place.size()));
        way.smooth = false;
    }
    if (input.geodetic) return;
    for (std::size_t i = 1; i < way.place.size(); ++i) {
        const double speed =
            (way.place[i] - way.place[i - 1]).norm() / (way.seconds[i] - way.seconds[i - 1]);
        if (speed <= fastest_object) continue;
        section.mistake(
            key, fmt::format("moves at {:.0f} m/s from row {} to row {}, expected at most {:g} m/s",
                             speed, i, i + 1, fastest_object));
        break;
    }
}

TrajectoryInput read_trajectory(const Section& section, const TimeInput& time,
                                const ScenePlaces& places) {
    TrajectoryInput input;
    input.where = section.where();
    input.name = section.text("name", "name by which observers and objects refer to it");
    input.start = time.start;
    if (section.has("start")) {
        const std::string said = section.moment(
            "start", "instant of second 0; default: start of the span, or the file's first time");
        try {
            input.start = parse_instant(said, "start");
        } catch (const InputError& error) {
            section.mistake("start", error.mistakes().front().problem);
        }
    }
    input.heights = section.choice_or("heights",
                                      "zero of its heights: the ground below at every instant, the "
                                      "sea, or the WGS84 ellipsoid as given by GPS",
                                      HeightOver::ground,
                                      {{"ground", HeightOver::ground},
                                       {"sea", HeightOver::sea},
                                       {"ellipsoid", HeightOver::ellipsoid}});
    if (section.has("file")) {
        read_file(section, input);
        for (const char* key : {"waypoints_m", "waypoints", "times_s", "speed_m_s"}) {
            if (section.has(key))
                section.mistake(key, "cannot be combined with file, which gives it");
        }
    } else {
        read_waypoints(section, places, input);
    }
    input.way.smooth = section.choice_or("curve",
                                         "interpolation between places: straight at constant "
                                         "speed, or smooth, a cubic curve through three or more",
                                         false, {{"straight", false}, {"smooth", true}});
    check_way(section, input);
    if (input.way.smooth && section.has("speed_m_s") && !section.has("file")) {
        const double speed =
            (input.way.place[1] - input.way.place[0]).norm() / input.way.seconds[1];
        input.way = smooth_at_speed(input.way.place, speed);
    }
    input.sound = !section.has_mistakes();
    return input;
}

}  // namespace

std::vector<TrajectoryInput> read_trajectories(const Section& root, const TimeInput& time,
                                               const ScenePlaces& places) {
    std::vector<TrajectoryInput> ways;
    for (const Section& section :
         root.sections("trajectory", "a trajectory of observers and objects")) {
        TrajectoryInput way = read_trajectory(section, time, places);
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
