#include "scenes/input/read_observer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "materials/base/units.hpp"
#include "scenes/input/checked_names.hpp"
#include "scenes/input/read_frames.hpp"

namespace diurna {

namespace {

/// The field of view from a focal plane behind a lens.
double read_lens(const Section& section, ObserverInput& observer) {
    const double focal_length = section.number(
        "focal_length_mm", "with pixel_pitch_um, of a pinhole: in place of horizontal_fov_deg",
        {0.1, 1e5});
    const double pitch =
        section.number("pixel_pitch_um", "with focal_length_mm: of its pixels", {0.1, 1e4});
    observer.pixel_pitch_um = pitch;
    const double fov_deg = field_of_view_deg(observer.width, pitch, focal_length);
    if (observer.projection != Projection::pinhole || section.has("horizontal_fov_deg")) {
        section.mistake("focal_length_mm", "is for pinhole cameras without horizontal_fov_deg");
    } else if (!(fov_deg <= 150.0)) {
        section.mistake(
            "focal_length_mm",
            fmt::format("makes a field of view of {:.1f} degrees, expected at most 150", fov_deg));
    }
    return fov_deg;
}

/// No pixel may look round the back of the sphere, where things are seen again.
void check_sphere(const Section& section, const ObserverInput& observer) {
    const double half = radians(0.5 * observer.horizontal_fov_deg);
    const double width = observer.width, height = observer.height;
    const char* key = section.has("height") ? "height" : "horizontal_fov_deg";
    if (observer.projection == Projection::panorama) {
        const double most = degrees(2.0 * half * height / width);
        if (most <= 180.0 + 1e-9) return;
        section.mistake(key,
                        fmt::format("rows of the panorama reach over {:.0f} degrees, expected at "
                                    "most 180",
                                    most),
                        fmt::format("height = {:.0f} is pole to pole at this width",
                                    std::floor(1e-6 + width * 90.0 / degrees(half))));
        return;
    }
    const bool even = observer.projection == Projection::equidistant;
    if (!even && observer.projection != Projection::equisolid) return;
    const double to_corner = std::hypot(1.0, height / width);
    const double law = even ? half * to_corner : std::sin(0.5 * half) * to_corner;
    if (law <= (even ? std::numbers::pi : 1.0) + 1e-9) return;
    section.mistake(
        key,
        "pixels in the corners of the fisheye's picture look round its back, "
        "expected at most 180 degrees off its axis",
        fmt::format("horizontal_fov_deg = {:.0f} is the whole sphere of this picture",
                    std::floor(1e-6 + degrees(even ? 2.0 * std::numbers::pi / to_corner
                                                   : 4.0 * std::asin(1.0 / to_corner)))));
}

/// A field of view, or the width of a picture of parallel rays.
void read_projection(const Section& section, ObserverInput& observer) {
    observer.projection =
        section.choice_or("projection", "how directions lie on the picture", Projection::pinhole,
                          {{"pinhole", Projection::pinhole},
                           {"equidistant", Projection::equidistant},
                           {"equisolid", Projection::equisolid},
                           {"panorama", Projection::panorama},
                           {"orthographic", Projection::orthographic}});
    if (observer.projection == Projection::orthographic) {
        observer.picture_width =
            section.number("picture_width_m", "that the picture is wide", {0.01, 2e5});
    } else if (section.has("focal_length_mm")) {
        observer.horizontal_fov_deg = read_lens(section, observer);
    } else {
        const bool pinhole = observer.projection == Projection::pinhole;
        observer.horizontal_fov_deg = section.number_or(
            "horizontal_fov_deg", "that the picture is wide; of a pinhole 20, at most 150",
            pinhole ? 20.0 : 180.0, {0.01, pinhole ? 150.0 : 360.0});
        check_sphere(section, observer);
    }
}

/// Whether its pictures' time tells anything: it goes, or something does.
bool sees_motion(const ObserverInput& observer, const TerrainInput& terrain) {
    return observer.goes() ||
           std::any_of(terrain.objects.begin(), terrain.objects.end(),
                       [](const ObjectInput& object) { return !object.trajectory.empty(); });
}

/// A camera that flies: rows read one after the other, each blurred by its exposure.
void read_motion(const Section& section, const TerrainInput& terrain, ObserverInput& observer) {
    if (section.has("velocity_m_s")) {
        const std::vector<double> velocity =
            section.numbers("velocity_m_s", "[east, north, up] of a camera that moves", 3);
        observer.velocity = {velocity[0], velocity[1], velocity[2]};
        if (!(observer.velocity.cwiseAbs().maxCoeff() <= 1e4)) {
            section.mistake("velocity_m_s", "faster than 10000 m/s");
        }
    }
    observer.row_time = section.number_or(
        "row_time_s",
        "of one that moves, or sees what does: from a row's reading to the next row's", 0.0,
        {0.0, 60.0});
    observer.exposure = section.number_or(
        "exposure_s", "of one that moves, or sees what does: that each row is exposed and blurred",
        0.0, {0.0, 60.0});
    if (observer.goes() || !observer.on.empty()) {
        if (section.has("velocity_m_s")) {
            section.mistake("velocity_m_s", observer.on.empty()
                                                ? "stands beside a trajectory, which has its own"
                                                : "stands beside on, whose object has its own");
        }
    }
    if (sees_motion(observer, terrain)) return;
    for (const char* key : {"row_time_s", "exposure_s"}) {
        if (section.has(key) && !section.has("velocity_m_s")) {
            section.mistake(
                key,
                "tells nothing of a camera that stands still where nothing goes, expected "
                "velocity_m_s = [east, north, up] or a trajectory beside it");
        }
    }
}

/// On an object, which goes or stands.
void read_ride(const Section& section, const TerrainInput& terrain, ObserverInput& observer) {
    Names known{.what = "object", .known = {}, .where = " in [[object]]"};
    for (const ObjectInput& object : terrain.objects) known.known.push_back(object.name);
    observer.on = section.name(
        "on", "object that its eye rides on, in place of place_m and height_above_ground_m", known);
    const std::vector<double> at = section.numbers(
        "mount_m",
        "[right, front, up] of its eye on that object, from the middle of its plan and its lowest "
        "point",
        3);
    observer.mount_place = {at[0], at[1], at[2]};
    if (!(observer.mount_place.cwiseAbs().maxCoeff() <= 1e4)) {
        section.mistake("mount_m", "further than 10000 m from its object");
        observer.mount_place.setZero();
    }
    for (const char* key : {"place_m", "height_above_ground_m", "trajectory"}) {
        if (section.has(key)) section.mistake(key, "stands beside on, whose object says it");
    }
    for (const ObjectInput& object : terrain.objects) {
        if (object.name != observer.on) continue;
        observer.trajectory = object.trajectory;
        const Eigen::Rotation2Dd turn(-radians(object.placing.heading_deg));
        observer.place = object.place + turn * Eigen::Vector2d(at[0], at[1]);
        observer.height_above_ground = std::max(0.1, object.height_above_ground + at[2]);
    }
}

/// Where its eye is.
void read_stand(const Section& section, const ObserverReading& reading, ObserverInput& observer) {
    if (section.has("on")) {
        read_ride(section, reading.terrain, observer);
        return;
    }
    if (section.has("mount_m")) {
        section.mistake("mount_m",
                        "is for observers that ride on an object, expected on beside it");
    }
    if (section.has("trajectory")) {
        Names ways{.what = "trajectory", .known = {}, .where = " in [[trajectory]]"};
        for (const TrajectoryInput& way : reading.trajectories) ways.known.push_back(way.name);
        observer.trajectory = section.name(
            "trajectory", "that its eye goes, in place of place_m and height_above_ground_m", ways);
        for (const char* key : {"place_m", "height_above_ground_m"}) {
            if (section.has(key)) section.mistake(key, "stands beside a trajectory, which says it");
        }
        return;
    }
    observer.place = place(section, "place_m", "[east, north] of its eye");
    observer.height_above_ground =
        section.number("height_above_ground_m", "of its eye", {0.1, 50000.0});
}

/// Which way it looks.
void read_pointing(const Section& section, const ObserverReading& reading,
                   ObserverInput& observer) {
    int ways = 0;
    for (const char* key : {"look_at_m", "look_at", "mount_deg"}) ways += section.has(key);
    if (ways > 1 || (ways == 1 && section.has("azimuth_deg"))) {
        section.mistake("",
                        "is pointed in more than one way, expected one of look_at_m, look_at, "
                        "mount_deg, and azimuth_deg with elevation_deg");
    }
    if (section.has("look_at_m")) {
        observer.look_at = place(section, "look_at_m",
                                 "[east, north] of the point of the ground in the middle of the "
                                 "picture; or azimuth_deg and elevation_deg");
    } else if (section.has("look_at")) {
        observer.look_at_object = section.name(
            "look_at", "the object whose middle is in the middle of the picture", reading.objects);
    } else if (section.has("mount_deg")) {
        const std::vector<double> angles = section.numbers(
            "mount_deg",
            "[azimuth, elevation, roll] of a camera on a trajectory or an object, to the right of "
            "and above the body's front: [0, -90, 0] looks down; its front is the way's, or as its "
            "file says",
            3);
        observer.mount = {angles[0], angles[1], angles[2]};
        if (!observer.goes() && observer.on.empty()) {
            section.mistake("mount_deg", "is for observers on a trajectory or an object");
        }
        if (section.has("roll_deg")) {
            section.mistake("roll_deg", "stands beside mount_deg, whose third number it is");
        }
    } else {
        observer.azimuth_deg =
            section.number("azimuth_deg", "it looks, clockwise from north", {-360.0, 360.0});
        observer.elevation_deg =
            section.number("elevation_deg", "it looks, above the horizon", {-90.0, 90.0});
    }
}

/// The scene's instants, or its own; of one that goes, those within its way.
void read_own_frames(const Section& section, const ObserverReading& reading,
                     ObserverInput& observer) {
    FrameSpan span{.begin = reading.time.start,
                   .end = reading.time.end(),
                   .utc_offset = reading.time.utc_offset,
                   .every = 3600.0,
                   .every_said = "the pictures of [time]",
                   .site = reading.site};
    const TrajectoryInput* way = find_trajectory(reading.trajectories, observer.trajectory);
    if (way != nullptr && observer.on.empty()) {  // what it rides on is there before and after
        span.begin = std::max(span.begin, way->begin());
        span.end = std::min(span.end, way->end());
        if (span.end < span.begin) {
            section.mistake("trajectory", "lies outside the span of [time]");
            return;
        }
    }
    if (section.has("frames") || section.has("frame_every_s") || section.has("frames_at_sun")) {
        Frames own = read_frames(section, span);
        observer.frames = std::move(own.frame);
        observer.frames_note = std::move(own.note);
        return;
    }
    std::copy_if(reading.time.frames.begin(), reading.time.frames.end(),
                 std::back_inserter(observer.frames),
                 [&](Instant when) { return when >= span.begin && when <= span.end; });
    if (observer.frames.empty()) {
        section.mistake("trajectory",
                        "is gone while none of the pictures of [time] is taken, expected "
                        "frame_every_s or frames beside it");
    }
}

AdaptiveOptions read_adaptive(const Section& section) {
    AdaptiveOptions options;
    options.from = section.integer_or("from", "samples of every pixel", options.from, {2, 1024});
    options.to = section.integer_or(
        "to", "samples of a pixel at most",
        {std::max(options.to, options.from), std::to_string(options.to)}, {2, 4096});
    options.tolerance = section.number_or("tolerance_K", "rms error of the picture to be reached",
                                          options.tolerance, {1e-4, 100.0});
    if (options.to < options.from) {
        section.mistake("to", fmt::format("{} is less than from, {}", options.to, options.from));
    }
    return options;
}

/// Where its eye is and which way it looks, from an object.
void read_aspect(const Section& section, const TerrainInput& terrain, ObserverInput& observer) {
    observer.around = read_around(
        section.section("around",
                        "in place of place_m, height_above_ground_m and where it looks: "
                        "from a sphere about an object"),
        terrain);
    observer.place = observer.around->eye();
    observer.height_above_ground =
        std::max(0.1, observer.around->range * std::sin(radians(observer.around->elevation_deg)));
    for (const char* key : {"place_m", "height_above_ground_m", "look_at_m", "look_at", "mount_deg",
                            "trajectory", "azimuth_deg", "elevation_deg", "on", "mount_m"}) {
        if (section.has(key)) section.mistake(key, "stands beside around, which says it");
    }
    for (const ObjectInput& object : terrain.objects) {
        if (object.name != observer.around->object || object.trajectory.empty()) continue;
        section.mistake("around", "is for objects that stand, this one goes along a trajectory",
                        "look_at follows it");
    }
}

/// How often each pixel is sampled.
void read_sampling(const Section& section, ObserverInput& observer) {
    observer.samples = section.integer_or("samples", "rays a pixel", 16, {1, 1024});
    if (!section.has("adaptive")) return;
    observer.adaptive = read_adaptive(
        section.section("adaptive",
                        "in place of samples: more rays where a pixel's facets differ in heat or "
                        "sunlight; pixels of panes, nets, mirrors and plumes double theirs"));
    if (section.has("samples")) {
        section.mistake("samples", "is for uniform sampling, adaptive says from and to");
    }
    observer.samples = observer.adaptive->from;
}

void read_bands_and_cubes(const Section& section, const std::vector<BandInput>& bands,
                          const std::vector<CubeInput>& cubes, ObserverInput& observer) {
    observer.surfaces = section.integer_or(
        "surfaces",
        "of each pixel, those it sees most of, that have planes of their own: from these and the "
        "terms, which come with them, its radiance can be added up anew",
        0, {0, 32});
    observer.terms =
        section.flag_or("terms", "planes for the terms of the radiance, one by one", false) ||
        observer.surfaces > 0;
    observer.bands = section.texts_or(
        "bands", "FROM-TO in µm, visible, nir, swir, mwir, lwir, or names of [[bands]]",
        std::vector<std::string>{"3-5", "8-12"});
    for (const std::string& band : observer.bands) {
        try {
            named_band(bands, band);
        } catch (const InputError& error) {
            section.mistake("bands", error.mistakes().front().problem,
                            error.mistakes().front().hint);
        }
    }
    observer.cubes = section.texts_or("cubes", "names of [[cubes]]", {});
    std::vector<std::string> known;
    for (const CubeInput& cube : cubes) known.push_back(cube.name);
    for (const std::string& cube : observer.cubes) {
        if (std::find(known.begin(), known.end(), cube) == known.end()) {
            section.mistake("cubes", fmt::format("no cube \"{}\" in [[cubes]]", cube),
                            did_you_mean(cube, known));
        }
    }
}

}  // namespace

ObserverInput read_observer(const Section& section, const ObserverReading& reading) {
    ObserverInput observer;
    observer.name = section.text("name", "of the observer, in the names of its pictures");
    if (section.has("around")) {
        read_aspect(section, reading.terrain, observer);
    } else {
        read_stand(section, reading, observer);
        read_pointing(section, reading, observer);
    }
    observer.roll_deg =
        section.number_or("roll_deg", "about its line of sight, clockwise", 0.0, {-180.0, 180.0});
    observer.width = section.integer_or("width", "pixels", 640, {1, 16384});
    observer.height = section.integer_or("height", "pixels", 512, {1, 16384});
    read_projection(section, observer);
    read_motion(section, reading.terrain, observer);
    read_sampling(section, observer);
    read_bands_and_cubes(section, reading.bands, reading.cubes, observer);
    read_own_frames(section, reading, observer);
    for (const char* key : {"around", "on", "trajectory", "place_m"}) {
        if (!section.has(key)) continue;
        observer.where = section.where(key);
        break;
    }
    return observer;
}

}  // namespace diurna
