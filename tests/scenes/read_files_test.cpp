#include <netcdf.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "materials/base/error.hpp"
#include "scenes/products/export/inspect.hpp"
#include "scenes/products/export/zip_file.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/land_shapes.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/read_weather.hpp"

// Elevation, shapes and weather in the files that services and programs give out.

using namespace diurna;

namespace {

struct NetcdfGrid {
    std::string latitude_unit = "degrees_north", longitude_unit = "degrees_east";
    bool south_first = false, longitude_first = false;
    std::vector<std::string> variables{"z"};
    std::string unit = "m";
};

/// 4 x 4 posts of 100 m + 10 row + column, rows from the north, at 36.00 to 36.03 N, 8.00 to 8.03
/// E.
void write_netcdf_grid(const std::filesystem::path& file, const NetcdfGrid& grid) {
    int nc = 0, north = 0, east = 0, v_north = 0, v_east = 0;
    REQUIRE(nc_create(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &nc) == NC_NOERR);
    nc_def_dim(nc, "lat", 4, &north);
    nc_def_dim(nc, "lon", 4, &east);
    nc_def_var(nc, "lat", NC_DOUBLE, 1, &north, &v_north);
    nc_def_var(nc, "lon", NC_DOUBLE, 1, &east, &v_east);
    nc_put_att_text(nc, v_north, "units", grid.latitude_unit.size(), grid.latitude_unit.c_str());
    nc_put_att_text(nc, v_east, "units", grid.longitude_unit.size(), grid.longitude_unit.c_str());
    const int order[]{grid.longitude_first ? east : north, grid.longitude_first ? north : east};
    std::vector<int> id(grid.variables.size());
    for (std::size_t v = 0; v < id.size(); ++v) {
        nc_def_var(nc, grid.variables[v].c_str(), NC_FLOAT, 2, order, &id[v]);
        nc_put_att_text(nc, id[v], "units", grid.unit.size(), grid.unit.c_str());
    }
    nc_enddef(nc);
    double lat[4], lon[4];
    float height[16];
    for (int k = 0; k < 4; ++k) {
        lat[k] = grid.south_first ? 36.0 + 0.01 * k : 36.03 - 0.01 * k;
        lon[k] = 8.0 + 0.01 * k;
    }
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const int row = grid.south_first ? 3 - i : i;
            height[4 * i + j] = float(100 + 10 * row + j);
        }
    }
    nc_put_var_double(nc, v_north, lat);
    nc_put_var_double(nc, v_east, lon);
    for (const int one : id) nc_put_var_float(nc, one, height);
    REQUIRE(nc_close(nc) == NC_NOERR);
}

}  // namespace

TEST_CASE("netCDF on latitude and longitude needs no grid_mapping", "[terrain][dem][netcdf]") {
    const ScratchFolder folder("nc_grid");
    const auto file = folder.path / "grid.nc";
    const NetcdfGrid grid =
        GENERATE(NetcdfGrid{}, NetcdfGrid{.south_first = true},
                 NetcdfGrid{.latitude_unit = "degree_north", .longitude_unit = "degree_east"},
                 NetcdfGrid{.latitude_unit = "degrees_N", .longitude_unit = "degrees_E"},
                 NetcdfGrid{.variables = {"lsm", "Elevation"}});
    write_netcdf_grid(file, grid);
    const Dem dem = read_dem(file);
    CHECK(dem.at(0, 0) == 100.0f);
    CHECK(dem.at(3, 1) == 131.0f);
    // The post of the second row from the south, third column.
    CHECK(height_at(dem, 36.01, 8.02) == Approx(122.0).margin(0.01));
    CHECK(inspect(file).kind == "elevation raster");
}

TEST_CASE("netCDF on other axes, or in another order, is refused", "[terrain][dem][netcdf]") {
    const ScratchFolder folder("nc_axes");
    const auto file = folder.path / "grid.nc";
    write_netcdf_grid(file, {.longitude_first = true});
    CHECK_THROWS_WITH(read_dem(file), Catch::Contains("longitude, latitude"));
    write_netcdf_grid(file, {.latitude_unit = "m", .longitude_unit = "m"});
    CHECK_THROWS_AS(read_dem(file), InputError);
    write_netcdf_grid(file, {.variables = {"lsm", "slope"}});
    CHECK_THROWS_WITH(read_dem(file), Catch::Contains("lsm, slope"));
    const Found found = inspect(file);
    CHECK(found.kind == "rasters");
}

