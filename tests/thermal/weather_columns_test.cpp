#include <netcdf.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "tests/support/refused_weather.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/read_weather.hpp"

// ERA5 at a point and tables of other people's columns: excerpts in the published layouts, expected
// numbers read off them by hand, through published conversions.

using namespace diurna;
using namespace diurna::testing;

TEST_CASE("ERA5 CSV: joules of an hour, components of wind, a dew point",
          "[thermal][weather_file]") {
    const ScratchFolder folder("era5");
    const auto file = folder.path / "point.csv";
    const std::string header =
        "valid_time,u10,v10,d2m,t2m,msl,sst,skt,sp,ssrd,strd,tp,latitude,longitude\n";
    const std::string first =
        "2022-07-01 11:00:00,3.0,-4.0,283.15,293.15,101500.0,,295.0,98000.0,1800000.0,1080000.0,"
        "0.0,50.0,10.0\n";
    const std::string second =
        "2022-07-01 12:00:00,6.0,8.0,283.15,295.15,101500.0,,296.0,98100.0,2160000.0,1116000.0,"
        "0.0005,50.0,10.0\n";
    write_text(file, header + first + second);
    CHECK(weather_format(file) == WeatherFormat::era5_csv);
    const Weather w = read_weather(file);
    CHECK(w.instant[1] == parse_instant("2022-07-01T11:30:00Z"));
    CHECK(w.sample[1].shortwave_down == Approx(600.0));  // 2.16 MJ in 3600 s
    CHECK(w.sample[1].longwave_down == Approx(310.0));
    CHECK(w.sample[1].rain_mm_h == Approx(0.5));
    CHECK(w.sample[1].wind_speed == Approx(7.5));  // half way from 5 to 10
    CHECK(w.sample[1].air.temperature == Approx(294.15));
    // WMO-No. 8, 4.B: e(10 °C) = 6.112 exp(17.62 · 10 / 253.12) = 12.26 hPa.
    CHECK(w.sample[1].air.vapour_pressure == Approx(1226.0).epsilon(2e-3));
    CHECK(has(message_of(file, header + first +
                                   "2022-07-01 12:00:00,6,8,283,295,1e5,,296,98100,2160000,1116000,"
                                   "0,50.25,10.0\n"),
              "another place"));
    CHECK(has(message_of(file, header + first +
                                   "2022-07-01 12:00:00,6,8,283,295,1e5,,296,98100,9160000,1116000,"
                                   "0,50.0,10.0\n"),
              "converted only if they increase"));
}

TEST_CASE("ERA5 netCDF: packed values, time since an epoch, one point", "[thermal][weather_file]") {
    const ScratchFolder folder("era5nc");
    const auto file = folder.path / "point.nc";
    const auto write = [&](std::size_t points) {
        int nc = 0, time = 0, north = 0, east = 0;
        REQUIRE(nc_create(file.c_str(), NC_CLOBBER, &nc) == NC_NOERR);
        nc_def_dim(nc, "time", 2, &time);
        nc_def_dim(nc, "latitude", points, &north);
        nc_def_dim(nc, "longitude", 1, &east);
        const int over_time[]{time}, over_all[]{time, north, east};
        const int over_north[]{north}, over_east[]{east};
        int v_time = 0, v_north = 0, v_east = 0, t2m = 0, ssrd = 0, sp = 0;
        nc_def_var(nc, "time", NC_INT, 1, over_time, &v_time);
        const std::string units = "hours since 1900-01-01 00:00:00.0";
        nc_put_att_text(nc, v_time, "units", units.size(), units.c_str());
        nc_def_var(nc, "latitude", NC_FLOAT, 1, over_north, &v_north);
        nc_def_var(nc, "longitude", NC_FLOAT, 1, over_east, &v_east);
        nc_def_var(nc, "t2m", NC_SHORT, 3, over_all, &t2m);
        nc_def_var(nc, "ssrd", NC_DOUBLE, 3, over_all, &ssrd);
        nc_def_var(nc, "sp", NC_SHORT, 3, over_all, &sp);
        const double scale = 0.01, offset = 280.0, one = 10.0, zero = 90000.0;
        const short fill = -32767;
        nc_put_att_double(nc, t2m, "scale_factor", NC_DOUBLE, 1, &scale);
        nc_put_att_double(nc, t2m, "add_offset", NC_DOUBLE, 1, &offset);
        nc_put_att_double(nc, sp, "scale_factor", NC_DOUBLE, 1, &one);
        nc_put_att_double(nc, sp, "add_offset", NC_DOUBLE, 1, &zero);
        nc_put_att_short(nc, sp, "_FillValue", NC_SHORT, 1, &fill);
        nc_enddef(nc);
        // 44562 days from 1900-01-01 to 2022-01-03 (122 years with 30 leap days, and 2 days).
        const int hours[]{44562 * 24 + 11, 44562 * 24 + 12};
        const short kelvin[]{1000, 1200, 0, 0}, pressure[]{800, fill, 0, 0};
        const double sun[]{0.0, 360000.0, 0.0, 0.0};
        const float lat[]{50.0f, 49.75f}, lon[]{350.0f};
        nc_put_var_int(nc, v_time, hours);
        nc_put_var_float(nc, v_north, lat);
        nc_put_var_float(nc, v_east, lon);
        nc_put_var_short(nc, t2m, kelvin);
        nc_put_var_short(nc, sp, pressure);
        nc_put_var_double(nc, ssrd, sun);
        nc_close(nc);
    };
    write(1);
    CHECK(weather_format(file) == WeatherFormat::era5_netcdf);
    const Weather w = read_weather(file, {.site = Site{.latitude_deg = 40.0}});
    CHECK(w.instant[1] == parse_instant("2022-01-03T11:30:00Z"));
    CHECK(w.sample[1].air.temperature == Approx(291.0));  // half way from 290 to 292 K
    CHECK(w.sample[1].shortwave_down == Approx(100.0));
    CHECK(w.sample[1].air.pressure == Approx(98000.0));  // filled from the hour before
    // 10° of latitude and of longitude at 45° N: 1112 and 787 km.
    REQUIRE(w.warnings.size() == 1);
    CHECK(has(w.warnings.front().line(), "is 13"));
    // Of an area the point nearest to the site: 49.75° N, whose values stand second.
    write(2);
    const Weather near =
        read_weather(file, {.site = Site{.latitude_deg = 49.8, .longitude_deg = -10.1}});
    CHECK(near.sample[0].air.temperature == Approx(292.0));
    CHECK(near.sample[0].shortwave_down == Approx(100.0));
    CHECK(has(near.note, "2 x 1 grid points: the one at 49.75 N -10.00 E"));
    CHECK(near.warnings.empty());
    const Weather north =
        read_weather(file, {.site = Site{.latitude_deg = 50.1, .longitude_deg = -10.0}});
    CHECK(north.sample[0].air.temperature == Approx(290.0));
}

