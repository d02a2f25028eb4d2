#include "scenes/job/input/read_observer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <utility>

#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/checked_names.hpp"
#include "scenes/job/input/object_names.hpp"
#include "scenes/job/input/read_frames.hpp"
#include "scenes/job/input/read_projection.hpp"

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
    section.mistake(
        "width",
        fmt::format(
            "{} x {} pixels of {:.0f} planes are more than the {} values of the largest picture",
            observer.width, observer.height, least_planes, most_exr_values));
}

/// A camera that flies: rows read one after the other, each blurred by its exposure.
void read_motion(const Section& section, const TerrainInput& terrain, ObserverInput& observer) {
    if (section.has("velocity_m_s")) {
        const std::vector<double> velocity =
            section.numbers("velocity_m_s", "[east, north, up] of a moving camera", 3);
        observer.velocity = {velocity[0], velocity[1], velocity[2]};
        if (!(observer.velocity.cwiseAbs().maxCoeff() <= 1e4)) {
            section.mistake("velocity_m_s", "is faster than 10000 m/s");
        } else if (observer.velocity.isZero() && !section.has_mistakes()) {
            section.mistake("velocity_m_s", "is zero, expected a moving camera or no such key");
        }
    }
    observer.row_time = section.number_or(
        "row_time_s",
        "time between the readout of successive rows, for a moving camera or moving objects", 0.0,
        {0.0, 60.0});
    observer.exposure = section.number_or(
        "exposure_s",
        "exposure time of each row, which blurs moving objects or the picture of a moving camera",
        0.0, {0.0, 60.0});
    if (observer.goes() || !observer.on.empty()) {
        if (section.has("velocity_m_s")) {
            section.mistake("velocity_m_s",
                            observer.on.empty()
                                ? "cannot be combined with a trajectory, which gives it"
                                : "cannot be combined with on: the object gives it");
        }
    }
    if (sees_motion(observer, terrain)) return;
    for (const char* key : {"row_time_s", "exposure_s"}) {
        if (section.has(key) && !section.has("velocity_m_s")) {
            section.mistake(key,
                            "has no effect for a fixed camera in a scene without moving objects, "
                            "expected velocity_m_s = [east, north, up] or a trajectory as well");
        }
    }
}

/// On an object, which goes or stands.
void read_ride(const Section& section, const TerrainInput& terrain, ObserverInput& observer) {
    Names known{.what = "object", .known = {}, .where = " in [[object]]"};
    add_objects(known, terrain);
    observer.on =
        section.name("on", "object that carries the camera, instead of a place and height", known);
    const std::vector<double> at =
        section.numbers("mount_m",
                        "[right, front, up] of the camera on that object, from the centre of its "
                        "plan and its lowest point",
                        3);
    observer.mount_place = {at[0], at[1], at[2]};
    if (!(observer.mount_place.cwiseAbs().maxCoeff() <= 1e4)) {
        section.mistake("mount_m", "is more than 10000 m from its object");
        observer.mount_place.setZero();
    }
    for (const char* key : {"place_m", "place", "trajectory"}) {
        if (section.has(key))
            section.mistake(key, "cannot be combined with on: the object gives it");
    }
    refuse_heights(section, "cannot be combined with on: the object gives it");
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
                        "applies to observers that an object carries, expected on as well");
    }
    if (section.has("trajectory")) {
        Names ways{.what = "trajectory", .known = {}, .where = " in [[trajectory]]"};
        for (const TrajectoryInput& way : reading.trajectories) ways.known.push_back(way.name);
        observer.trajectory = section.name(
            "trajectory", "trajectory of the camera, instead of a place and height", ways);
        for (const char* key : {"place_m", "place"}) {
            if (section.has(key))
                section.mistake(key, "cannot be combined with a trajectory, which gives it");
        }
        refuse_heights(section, "cannot be combined with a trajectory, which gives it");
        return;
    }
    observer.stands = read_height(section, "height of the camera", {}, {0.1, 50000.0});
    observer.place =
        reading.places.one(section, {"place_m", "place"}, "place of the camera", observer.stands);
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
                        "has several line-of-sight keys, expected one of look_at_m, look_at_place, "
                        "look_at, mount_deg, and azimuth_deg with elevation_deg");
    }
    if (section.has("look_at_m") || section.has("look_at_place")) {
        observer.look_at = reading.places.one(
            section, {"look_at_m", "look_at_place"},
            "point of the ground at the picture's centre; or give azimuth_deg and elevation_deg");
    } else if (section.has("look_at")) {
        observer.look_at_object =
            section.name("look_at", "object at the picture's centre", reading.objects);
    } else if (section.has("mount_deg")) {
        const std::vector<double> angles = section.numbers(
            "mount_deg",
            "[azimuth, elevation, roll] of a camera on a trajectory or an object, to the right of "
            "and above the front: [0, -90, 0] looks down; the front is the direction of motion, or "
            "as the trajectory's file gives it",
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
            section.mistake("mount_deg", "applies to observers on a trajectory or an object");
        }
        if (section.has("roll_deg")) {
            section.mistake("roll_deg",
                            "cannot be combined with mount_deg, whose third number is the roll");
        }
    } else {
        observer.azimuth_deg = section.number(
            "azimuth_deg", "azimuth of the line of sight, clockwise from north", {-360.0, 360.0});
        observer.elevation_deg = section.number(
            "elevation_deg", "elevation of the line of sight above the horizon", {-90.0, 90.0});
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
        span.said = fmt::format("trajectory \"{}\" in the span of [time]", way->name);
        span.begin = std::max(span.begin, way->begin());
        span.end = std::min(span.end, way->end());
        if (span.end < span.begin) {
            section.mistake("trajectory", "is outside the span of [time]");
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
                        "covers no instant of the pictures of [time], expected frame_every_s or "
                        "frames as well");
    }
}

