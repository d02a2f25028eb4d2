#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <optional>

#include "materials/air/radiosonde.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/paths_in_bands.hpp"
#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "python/src/bind.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/point/point_job_file.hpp"
#include "thermal/point/run_column.hpp"

// What needs no scene: the sun, a path through the air, Planck's law, one facet.

namespace diurna::python {

namespace {

py::tuple sun(double latitude_deg, double longitude_deg, const std::string& time, double height_m,
              std::optional<double> pressure_hPa, double temperature_C) {
    check_within("latitude_deg", latitude_deg, -90.0, 90.0);
    check_within("longitude_deg", longitude_deg, -360.0, 360.0);
    const Site site{
        .latitude_deg = latitude_deg, .longitude_deg = longitude_deg, .height = height_m};
    const Instant instant = parse_instant(time);
    const SunPosition at = pressure_hPa ? sun_position(site, instant, *pressure_hPa, temperature_C)
                                        : sun_position(site, instant);
    return py::make_tuple(at.azimuth_deg, at.elevation_deg, at.distance_au);
}

py::object radiance(const std::string& band, py::array_t<double> kelvin) {
    const Band of = parse_band(band);
    const auto each = [&](double t) {
        check_within("temperature", t, 0.0, 20000.0);
        return band_radiance(of, t);
    };
    return py::vectorize(each)(std::move(kelvin));
}

py::object apparent_temperature(const std::string& band, py::array_t<double> radiance) {
    const Band of = parse_band(band);
    const auto each = [&](double value) {
        if (!std::isfinite(value)) throw InputError("radiance", "found one that is not finite");
        return brightness_temperature(of, value);
    };
    return py::vectorize(each)(std::move(radiance));
}

py::list path(const std::vector<std::string>& names, const std::string& profile,
              const std::string& aerosol, double visibility_km, double co2_ppm, double ground_km,
              double rain_mm_h, const AirPath& way) {
    const BandModel model{.profile = named_profile(profile),
                          .aerosol = aerosol,
                          .visibility_km = visibility_km,
                          .co2_ppm = co2_ppm,
                          .ground_km = ground_km,
                          .rain_mm_h = rain_mm_h};
    check(model);
    std::vector<Band> bands;
    for (const std::string& name : names) bands.push_back(parse_band(name, bin_edges_um()));
    std::vector<PathInBand> found;
    {
        const py::gil_scoped_release free;
        found = paths_in_bands(way, model, line_of(way, model), bands);
    }
    py::list rows;
    for (const PathInBand& one : found)
        rows.append(py::make_tuple(one.transmittance, one.thermal, one.scattered));
    return rows;
}

py::dict column(const std::filesystem::path& file, const std::optional<std::string>& text,
                const std::vector<std::string>& settings,
                const std::vector<std::filesystem::path>& folders, bool allow_outside) {
    PointResult result;
    {
        const py::gil_scoped_release free;
        Confines confines = confines_of(file, allow_outside);
        for (const auto& folder : folders)
            confines.folders.push_back(std::filesystem::weakly_canonical(folder));
        Document document = text ? Document::from_text(*text, file.string(), confines)
                                 : Document::from_file(file, confines);
        for (const std::string& setting : settings) document.set(setting);
        result = run_column(read_column_job(document));
    }
    py::dict columns;
    std::vector<Instant> times;
    for (const PointRow& row : result.row) times.push_back(row.instant);
    columns["time"] = as_datetimes(times);
    const auto add = [&](const char* name, double PointRow::*member) {
        std::vector<double> values;
        for (const PointRow& row : result.row) values.push_back(row.*member);
        columns[name] = as_array(std::move(values));
    };
    add("surface_temperature_K", &PointRow::surface_temperature);
    add("absorbed_solar_W_m2", &PointRow::absorbed_solar);
    add("longwave_in_W_m2", &PointRow::longwave_in);
    add("longwave_out_W_m2", &PointRow::longwave_out);
    add("sensible_W_m2", &PointRow::sensible);
    add("latent_W_m2", &PointRow::latent);
    add("conducted_W_m2", &PointRow::conducted);
    if (result.has_back) add("back_temperature_K", &PointRow::back_temperature);
    if (result.has_canopy) {
        add("ground_temperature_K", &PointRow::ground_temperature);
        add("leaf_temperature_K", &PointRow::leaf_temperature);
    }
    if (result.has_store) {
        add("water_mm", &PointRow::water_mm);
        add("frost_mm", &PointRow::frost_mm);
    }
    if (result.has_melt) add("melt_W_m2", &PointRow::melt);
    py::dict out;
    out["columns"] = columns;
    out["note"] = result.note;
    out["converged"] = result.converged;
    out["passes"] = result.passes;
    out["periodic_residual_K"] = result.periodic_residual;
    out["depth_m"] = as_array(std::move(result.depth));
    out["final_profile_K"] = as_array(std::move(result.final_profile));
    return out;
}

}  // namespace

void bind_point(py::module_& module) {
    module.def("sun", &sun);
    module.def("band_radiance", &radiance);
    module.def("apparent_temperature", &apparent_temperature);
    py::class_<AirPath>(module, "AirPath")
        .def(py::init<>())
        .def_readwrite("height_km", &AirPath::height_km)
        .def_readwrite("zenith_deg", &AirPath::zenith_deg)
        .def_readwrite("range_km", &AirPath::range_km)
        .def_readwrite("to_height_km", &AirPath::to_height_km)
        .def_readwrite("to_ground", &AirPath::to_ground)
        .def_readwrite("to_space", &AirPath::to_space)
        .def_readwrite("sun_zenith_deg", &AirPath::sun_zenith_deg)
        .def_readwrite("azimuth_from_sun_deg", &AirPath::azimuth_from_sun_deg)
        .def_readwrite("ground_albedo", &AirPath::ground_albedo);
    module.attr("todays_co2_ppm") = todays_co2_ppm;
    module.def("path", &path);
    module.def("column", &column);
}

}  // namespace diurna::python