TEST_CASE("ERA5 netCDF: of final and preliminary values the one that is there counts",
          "[thermal][weather_file]") {
    const ScratchFolder folder("expver");
    const auto file = folder.path / "expver.nc";
    int nc = 0, time = 0, version = 0, v_time = 0, t2m = 0;
    REQUIRE(nc_create(file.c_str(), NC_CLOBBER, &nc) == NC_NOERR);
    nc_def_dim(nc, "time", 3, &time);
    nc_def_dim(nc, "expver", 2, &version);
    const int over_time[]{time}, over_both[]{time, version};
    nc_def_var(nc, "time", NC_INT, 1, over_time, &v_time);
    const std::string units = "hours since 2022-01-01 00:00:00.0";
    nc_put_att_text(nc, v_time, "units", units.size(), units.c_str());
    nc_def_var(nc, "t2m", NC_FLOAT, 2, over_both, &t2m);
    nc_enddef(nc);
    const int hours[]{0, 1, 2};
    const float nan = std::nanf("");
    const float kelvin[]{280.0f, nan, 281.0f, 999.0f, nan, 282.0f};
    nc_put_var_int(nc, v_time, hours);
    nc_put_var_float(nc, t2m, kelvin);
    nc_close(nc);
    const WeatherTable table = read_weather_table(file, {});
    CHECK(table.of(Quantity::air_temperature) == std::vector<double>{280.0, 281.0, 282.0});
}

TEST_CASE("ERA5: instantaneous and accumulated variables in two files are one series",
          "[thermal][weather_file]") {
    const ScratchFolder folder("era5_parts");
    write_text(folder.path / "instant.csv",
               "valid_time,t2m,latitude,longitude\n2022-07-01 11:00:00,290,50,10\n"
               "2022-07-01 12:00:00,292,50,10\n");
    write_text(folder.path / "accum.csv",
               "valid_time,ssrd,fdir,latitude,longitude\n2022-07-01 12:00:00,1800000,1080000,50,"
               "10\n2022-07-01 13:00:00,2160000,1440000,50,10\n");
    const std::vector<std::filesystem::path> files{folder.path / "instant.csv",
                                                   folder.path / "accum.csv"};
    const WeatherTable table = read_weather_tables(files, {});
    REQUIRE(table.stamp.size() == 3);
    CHECK(table.of(Quantity::shortwave_down)[1] == 500.0);  // 1.8 MJ in an hour
    CHECK(table.of(Quantity::diffuse)[1] == 200.0);
    CHECK(table.of(Quantity::air_temperature)[1] == 292.0);
    CHECK(std::isnan(table.of(Quantity::air_temperature)[2]));
    write_text(folder.path / "far.csv",
               "valid_time,t2m,latitude,longitude\n2022-07-02 11:00:00,290,60,10\n");
    CHECK_THROWS_WITH(
        read_weather_tables(std::vector<std::filesystem::path>{files[0], folder.path / "far.csv"},
                            {}),
        Catch::Contains("the same place"));
}