TEST_CASE("grids of text are read from archives, whatever macOS puts in", "[terrain][dem][zip]") {
    const ScratchFolder folder("asc_zip");
    const std::string grid =
        "ncols 2\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 30\n1 2\n3 4\n";
    const std::string projection =
        "Projection UTM\nZone 33\nDatum WGS84\nZunits FEET\nUnits METERS\n";
    write_text(
        folder.path / "grid.zip",
        zip_archive({{"__MACOSX/._dem.asc", "xx"}, {"dem.asc", grid}, {"dem.prj", projection}}));
    CHECK(read_dem(folder.path / "grid.zip").at(1, 1) == Approx(4.0));
    // A unit of heights in an old .prj.
    write_text(folder.path / "dem.asc", grid);
    write_text(folder.path / "dem.prj", projection);
    CHECK(read_dem(folder.path / "dem.asc").at(1, 1) == Approx(4.0 * 0.3048));
    write_text(folder.path / "dem.asc",
               "ncols 2\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 30\n1 2\n3 9999\n");
    write_text(folder.path / "dem.prj", "Projection UTM\nZone 33\nDatum WGS84\nUnits METERS\n");
    CHECK_THROWS_WITH(read_dem(folder.path / "dem.asc"), Catch::Contains("-a_nodata 9999"));
}

TEST_CASE("EPW is read in the archive that it comes in", "[thermal][weather_file][zip]") {
    const ScratchFolder folder("epw_zip");
    std::string epw =
        "LOCATION,Place,-,-,-,0,45.0,8.0,1.0,250.0\nDESIGN CONDITIONS,0\n"
        "TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n"
        "COMMENTS 1,\nCOMMENTS 2,\nDATA PERIODS,1,1,Data,Sunday, 7/ 8, 7/ 8\n";
    for (int hour = 1; hour <= 24; ++hour) {
        epw += fmt::format("2018,7,8,{},0,x,{},5,50,98000,0,0,300,0,0,0,9,9,9,9,180,2.0\n", hour,
                           10 + hour);
    }
    const auto file = folder.path / "TORINO.zip";
    write_text(file, zip_archive({{"TORINO.ddy", "x"}, {"TORINO.epw", epw}, {"TORINO.stat", "y"}}));
    CHECK(weather_format(file) == WeatherFormat::epw);
    CHECK(read_weather(file).sample.size() == 24);
    CHECK(inspect(file).kind == "weather");
}

namespace {

std::string feature(double east, double north, const std::string& name) {
    std::string ring;
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1e-3, 0.0}, {1e-3, 1e-3}, {0.0, 0.0}}) {
        ring += fmt::format("{}[{:.4f},{:.4f}]", ring.empty() ? "" : ",", east + x, north + y);
    }
    return fmt::format(R"({{"type":"Feature","properties":{{"name":"{}"}},"geometry":)"
                       R"({{"type":"Polygon","coordinates":[[{}]]}}}})",
                       name, ring);
}

}  // namespace

TEST_CASE("shapes are read a feature a line, from KML and from archives", "[terrain][shapes]") {
    const ScratchFolder folder("shape_files");
    const std::string lines = feature(8.0, 45.0, "a") + "\n" + feature(8.1, 45.0, "b") + "\n";
    write_text(folder.path / "shapes.geojsonl", lines);
    CHECK(read_shapes(folder.path / "shapes.geojsonl").size() == 2);
    CHECK(inspect(folder.path / "shapes.geojsonl").kind == "shapes");
    const std::string kml =
        "<?xml version=\"1.0\"?><kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>"
        "<Placemark><name>a</name><Polygon><outerBoundaryIs><LinearRing><coordinates>"
        "8.0,45.0,0 8.001,45.0,0 8.001,45.001,0 8.0,45.0,0</coordinates></LinearRing>"
        "</outerBoundaryIs></Polygon></Placemark></Document></kml>";
    write_text(folder.path / "shapes.kml", kml);
    write_text(folder.path / "shapes.kmz", zip_archive({{"doc.kml", kml}}));
    for (const char* name : {"shapes.kml", "shapes.kmz"}) {
        const auto shapes = read_shapes(folder.path / name);
        REQUIRE(shapes.size() == 1);
        CHECK(shapes[0].ring.size() == 3);
        CHECK(shapes[0].ring[1].longitude_deg == Approx(8.001));
        CHECK(shapes[0].ring[2].latitude_deg == Approx(45.001));
    }
    write_text(folder.path / "shapes.gml", "<gml/>");
    CHECK_THROWS_WITH(read_shapes(folder.path / "shapes.gml"), Catch::Contains("ogr2ogr"));
}
