#include <cmath>

#include "materials/base/document.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "thermal/point/point_job.hpp"

namespace diurna {

namespace {

Stamp stamp_of(const std::string& word) {
    if (word == "start") return Stamp::start;
    return word == "end" ? Stamp::end : Stamp::instant;
}

const std::vector<std::string> longwave_names{"dilley-obrien", "brutsaert", "prata",
                                              "brunt",         "idso",      "swinbank"};

LongwaveFormula longwave_of(const std::string& word) {
    for (std::size_t i = 0; i < longwave_names.size(); ++i) {
        if (word == longwave_names[i]) return static_cast<LongwaveFormula>(i);
    }
    return LongwaveFormula::dilley_obrien;
}

SpinUp spin_up_of(const std::string& word) {
    if (word == "none") return SpinUp::none;
    return word == "periodic" ? SpinUp::periodic : SpinUp::first_day;
}

}  // namespace

PointJob read_column_job(const std::filesystem::path& file) {
    const Document document = Document::from_file(file);
    const Section root = document.root();
    PointJob job;

    const Section site = root.section("site", true);
    job.site.latitude_deg = site.number("latitude_deg", -90.0, 90.0);
    job.site.longitude_deg = site.number("longitude_deg", -180.0, 180.0);
    job.elevation = job.site.height = site.number_or("elevation_m", 0.0, -500.0, 9000.0);

    const Section facet = root.section("facet");
    job.slope_deg = facet.number_or("slope_deg", 0.0, 0.0, 180.0);
    job.aspect_deg = facet.number_or("aspect_deg", 180.0, -360.0, 360.0);
    job.sky_view =
        facet.number_or("sky_view", 0.5 * (1.0 + std::cos(radians(job.slope_deg))), 0.0, 1.0);

    job.airspeed = facet.number_or("airspeed_m_s", 0.0, 0.0, 3000.0);

    const Section material = root.section("material", true);
    job.surface =
        read_material(material, default_material_library(), file.parent_path(), "column").thermal;

    const Section sky = root.section("sky");
    job.clear_sky.aerosol_380nm =
        sky.number_or("aerosol_380nm", job.clear_sky.aerosol_380nm, 0.0, 5.0);
    job.clear_sky.aerosol_500nm =
        sky.number_or("aerosol_500nm", job.clear_sky.aerosol_500nm, 0.0, 5.0);
    job.clear_sky.ozone_cm = sky.number_or("ozone_cm", job.clear_sky.ozone_cm, 0.0, 1.0);
    job.clear_sky.longwave = longwave_of(sky.word_or("longwave", "dilley-obrien", longwave_names));
    job.clear_sky.longwave_by_direction = sky.flag_or("longwave_by_direction", true);
    if (sky.word_or("sun", "bird", {"bird", "ineichen"}) == "ineichen") {
        job.clear_sky.linke_turbidity = sky.number_or("linke_turbidity", 3.0, 1.0, 12.0);
    }
    if (sky.has("precipitable_water_cm")) {
        job.clear_sky.precipitable_water_cm = sky.number("precipitable_water_cm", 0.0, 10.0);
    }

    const Section weather = root.section("weather", true);
    const std::string weather_file = weather.text("file");
    const WeatherOptions options{
        .interval = stamp_of(weather.word_or("interval", "end", {"start", "end", "instant"})),
        .wind_height = weather.number_or("wind_height_m", 10.0, 0.1, 200.0),
        .air_height = weather.number_or("air_height_m", 2.0, 0.1, 200.0),
        .elevation = job.elevation};

    const Section time = root.section("time", true);
    const std::string start = time.moment("start"), end = time.moment("end");
    job.spin_up =
        spin_up_of(time.word_or("spin_up", "first-day", {"none", "first-day", "periodic"}));
    job.step = time.number_or("step_s", 1800.0, 0.1, 86400.0);
    job.longest_step = time.number_or("longest_step_s", 600.0, 0.1, 86400.0);
    if (time.has("initial_temperature_K")) {
        job.initial_temperature = time.number("initial_temperature_K", 1.0, 3000.0);
    }
    job.tolerance = time.number_or("tolerance_K", job.tolerance, 1e-7, 1.0);
    if (time.has("initial_profile")) {
        for (const std::vector<double>& point : time.rows("initial_profile", 2)) {
            if (point[0] < 0.0 || point[1] < 1.0 || point[1] > 3000.0 ||
                (!job.initial_profile.empty() && point[0] <= job.initial_profile.back().depth)) {
                time.mistake("initial_profile",
                             "expected [depth_m, temperature_K] with ascending depths");
                break;
            }
            job.initial_profile.push_back({point[0], point[1]});
        }
    }
    if (!start.empty()) job.start = parse_instant(start, time.where("start"));
    if (!end.empty()) job.end = parse_instant(end, time.where("end"));
    if (!start.empty() && !end.empty()) {
        if (job.end <= job.start) {
            time.mistake("end", "does not come after start");
        } else if (seconds_between(job.start, job.end) < job.step) {
            time.mistake("step_s", "is longer than the whole span");
        } else if (seconds_between(job.start, job.end) / job.step > 1e7) {
            time.mistake("step_s", "asks for more than ten million rows");
        }
    }
    document.finish();

    job.weather = read_weather(file.parent_path() / weather_file, options);
    return job;
}

}  // namespace diurna