TEST_CASE("columns of other names are read in the units they are declared in",
          "[thermal][weather_file]") {
    const ScratchFolder folder("metar");
    const auto file = folder.path / "asos.csv";
    const auto declared = [](const char* name, const char* says) {
        return declared_column(name, says, "weather.columns." + std::string(name));
    };
    const std::string text =
        "#DEBUG: header of the archive\n"
        "station,valid,tmpf,dwpf,relh,sknt,p01i,alti,skyc1\n"
        "KTYS,2025-07-01 11:53,68.00,50.00,M,10.00,0.10,29.92,FEW\n"
        "KTYS,2025-07-01 12:53,77.00,50.00,40.0,M,T,30.02,SCT\n"
        "KTYS,2025-07-01 13:53,86.00,50.00,30.0,20.00,M,29.92,SCT\n";
    const std::vector<DeclaredColumn> columns{
        declared("valid", "time UTC"),       declared("tmpf", "air_temperature degF"),
        declared("dwpf", "dew_point degF"),  declared("relh", "relative_humidity %"),
        declared("sknt", "wind_speed kn"),   declared("p01i", "rain in"),
        declared("alti", "altimeter [inHg]")};
    write_text(file, text);
    const Weather w =
        read_weather(file, {.interval = Stamp::instant, .elevation = 1609.0, .columns = columns});
    CHECK(w.instant[0] == parse_instant("2025-07-01T11:53:00Z"));
    CHECK(w.sample[0].air.temperature == Approx(293.15));            // 68 °F = 20 °C
    CHECK(w.sample[2].air.temperature == Approx(303.15));            // 86 °F = 30 °C
    CHECK(w.sample[0].wind_speed == Approx(5.14444).epsilon(1e-5));  // 1 kn = 1852 m / 3600 s
    CHECK(w.sample[1].wind_speed == Approx(15.0 * 1852.0 / 3600.0));
    CHECK(w.sample[0].rain_mm_h == Approx(2.54));
    CHECK(w.sample[1].rain_mm_h == 0.0);  // a trace
    // The dew point has no gap, the humidity has: e(10 °C) = 12.26 hPa throughout.
    CHECK(w.sample[1].air.vapour_pressure == Approx(1226.0).epsilon(2e-3));
    // 29.92 inHg is the standard atmosphere's 1013.25 hPa; it has 834.3 hPa at 1609 m.
    CHECK(w.sample[0].air.pressure == Approx(83430.0).epsilon(2e-3));
    CHECK(has(w.note, "columns not used: station, skyc1"));

    CHECK(has(message_of(file, text), "found the columns 'station', 'valid', 'tmpf'"));
    CHECK(has(message_of(file, text, {.columns = {declared("tmpc", "air_temperature degC")}}),
              "did you mean 'tmpf'?"));
    CHECK_THROWS_WITH(declared("x", "air_temprature degC"), Catch::Contains("air_temperature"));
    CHECK_THROWS_WITH(declared("x", "air_temperature hPa"), Catch::Contains("degC"));
    CHECK(declared("t", "time -05:30").offset_h == -5.5);

    // Metric reports, semicolons of hours apart from UTC: 15 °C, 80 %, 1018 hPa, okta.
    write_text(
        file,
        "when,T,U,ff,p,N\n2025-07-01T12:00,15,80,36,1018,4\n2025-07-01T13:00,16,81,36,1018,8\n");
    const Weather metric = read_weather(
        file, {.columns = {declared("when", "time +02:00"), declared("T", "air_temperature °C"),
                           declared("U", "relative_humidity %"), declared("ff", "wind_speed km/h"),
                           declared("p", "pressure hPa"), declared("N", "cloud_fraction okta")}});
    CHECK(metric.instant[1] == parse_instant("2025-07-01T10:30:00Z"));  // CSV: the interval's end
    CHECK(metric.sample[0].air.temperature == Approx(288.15));
    CHECK(metric.sample[0].wind_speed == Approx(10.0));
    CHECK(metric.sample[0].air.pressure == Approx(101800.0));
    CHECK(metric.sample[0].cloud_fraction == Approx(0.5));
    // e(15 °C) = 17.04 hPa (WMO-No. 8, 4.B).
    CHECK(metric.sample[0].air.vapour_pressure == Approx(0.8 * 1704.0).epsilon(2e-3));
}
