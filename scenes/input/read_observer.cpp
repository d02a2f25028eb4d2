#include "scenes/input/read_observer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <utility>

#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "scenes/input/checked_names.hpp"
#include "scenes/input/object_names.hpp"
#include "scenes/input/read_frames.hpp"
#include "scenes/input/read_projection.hpp"

namespace diurna {

namespace {

/// Whether its pictures' time reports anything: it goes, or something does.
bool sees_motion(const ObserverInput& observer, const TerrainInput& terrain) {
    return observer.goes() ||
           std::any_of(terrain.objects.begin(), terrain.objects.end(),
                       [](const ObjectInput& object) { return !object.trajectory.empty(); });
}

/// A picture that could not be read back at once, without planes for terms or surfaces.
void check_picture_size(const Section& section, const ObserverInput& observer) {
    constexpr double least_planes = 10.0;
    const double values = least_planes * observer.width * observer.height;
    if (values <= double(most_exr_values)) return;
    section.mistake("width",
                    fmt::format("{} x {} pixels of {:.0f} planes are more than the {} values "
                                "that a picture may have",
                                observer.width, observer.height, least_planes, most_exr_values));
}

/// A camera that flies: rows read one after the other, each blurred by its exposure.
void read_motion(const Section& section, const TerrainInput& terrain, ObserverInput& observer) {
    if (section.has("velocity_m_s")) {
        const std::vector<double> velocity =
            section.numbers("velocity_m_s", "[east, north, up] of a camera that moves", 3);
        observer.velocity = {velocity[0], velocity[1], velocity[2]};
        if (!(observer.velocity.cwiseAbs().maxCoeff() <= 1e4)) {
            section.mistake("velocity_m_s", "faster than 10000 m/s");
        } else if (observer.velocity.isZero() && !section.has_mistakes()) {
            section.mistake("velocity_m_s", "is zero, expected a camera that moves or no such key");
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
    add_objects(known, terrain);
    observer.on = section.name(
        "on", "object that its eye rides on, in place of a place and height of its own", known);
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
    for (const char* key : {"place_m", "place", "trajectory"}) {
        if (section.has(key)) section.mistake(key, "stands beside on, whose object says it");
    }
    refuse_heights(section, "stands beside on, whose object says it");
    for (const ObjectInput& object : terrain.objects) {
        if (object.name != observer.on) continue;
        observer.trajectory = object.trajectory;
        const Eigen::Rotation2Dd turn(-radians(object.placing.heading_deg));
        observer.place = object.place + turn * Eigen::Vector2d(at[0], at[1]);
        observer.stands = object.stands;
        observer.stands.metres += at[2];
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
            "trajectory", "that its eye goes, in place of a place and height of its own", ways);
        for (const char* key : {"place_m", "place"}) {
            if (section.has(key)) section.mistake(key, "stands beside a trajectory, which says it");
        }
        refuse_heights(section, "stands beside a trajectory, which says it");
        return;
    }
    observer.stands = read_height(section, "of its eye", {}, {0.1, 50000.0});
    observer.place =
        reading.places.one(section, {"place_m", "place"}, "of its eye", observer.stands);
}

/// Which way it looks.
void read_pointing(const Section& section, const ObserverReading& reading,
                   ObserverInput& observer) {
    int ways = 0;
    for (const char* key : {"look_at_m", "look_at_place", "look_at", "mount_deg"}) {
        ways += section.has(key);
    }
    if (ways > 1 || (ways == 1 && section.has("azimuth_deg"))) {
        for (const char* key : {"azimuth_deg", "elevation_deg"}) section.has(key);
        section.mistake("",
                        "is pointed in more than one way, expected one of look_at_m, "
                        "look_at_place, look_at, mount_deg, and azimuth_deg with elevation_deg");
    }
    if (section.has("look_at_m") || section.has("look_at_place")) {
        observer.look_at =
            reading.places.one(section, {"look_at_m", "look_at_place"},
                               "of the point of the ground in the middle of the picture; or "
                               "azimuth_deg and elevation_deg");
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
        for (const double angle : angles) {
            if (std::abs(angle) > 360.0) {
                section.mistake("mount_deg",
                                fmt::format("found {:g}, expected -360 to 360", angle));
                break;
            }
        }
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
    if (way != nullptr && way->sound && observer.on.empty()) {
        // What it rides on is there before and after.
        span.said = fmt::format("the way \"{}\" in the span of [time]", way->name);
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
    if (observer.frames.empty() && way != nullptr && way->sound) {
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
    observer.around =
        read_around(section.section("around",
                                    "in place of its place, height and where it looks: "
                                    "from a sphere about an object"),
                    terrain);
    observer.place = observer.around->eye();
    observer.stands.metres =
        std::max(0.1, observer.around->range * std::sin(radians(observer.around->elevation_deg)));
    for (const char* key :
         {"place_m", "place", "look_at_m", "look_at_place", "look_at", "mount_deg", "trajectory",
          "azimuth_deg", "elevation_deg", "on", "mount_m"}) {
        if (section.has(key)) section.mistake(key, "stands beside around, which says it");
    }
    refuse_heights(section, "stands beside around, which says it");
    for (const ObjectInput& object : terrain.objects) {
        if (object.name != observer.around->object || object.trajectory.empty()) continue;
        section.mistake("around", "is for objects that stand, this one goes along a trajectory",
                        "look_at follows it");
    }
}

/// How often each pixel is sampled.
void read_sampling(const Section& section, ObserverInput& observer) {
    observer.samples =
        section.integer_or("samples",
                           "rays a pixel; from 4 on up to 16 times as many, 256 at most, where "
                           "what it sees differs in heat in 8-12 um (not with `surfaces`)",
                           16, {1, 1024});
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
    observer.bands = read_band_names(
        section, "FROM-TO in µm, visible, nir, swir, mwir, lwir, or names of [[bands]]",
        std::vector<std::string>{"3-5", "8-12"}, bands);
    for (auto band = observer.bands.begin(); band != observer.bands.end(); ++band) {
        if (std::find(observer.bands.begin(), band, *band) == band) continue;
        section.mistake("bands", fmt::format("has \"{}\" twice", *band));
        break;
    }
    for (const std::string& band : observer.bands) {
        try {
            named_band(bands, band);
        } catch (const InputError& error) {
            section.mistake("bands", error.mistakes().front().problem,
                            error.mistakes().front().hint);
        }
    }
    observer.cubes = section.texts_or("cubes", "names of [[cubes]]", {});
    if (observer.bands.empty() && observer.cubes.empty() && section.has("bands")) {
        section.mistake("bands", "is empty, expected a band or cubes beside it");
    }
    for (const std::string& cube : observer.cubes) {
        if (std::find(observer.bands.begin(), observer.bands.end(), cube) != observer.bands.end()) {
            section.mistake("cubes", fmt::format("\"{}\" is a band of it, too: their files would "
                                                 "have one name",
                                                 cube));
        }
    }
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
    if (observer.name.empty() && section.has("name")) section.mistake("name", "is empty");
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
    check_picture_size(section, observer);
    const PictureAngles angles = read_projection(section, observer.width, observer.height);
    observer.projection = angles.projection;
    observer.horizontal_fov_deg = angles.horizontal_fov_deg;
    observer.picture_width = angles.picture_width;
    observer.pixel_pitch_um = angles.pixel_pitch_um;
    read_motion(section, reading.terrain, observer);
    read_sampling(section, observer);
    read_bands_and_cubes(section, reading.bands, reading.cubes, observer);
    read_own_frames(section, reading, observer);
    for (const char* key : {"around", "on", "trajectory", "place", "place_m"}) {
        if (section.has(key) && observer.where.empty()) observer.where = section.where(key);
    }
    for (const char* key : {"look_at", "look_at_place", "look_at_m"}) {
        if (section.has(key)) observer.look_where = section.where(key);
    }
    return observer;
}

}  // namespace diurna