AdaptiveOptions read_adaptive(const Section& section) {
    AdaptiveOptions options;
    options.from = section.integer_or("from", "samples of every pixel", options.from, {2, 1024});
    options.to = section.integer_or(
        "to", "largest number of samples per pixel",
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
    observer.around = read_around(section.section("around",
                                                  "place and line of sight on a sphere around an "
                                                  "object, instead of place, height and direction"),
                                  terrain);
    observer.place = observer.around->eye();
    observer.stands.metres =
        std::max(0.1, observer.around->range * std::sin(radians(observer.around->elevation_deg)));
    for (const char* key :
         {"place_m", "place", "look_at_m", "look_at_place", "look_at", "mount_deg", "trajectory",
          "azimuth_deg", "elevation_deg", "on", "mount_m"}) {
        if (section.has(key))
            section.mistake(key, "cannot be combined with around, which gives it");
    }
    refuse_heights(section, "cannot be combined with around, which gives it");
    for (const ObjectInput& object : terrain.objects) {
        if (object.name != observer.around->object || object.trajectory.empty()) continue;
        section.mistake("around", "needs an object at rest, this one moves along a trajectory",
                        "look_at follows a moving object");
    }
}

/// How often each pixel is sampled.
void read_sampling(const Section& section, ObserverInput& observer) {
    observer.samples =
        section.integer_or("samples",
                           "rays per pixel; from 4 on, pixels with temperature differences in 8-12 "
                           "um get up to 256 (not with `surfaces`)",
                           16, {1, 1024});
    if (!section.has("adaptive")) return;
    observer.adaptive = read_adaptive(section.section(
        "adaptive",
        "instead of samples: more rays where a pixel's facets differ in temperature or sunlight; "
        "pixels of panes, nets, mirrors and plumes get twice as many"));
    if (section.has("samples")) {
        section.mistake("samples", "applies to uniform sampling; adaptive has from and to");
    }
    observer.samples = observer.adaptive->from;
}

void read_bands_and_cubes(const Section& section, const std::vector<BandInput>& bands,
                          const std::vector<CubeInput>& cubes, ObserverInput& observer) {
    observer.surfaces = section.integer_or(
        "surfaces",
        "number of surfaces per pixel, those with the largest shares, that are written as planes; "
        "with these and the terms, which are also written, the pixel's radiance can be recomputed",
        0, {0, 32});
    observer.terms =
        section.flag_or("terms", "write each term of the radiance as a plane", false) ||
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
        section.mistake("bands", "is empty, expected a band or cubes as well");
    }
    for (const std::string& cube : observer.cubes) {
        if (std::find(observer.bands.begin(), observer.bands.end(), cube) != observer.bands.end()) {
            section.mistake(
                "cubes",
                fmt::format(
                    "\"{}\" is also a band of this observer: their files would have the same name",
                    cube));
        }
    }
    std::vector<std::string> known;
    for (const CubeInput& cube : cubes) known.push_back(cube.name);
    for (const std::string& cube : observer.cubes) {
        if (std::find(known.begin(), known.end(), cube) == known.end()) {
            section.mistake("cubes",
                            fmt::format("unknown cube \"{}\", expected a name of [[cubes]]", cube),
                            did_you_mean(cube, known));
        }
    }
}

}  // namespace

ObserverInput read_observer(const Section& section, const ObserverReading& reading) {
    ObserverInput observer;
    observer.name = section.text("name", "name of the observer, used in the names of its pictures");
    if (observer.name.empty() && section.has("name")) section.mistake("name", "is empty");
    if (section.has("around")) {
        read_aspect(section, reading.terrain, observer);
    } else {
        read_stand(section, reading, observer);
        read_pointing(section, reading, observer);
    }
    observer.roll_deg = section.number_or("roll_deg", "roll about its line of sight, clockwise",
                                          0.0, {-180.0, 180.0});
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
