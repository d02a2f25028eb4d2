#include "thermal/point/point_job_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "materials/base/document.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/library_parts.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"
#include "materials/matter/spectrum_notes.hpp"
#include "thermal/point/calibration_section.hpp"
#include "thermal/point/schedule_clock.hpp"
#include "thermal/weather/sky_section.hpp"
#include "thermal/weather_file/weather_section.hpp"

namespace diurna {

namespace {

void read_site(const Section& site, PointJob& job) {
    job.site.latitude_deg = site.number("latitude_deg", "latitude north, WGS84", {-90.0, 90.0});
    job.site.longitude_deg = site.number("longitude_deg", "longitude east, WGS84", {-180.0, 180.0});
    job.elevation = job.site.height =
        site.number_or("elevation_m", "height above the sea", 0.0, {-500.0, 9000.0});
}

void read_facet(const Section& facet, PointJob& job) {
    job.slope_deg = facet.number_or("slope_deg", "slope from the horizontal", 0.0, {0.0, 180.0});
    job.aspect_deg = facet.number_or("aspect_deg", "azimuth of the slope, clockwise from north",
                                     180.0, {-360.0, 360.0});
    job.sky_view = facet.number_or(
        "sky_view", "sky view factor; the rest is ground of the same temperature",
        {0.5 * (1.0 + std::cos(radians(job.slope_deg))), "(1 + cos slope) / 2"}, {0.0, 1.0});
    job.height = facet.number_or("height_above_ground_m",
                                 "for a wall, plate, cylinder or box: height of its wind, by the "
                                 "logarithmic profile of open ground",
                                 {0.0, "the height of the wind measurement"}, {0.1, 1000.0});
}

/// What the facet's motion or place makes of the wind; after its material is known.
void read_wind(const Section& facet, PointJob& job) {
    const double airspeed = facet.number_or(
        "airspeed_m_s",
        "airspeed of a surface in flight, which gives its wind and the recovery temperature", 0.0,
        {0.0, 3000.0});
    if (airspeed > 0.0) {
        const auto* body = std::get_if<BodyFilm>(&job.surface.convection);
        job.surface.flight = {airspeed, body && body->length > 0.0 ? body->length : 1.0};
    }
    if (job.height > 0.0 && std::holds_alternative<Louis>(job.surface.convection)) {
        facet.mistake("height_above_ground_m",
                      "applies to walls, plates, cylinders and boxes; ground of kind louis has its "
                      "own wind profile");
    }
    if (job.height > 0.0 && airspeed > 0.0) {
        facet.mistake("height_above_ground_m", "has no effect with airspeed_m_s");
    }
}

/// A profile of the ground at the start, its depths ascending.
std::vector<SoilPoint> read_profile(const Section& time) {
    std::vector<SoilPoint> profile;
    if (!time.has("initial_profile")) return profile;
    const auto rows =
        time.rows("initial_profile",
                  "[[depth_m, K], ...] instead of initial_temperature_K, interpolated linearly", 2);
    for (const std::vector<double>& point : rows) {
        if (point[0] < 0.0 || point[1] < 1.0 || point[1] > 3000.0 ||
            (!profile.empty() && point[0] <= profile.back().depth)) {
            time.mistake("initial_profile",
                         "expected [depth_m, temperature_K] with ascending depths");
            break;
        }
        profile.push_back({point[0], point[1]});
    }
    return profile;
}

void add_note(const std::string& note, Weather& weather) {
    weather.note += (weather.note.empty() ? "" : "; ") + note;
}

/// Reflected light reports nothing of a facet of another material.
void forget_albedo(const std::string& measured_over, const std::string& material,
                   Weather& weather) {
    bool measured = false;
    for (Forcing& f : weather.sample) {
        measured = measured || !std::isnan(f.shortwave_up);
        f.shortwave_up = not_measured;
    }
    if (!measured) return;
    add_note(fmt::format("shortwave_up was measured over {}: the albedo of {} is used",
                         measured_over, material),
             weather);
}

/// Throws InputError, in one line, for a scene: its keys would give a mistake each.
void refuse_scene(const std::filesystem::path& file, const Confines& confines) {
    const Section root = Document::from_file(file, confines).root();
    if (!root.has("terrain") && !root.has("observer")) return;
    if (root.has("facet")) return;
    throw InputError(file.string(), "is a scene, expected a column file",
                     fmt::format("for a scene use diurna run {}", file.string()));
}

bool rains(const Weather& weather) {
    return std::any_of(weather.sample.begin(), weather.sample.end(),
                       [](const Forcing& f) { return f.rain_mm_h > 0.0; });
}

void read_time(const Section& time, PointJob& job) {
    const std::string start = time.moment("start", "start of the span, with its UTC offset");
    const std::string end = time.moment("end", "end of the span, with its UTC offset");
    job.spin_up = time.choice_or(
        "spin_up",
        "initial state: the first day without its trend, repeated; the span itself, repeated; none",
        SpinUp::first_day,
        {{"none", SpinUp::none}, {"first-day", SpinUp::first_day}, {"periodic", SpinUp::periodic}});
    job.step =
        time.number_or("step_s", "interval between rows of the result", 1800.0, {0.1, 86400.0});
    job.longest_step =
        time.number_or("longest_step_s", "longest step of the integration", 600.0, {0.1, 86400.0});
    job.initial_temperature = time.number_or(
        "initial_temperature_K", "initial temperature at all depths, or a first guess of it",
        {job.initial_temperature, "the temperature of the bottom or the air"}, {1.0, 3000.0});
    job.tolerance = time.number_or("tolerance_K", "error per step, from step doubling",
                                   job.tolerance, {1e-7, 1.0});
    job.initial_profile = read_profile(time);
    job.start = parse_instant(start, time.where("start"));
    job.utc_offset = utc_offset_of(start);
    job.end = parse_instant(end, time.where("end"));
    if (job.end <= job.start) {
        time.mistake("end", "is not later than start");
    } else if (seconds_between(job.start, job.end) < job.step) {
        time.mistake("step_s", "is longer than the whole span");
    } else if (seconds_between(job.start, job.end) / job.step > 1e7) {
        time.mistake("step_s", "makes more than ten million rows");
    }
}

}  // namespace

PointJob read_column_job(const Document& document) {
    const Section root = document.root();
    PointJob job;
    read_site(root.required_section("site", "place of the facet"), job);
    const Section facet =
        root.section("facet", "orientation of the facet; default: horizontal under an open sky");
    read_facet(facet, job);
    const Section material = root.required_section(
        "material", "material of the facet, with the keys of the section Materials");
    const Material read = read_material(material, default_material_library(), "column");
    job.surface = read.thermal;
    read_wind(facet, job);
    job.clear_sky = read_sky(root.section("sky", sky_says));
    const Section weather =
        root.required_section("weather", "weather that drives the heat balance");
    const std::vector<std::filesystem::path> weather_files =
        weather.files("file", weather_file_says);
    WeatherOptions options = read_weather_options(weather, 0.1);
    options.elevation = job.elevation;
    options.site = job.site;
    std::vector<std::string> materials = default_material_library().names();
    materials.push_back(read.name);
    const std::string measured_over = read_measured_over(weather, materials);
    read_time(root.required_section("time", "span, start and steps"), job);
    job.calibrate = read_calibration(root);
    if (job.calibrate) job.depth = job.calibrate->depth;
    document.finish();
    options.asked = {job.start, job.end};
    job.weather = read_weather(weather_files, options);
    if (!measured_over.empty() && measured_over != read.name) {
        forget_albedo(measured_over, read.name, job.weather);
    }
    for (const std::string& note : spectrum_notes(read, {})) add_note(note, job.weather);
    const std::string schedule = schedule_key(job.surface);
    const std::string clock = schedule_clock_note(job.site, job.utc_offset);
    if (!schedule.empty() && !clock.empty()) add_note(schedule + ": " + clock, job.weather);
    if (job.surface.flight && rains(job.weather)) {
        add_note("in flight, without rain and snow", job.weather);
    }
    return job;
}

PointJob read_column_job(const std::filesystem::path& file, bool allow_outside,
                         const std::vector<std::string>& settings) {
    const Confines confines = confines_of(file, allow_outside);
    refuse_scene(file, confines);
    Document document = Document::from_file(file, confines);
    apply_settings(document, settings, MaterialTables::one);
    return read_column_job(document);
}

}  // namespace diurna
