#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "tests/corpus/run_corpus.hpp"

namespace {

using corpus::changed;
using corpus::Family;
using corpus::Malformed;
using corpus::scene;

const std::string pad = "rectangle_m = [0.0, 0.0, 40.0, 30.0, 10.0]";

Malformed file(const std::string& name, const std::string& file, const std::string& text) {
    return {.name = file + ": " + name, .files = {{file, text}}};
}

Family rasters() {
    const std::string fine = yard::posts(yard::raster_head, 1600);
    const auto asc = [&](const std::string& name, const std::string& text) {
        return file(name, "plain.asc", text);
    };
    const auto head = [&](const std::string& name, const std::string& from, const std::string& to) {
        return asc(name, changed(fine, from, to));
    };
    /// ENVI: its bytes beside a head of text.
    const auto envi = [](const std::string& name, const std::string& bytes,
                         const std::string& more) {
        return Malformed{
            .name = "envi: " + name,
            .files = {{"scene.toml", changed(yard::scene, "plain.asc", "e.img")},
                      {"e.img", bytes},
                      {"e.hdr",
                       "ENVI\nsamples = 40\nlines = 40\nbands = 1\nheader offset = 0\n"
                       "data type = 4\ninterleave = bsq\nbyte order = 0\n"
                       "map info = {UTM, 1, 1, 500000, 5205400, 10, 10, 32, North, WGS-84}\n" +
                           more}}};
    };
    return {
        asc("nothing", ""),
        asc("NULs", std::string(10000, '\0')),
        asc("text", "hello\n"),
        asc("the head alone", yard::raster_head),
        asc("too few posts", yard::posts(yard::raster_head, 1599)),
        asc("too many posts", yard::posts(yard::raster_head, 1601)),
        head("10^9 columns", "ncols 40", "ncols 1000000000"),
        head("no column", "ncols 40", "ncols 0"),
        head("-40 columns", "ncols 40", "ncols -40"),
        head("columns of text", "ncols 40", "ncols x"),
        head("one row", "nrows 40", "nrows 1"),
        head("cells of 0", "cellsize 10", "cellsize 0"),
        head("cells of -10", "cellsize 10", "cellsize -10"),
        head("cells of nan", "cellsize 10", "cellsize nan"),
        head("a place that is none", "xllcorner 500000", "xllcorner 1e30"),
        head("a post of text", "100 100", "100 x"),
        head("a post of nan", "100 100", "100 nan"),
        head("a post of inf", "100 100", "100 inf"),
        head("a post of 1e30", "100 100", "100 1e30"),
        head("a post of 20 km", "100 100", "100 20000"),
        head("a void", "100 100", "100 -9999"),
        asc("a void nobody declares",
            changed(changed(fine, "NODATA_value -9999\n", ""), "100 100", "100 -9999")),
        asc("voids alone", yard::posts(yard::raster_head, 1600, "-9999")),
        asc("all at -5 km", yard::posts(yard::raster_head, 1600, "-5000")),
        asc("one at -3 km", changed(fine, "100 100", "100 -3000")),
        file("no projection", "plain.prj", ""),
        file("a projection of text", "plain.prj", "PROJCS[\"x\""),
        scene("no such raster", "plain.asc", "nothing.asc"),
        scene("a weather file as raster", "plain.asc", "weather.csv"),
        envi("short", std::string(3000, '\0'), ""),
        envi("empty", "", ""),
        envi(
            "of nan",
            [] {
                std::string bytes(6400, '\0');
                const float nan = std::nanf("");
                for (std::size_t i = 0; i < 1600; ++i) std::memcpy(bytes.data() + 4 * i, &nan, 4);
                return bytes;
            }(),
            ""),
        envi("of 10^9 lines", std::string(6400, '\0'), "lines = 1000000000\n"),
        envi("an offset beyond it", std::string(6400, '\0'), "header offset = 1000000\n"),
    };
}

Family spectra() {
    const auto own = [](const std::string& name, const std::string& text) {
        return file(name, "own.csv", text);
    };
    const auto band = [](const std::string& name, const std::string& text) {
        return file(name, "long.csv", text);
    };
    const std::string head = "wavelength_um,reflectance\n";
    return {
        own("nothing", ""),
        own("the head alone", head),
        own("one row", head + "1,0.2\n"),
        own("nm for µm", head + "300,0.2\n1000,0.4\n2500,0.1\n"),
        own("nm named so", "wavelength_nm,reflectance\n300,0.2\n1000,0.4\n"),
        own("wavenumbers", head + "500,0.2\n1000,0.3\n4000,0.3\n"),
        own("per cent", head + "0.3,20\n1,40\n20,5\n"),
        own("in disorder", head + "20,0.2\n0.3,0.1\n1,0.4\n"),
        own("a wavelength twice", head + "0.3,0.2\n1,0.4\n1,0.3\n20,0.1\n"),
        own("negative", head + "0.3,-0.2\n1,0.4\n20,0.1\n"),
        own("a negative wavelength", head + "-0.3,0.2\n1,0.4\n20,0.1\n"),
        own("wavelength 0", head + "0,0.2\n1,0.4\n20,0.1\n"),
        own("nan", head + "0.3,nan\n1,0.4\n20,0.1\n"),
        own("text", head + "0.3,x\n1,0.4\n20,0.1\n"),
        own("three columns", "wavelength_um,reflectance,error\n0.3,0.2,0\n1,0.4,0\n"),
        own("two columns of one name", "wavelength_um,wavelength_um\n0.3,0.2\n1,0.4\n"),
        own("semicolons", "wavelength_um;reflectance\n0.3;0.2\n1;0.4\n"),
        own("NULs", std::string(1000, '\0')),
        band("nothing", ""),
        band("nm for µm", "wavelength_um,response\n8000,0\n9000,1\n12000,0\n"),
        band("per cent", "wavelength_um,response\n8,0\n9,100\n12,0\n"),
        band("all of it 0", "wavelength_um,response\n8,0\n9,0\n12,0\n"),
        band("in disorder", "wavelength_um,response\n12,0\n8,1\n9,0\n"),
        band("negative", "wavelength_um,response\n8,0\n9,-1\n12,0\n"),
    };
}

Family ways_and_air() {
    const auto way = [](const std::string& name, const std::string& text) {
        return file(name, "way.csv", text);
    };
    const std::string head = "time_s,east_m,north_m,height_m\n";
    const auto sonde = [](const std::string& name, const std::string& text) {
        Malformed given = scene("sonde: " + name, "profile = \"MLS\"", "sounding = \"s.csv\"");
        given.files["s.csv"] = text;
        return given;
    };
    const auto table = [](const std::string& name, const std::string& text) {
        Malformed given =
            scene("tape7: " + name, "profile = \"MLS\"\naerosol = \"rural\"\nvisibility_km = 23.0",
                  "table = \"t.tp7\"");
        given.files["t.tp7"] = text;
        return given;
    };
    const std::string levels = "height_m,pressure_hPa,temperature_K,relative_humidity_percent\n";
    return {
        way("nothing", ""),
        way("the head alone", head),
        way("one row", head + "0,0,0,50\n"),
        way("times reversed", head + "60,0,0,50\n0,10,0,50\n"),
        way("a time twice", head + "0,0,0,50\n0,10,0,50\n"),
        way("nan", head + "0,nan,0,50\n60,10,0,50\n"),
        way("text", head + "0,x,0,50\n60,10,0,50\n"),
        way("a column twice", "time_s,east_m,east_m,north_m,height_m\n0,0,0,0,50\n60,1,1,0,50\n"),
        way("latitude 91", "time_s,latitude_deg,longitude_deg,height_m\n0,91,9,50\n60,47,9,50\n"),
        way("a short row", head + "0,0,0\n60,10,0,50\n"),
        way("a quaternion of length 2",
            "time_s,east_m,north_m,height_m,qw,qx,qy,qz\n0,0,0,50,2,0,0,0\n60,1,0,50,2,0,0,0\n"),
        sonde("nothing", ""),
        sonde("the head alone", levels),
        sonde("Celsius as Kelvin", levels + "0,1000,15,50\n1000,900,10,50\n"),
        sonde("Pa as hPa", levels + "0,100000,288,50\n1000,90000,282,50\n"),
        sonde("a share as per cent of 500", levels + "0,1000,288,500\n1000,900,282,50\n"),
        sonde("km as m", levels + "0,1000,288,50\n1000000,900,282,50\n"),
        sonde("nan", levels + "0,1000,nan,50\n1000,900,282,50\n"),
        sonde("levels in disorder",
              levels + "0,1000,288,50\n5000,540,255,50\n1000,900,282,50\n6000,470,249,50\n"
                       "2000,800,275,50\n7000,410,242,50\n3000,700,268,50\n8000,350,236,50\n"
                       "4000,610,262,50\n9000,300,229,50\n"),
        table("nothing", ""),
        table("text", "this is no tape7\n"),
        table("NULs", std::string(4000, '\0')),
        table("numbers alone", "1 2 3 4 5\n6 7 8 9 10\n"),
    };
}

Family polygons_and_pictures() {
    const auto ring = [](const std::string& name, const std::string& corners) {
        return scene("ring: " + name,
                     "ring_m = [[-80.0, -80.0], [-40.0, -80.0], [-40.0, -40.0], [-80.0, -40.0]]",
                     "ring_m = " + corners);
    };
    return {
        ring("nothing", "[]"),
        ring("two corners", "[[0.0, 0.0], [1.0, 1.0]]"),
        ring("corners of three numbers", "[[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0]]"),
        ring("crossing itself", "[[0.0, 0.0], [20.0, 20.0], [20.0, 0.0], [0.0, 20.0]]"),
        ring("on a line", "[[0.0, 0.0], [10.0, 0.0], [20.0, 0.0]]"),
        ring("one point", "[[5.0, 5.0], [5.0, 5.0], [5.0, 5.0]]"),
        ring("outside", "[[9000.0, 0.0], [9010.0, 0.0], [9000.0, 10.0]]"),
        scene("a rectangle of no width", pad, "rectangle_m = [0.0, 0.0, 40.0, 0.0, 10.0]"),
        scene("no bands", "bands = [\"3-5\"]", "bands = []"),
        scene("a band twice", "bands = [\"8-12\", \"long\"]", "bands = [\"8-12\", \"8-12\"]"),
        scene("a band backwards", "bands = [\"3-5\"]", "bands = [\"5-3\"]"),
        scene("a band of 0", "bands = [\"3-5\"]", "bands = [\"0-0\"]"),
        scene("an unknown band", "bands = [\"3-5\"]", "bands = [\"short\"]"),
        scene("observers of one name", "name = \"flyer\"", "name = \"east\""),
        {.name = "a cube named like a band",
         .files = {{"scene.toml",
                    changed(changed(yard::scene, "name = \"fine\"", "name = \"long\""),
                            "cubes = [\"fine\"]", "cubes = [\"long\"]")}}},
        scene("20 000 channels", "channels = 8", "channels = 20000"),
        {.name = "more than 27 million pixels",
         .files = {{"scene.toml", changed(changed(yard::scene, "width = 32", "width = 6000"),
                                          "height = 24", "height = 5000")}}},
        scene("an empty name", "name = \"flyer\"", "name = \"\""),
        scene("a heat capacity below zero in its range", "heat_capacity_J_kgK = 800.0 }",
              "heat_capacity_J_kgK = 800.0, cubic_K3 = 1e-9, heat_capacity_polynomial = [100.0, "
              "-5.0, 0.0, 0.0, 0.0] }"),
        scene("a layer of no thickness", "thickness_m = 0.3", "thickness_m = 0.0"),
        scene("a start that is no moment", "start = 2026-06-20T00:00:00Z", "start = 3"),
        scene("pictures every ms of a day", "frame_every_s = 43200.0", "frame_every_s = 0.001"),
    };
}

}  // namespace

TEST_CASE("rasters that are no ground are refused") { corpus::no_fault("rasters", rasters()); }
TEST_CASE("spectra that cannot be are refused") { corpus::no_fault("spectra", spectra()); }
TEST_CASE("malformed trajectories and air are refused") {
    corpus::no_fault("ways", ways_and_air());
}
TEST_CASE("polygons and pictures that cannot be are refused") {
    corpus::no_fault("scenes", polygons_and_pictures());
}
