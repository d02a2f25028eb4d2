#pragma once

#include <filesystem>
#include <optional>

#include "terrain/place/instant.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

/// A log of a trajectory.
struct WayLog {
    Trajectory way;  // seconds from `start`, or as the file has them
    bool geodetic = false;
    std::optional<Instant> start{};  // in files with instants
};

/// Reads one, in CSV:
///
///     time_s or time (ISO 8601); east_m, north_m or latitude_deg, longitude_deg; height_m;
///     heading_deg, pitch_deg, roll_deg or qw, qx, qy, qz (of its right, forward, up to east,
///     north, up)
///
/// Throws InputError with the file's line and column; also for unknown columns, for duplicate
/// names, and for two columns with the same meaning.
WayLog read_way_log(const std::filesystem::path& file);

}  // namespace diurna
