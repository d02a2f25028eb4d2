#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "tests/support/small_scene.hpp"

/// Objects on ground that is given by a formula.
namespace slope_scene {

/// Height [m] of the ground at an east and a north [m].
using Ground = std::function<double(double, double)>;

/// A plane that falls by so many degrees towards an azimuth.
inline Ground plane(double slope_deg, double towards_deg) {
    const double fall = std::tan(slope_deg * M_PI / 180.0), a = towards_deg * M_PI / 180.0;
    return [=](double east, double north) {
        return 500.0 - fall * (std::sin(a) * east + std::cos(a) * north);
    };
}

/// A raster of 60 x 60 posts every 2 m about the site, in a projection that is level there.
inline void write_ground(const std::filesystem::path& folder, const Ground& ground,
                         double cell = 2.0) {
    constexpr int posts = 60;
    std::string grid =
        fmt::format("ncols {0}\nnrows {0}\nxllcenter {1}\nyllcenter {1}\ncellsize {2}\n", posts,
                    -0.5 * (posts - 1) * cell, cell);
    for (int row = posts - 1; row >= 0; --row) {
        for (int column = 0; column < posts; ++column) {
            grid += fmt::format("{:.5f} ", ground(cell * (column - 0.5 * (posts - 1)),
                                                  cell * (row - 0.5 * (posts - 1))));
        }
        grid += "\n";
    }
    write_text(folder / "ground.asc", grid);
    write_text(folder / "ground.prj",
               R"(PROJCS["local",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,)"
               R"(298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)"
               R"(PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",44],)"
               R"(PARAMETER["central_meridian",6],PARAMETER["scale_factor",1],)"
               R"(PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1]])");
}

/// A closed box, z up, as an OBJ file.
inline std::string box(double width, double length, double height) {
    const double x = 0.5 * width, y = 0.5 * length;
    std::string mesh;
    for (const double z : {0.0, height}) {
        for (const auto& [a, b] : {std::pair{-x, -y}, {x, -y}, {x, y}, {-x, y}}) {
            mesh += fmt::format("v {} {} {}\n", a, b, z);
        }
    }
    return mesh + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

inline constexpr const char* eye =
    "[[observer]]\nname = \"eye\"\nplace_m = [30.0, -30.0]\nheight_above_ground_m = 40.0\n"
    "look_at_m = [0.0, 0.0]\nhorizontal_fov_deg = 20.0\nwidth = 32\nheight = 24\nsamples = 1\n"
    "bands = [\"8-12\"]\n";

inline std::string object(const std::string& name, const std::string& rest) {
    return fmt::format(
               "[[object]]\nname = \"{0}\"\nmesh = \"{0}.obj\"\nup = \"z\"\n"
               "material = \"painted_steel\"\nlargest_edge_m = 8.0\nground_edge_m = 4.0\n",
               name) +
           rest + "\n";
}

/// The scene file of all that.
inline std::filesystem::path written(const std::filesystem::path& folder, const Ground& ground,
                                     const std::string& rest, const std::string& observer = eye) {
    write_ground(folder, ground);
    write_text(folder / "weather.csv",
               "time,air_temperature_K,relative_humidity,wind_speed_m_s,cloud_fraction\n"
               "2026-05-05T00:00:00Z,288,0.5,2,0\n2026-05-06T00:00:00Z,288,0.5,2,0\n");
    write_text(folder / "scene.toml",
               "[site]\nlatitude_deg = 44.0\nlongitude_deg = 6.0\n[terrain]\nelevation = "
               "\"ground.asc\"\nmaterial = \"rock\"\n" +
                   rest +
                   "[weather]\nfile = \"weather.csv\"\ninterval = \"instant\"\n[time]\nstart = "
                   "2026-05-05T00:00:00Z\nduration_h = 2.0\nstep_s = 3600.0\nspin_up = "
                   "\"steady\"\nframes = [\"2026-05-05T01:00:00Z\"]\n" +
                   observer);
    return folder / "scene.toml";
}

}  // namespace slope_scene
