#include <pybind11/stl.h>

#include <cmath>
#include <optional>

#include "materials/air/radiosonde.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/paths_in_bands.hpp"
#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "python/src/bind.hpp"
#include "python/src/thread_limit.hpp"
#include "scenes/job/input/bands.hpp"
#include "terrain/place/sun.hpp"

// What needs no scene: the sun, a path through the air, Planck's law.

namespace diurna::python {

namespace {

/// As an observer of a scene names it: "lwir", "8-12", "8:12".
Band band_of(const std::string& name, std::span<const double> breakpoints_um = {}) {
    return named_band({}, band_name({}, name), breakpoints_um);
}

py::tuple sun(double latitude_deg, double longitude_deg, const std::string& time, double height_m,
              std::optional<double> pressure_hPa, double temperature_C) {
    check_within("latitude_deg", latitude_deg, -90.0, 90.0);
    check_within("longitude_deg", longitude_deg, -360.0, 360.0);
    check_within("height_m", height_m, -1e4, 1e5);
    check_within("pressure_hPa", pressure_hPa.value_or(0.0), 0.0, 1200.0);
    check_within("temperature_C", temperature_C, -100.0, 80.0);
    const Site site{
        .latitude_deg = latitude_deg, .longitude_deg = longitude_deg, .height = height_m};
    const Instant instant = parse_instant(time);
    const SunPosition at = pressure_hPa ? sun_position(site, instant, *pressure_hPa, temperature_C)
                                        : sun_position(site, instant);
    return py::make_tuple(at.azimuth_deg, at.elevation_deg, at.distance_au);
}

py::object radiance(const std::string& band, py::array_t<double> temperature) {
    const Band of = band_of(band);
    const auto each = [&](double kelvin) {
        check_within("temperature_K", kelvin, 0.0, 20000.0);
        return band_radiance(of, kelvin);
    };
    return py::vectorize(each)(std::move(temperature));
}

py::object apparent_temperature(const std::string& band, py::array_t<double> radiance) {
    const Band of = band_of(band);
    const auto each = [&](double value) {
        if (!std::isfinite(value))
            throw InputError("radiance", "found a value that is not finite",
                             "expected numbers in W/m2 sr");
        return brightness_temperature(of, value);
    };
    return py::vectorize(each)(std::move(radiance));
}

py::list path(const std::vector<std::string>& names, const std::string& profile,
              const std::string& aerosol, double visibility_km, double co2_ppm, double ground_km,
              double rain_mm_h, const AirPath& air_path) {
    const BandModel model{.profile = named_profile(profile),
                          .aerosol = aerosol,
                          .visibility_km = visibility_km,
                          .co2_ppm = co2_ppm,
                          .ground_km = ground_km,
                          .rain_mm_h = rain_mm_h};
    check(model);
    std::vector<Band> bands;
    for (const std::string& name : names) bands.push_back(band_of(name, bin_edges_um()));
    std::vector<PathInBand> found;
    {
        const RunningCall running;
        const py::gil_scoped_release free;
        found = paths_in_bands(air_path, model, line_of(air_path, model), bands);
    }
    py::list rows;
    for (const PathInBand& one : found)
        rows.append(py::make_tuple(one.transmittance, one.thermal, one.scattered, one.contrast));
    return rows;
}

}  // namespace

void bind_point(py::module_& module) {
    module.def("sun", &sun, "Azimuth, elevation [deg] and distance [au] of the sun.",
               py::arg("latitude_deg"), py::arg("longitude_deg"), py::arg("time"),
               py::arg("height_m"), py::arg("pressure_hPa"), py::arg("temperature_C"));
    module.def("band_radiance", &radiance, "Radiance of a black body [W m-2 sr-1].",
               py::arg("band"), py::arg("temperature_K"));
    module.def("apparent_temperature", &apparent_temperature,
               "Temperature [K] of the black body of a radiance.", py::arg("band"),
               py::arg("radiance"));
    py::class_<AirPath>(module, "AirPath", "Start, direction and end of a path through the air.")
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
    module.def("path", &path,
               "Of each band: mean transmittance, thermal and scattered radiance [W m-2 sr-1], and "
               "the transmittance of a small contrast.",
               py::arg("bands"), py::arg("profile"), py::arg("aerosol"), py::arg("visibility_km"),
               py::arg("co2_ppm"), py::arg("ground_km"), py::arg("rain_mm_h"), py::arg("air_path"));
}

}  // namespace diurna::python
