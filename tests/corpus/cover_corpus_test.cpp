#include <catch2/catch.hpp>

#include "tests/corpus/run_corpus.hpp"

// What lies on the ground: textures, shapes, land cover.

namespace {

using corpus::changed;
using corpus::Family;
using corpus::Malformed;

const std::string png_head = std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);

std::string big_endian(unsigned value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}
std::string png(unsigned width, unsigned height) {
    return png_head + big_endian(width) + big_endian(height) +
           std::string("\x08\0\0\0\0\0\0\0\0", 9);
}

/// Bytes that are no picture, no raster and no list of shapes.
const std::map<std::string, std::string>& no_file() {
    static const std::map<std::string, std::string> texts{
        {"nothing", ""},
        {"text", "hello\n"},
        {"NULs", std::string(5000, '\0')},
        {"noise", "\x01\xff\x17\x80\xfe\x02 \x90\x33\x7f"},
        {"PNG's first bytes", png_head},
        {"PNG without rows", png(40, 40)},
        {"PNG of 2^31 columns", png(0x7fffffffu, 0x7fffffffu)},
        {"PNG of no column", png(0, 40)},
        {"TIFF's first bytes", std::string("II*\0\x08\0\0\0", 8)},
        {"TIFF that leads to itself",
         std::string("II*\0\x08\0\0\0\x01\0\0\x01\x03\0\x01\0\0\0\x28\0\0\0\x08\0\0\0", 26)},
        {"BigTIFF of 2^60", std::string("II+\0\x08\0\0\0\xff\xff\xff\xff\xff\xff\xff\x0f", 16)},
        {"JPEG's first bytes", "\xff\xd8\xff\xe0\x10JFIF"},
        {"a spreadsheet", std::string("PK\x03\x04\x14\0\0\0", 8) + std::string(200, 'x')},
        {"HDF5's first bytes", "\x89HDF\r\n\x1a\n"},
        {"SQLite's first bytes", std::string("SQLite format 3\0\x10\0\x01\x01", 20)},
        {"a virtual raster", "<VRTDataset rasterXSize=\"40\" rasterYSize=\"40\"/>"},
        {"XML of doubled entities",
         "<!DOCTYPE a [<!ENTITY b \"bb\"><!ENTITY c \"&b;&b;&b;\">]><a>&c;</a>"},
        {"a service", "<GDAL_WMS><Service name=\"TMS\"/></GDAL_WMS>"}};
    return texts;
}

std::string envi_head(const std::string& columns, const std::string& type,
                      const std::string& more = "") {
    return "ENVI\nsamples = " + columns +
           "\nlines = 40\nbands = 1\nheader offset = 0\ndata type = " + type +
           "\ninterleave = bsq\nbyte order = 0\n" + more;
}

/// The yard with a picture in place of its clutter.
std::string textured(const std::string& file,
                     const std::string& more = "metres_per_texel = 1.0\n") {
    return changed(yard::scene,
                   "kind = \"clutter\"\nstd = 0.05\ncorrelation_length_m = 5.0\nseed = 2\n",
                   "file = \"" + file + "\"\n" + more);
}

Family textures() {
    Family cases;
    for (const auto& [name, text] : no_file()) {
        for (const char* file : {"t.png", "t.tif", "t.img"}) {
            cases.push_back({.name = std::string(file) + ": " + name,
                             .files = {{"scene.toml", textured(file)}, {file, text}}});
        }
    }
    const auto envi = [&](const std::string& name, const std::string& head,
                          const std::string& bytes,
                          const std::string& more = "metres_per_texel = 1.0\n") {
        cases.push_back(
            {.name = "t.img: " + name,
             .files = {
                 {"scene.toml", textured("t.img", more)}, {"t.img", bytes}, {"t.hdr", head}}});
    };
    const std::string bytes(1600, '\x40');
    std::string nans;
    for (int i = 0; i < 1600; ++i) nans += std::string("\0\0\xc0\x7f", 4);
    envi("half its bytes", envi_head("40", "1"), bytes.substr(800));
    envi("10^9 columns", envi_head("1000000000", "1"), bytes);
    envi("no column", envi_head("0", "1"), bytes);
    envi("-40 columns", envi_head("-40", "1"), bytes);
    envi("a type that is none", envi_head("40", "99"), bytes);
    envi("nan in all", envi_head("40", "4"), nans);
    envi("a second channel", envi_head("40", "1"), bytes, "metres_per_texel = 1.0\nchannel = 2\n");
    envi("no place", envi_head("40", "1"), bytes, "");
    envi("values beyond 1", envi_head("40", "1"), bytes, "metres_per_texel = 1.0\nscale = 1e6\n");
    envi("values below 0", envi_head("40", "1"), bytes, "metres_per_texel = 1.0\nscale = -1.0\n");
    cases.push_back({.name = "not there", .files = {{"scene.toml", textured("nothing.png")}}});
    cases.push_back({.name = "a folder", .files = {{"scene.toml", textured(".")}}});
    cases.push_back({.name = "beyond its folder",
                     .files = {{"scene.toml", textured("../../../../etc/passwd")}}});
    cases.push_back({.name = "a device", .files = {{"scene.toml", textured("/dev/zero")}}});
    return cases;
}

const std::string square = "[[[9.0,46.999],[9.001,46.999],[9.001,47.0],[9.0,47.0],[9.0,46.999]]]";

std::string feature(const std::string& geometry, const std::string& properties = "{}") {
    return "{\"type\":\"Feature\",\"properties\":" + properties + ",\"geometry\":" + geometry + "}";
}
std::string polygon(const std::string& coordinates, const std::string& properties = "{}") {
    return feature("{\"type\":\"Polygon\",\"coordinates\":" + coordinates + "}", properties);
}
std::string collection(const std::string& features, const std::string& more = "") {
    return "{\"type\":\"FeatureCollection\"," + more + "\"features\":[" + features + "]}";
}

Family shapes() {
    Family cases;
    const auto shape = [&](const std::string& name, const std::string& file,
                           const std::string& text, const std::string& more = "") {
        cases.push_back({.name = file + ": " + name,
                         .files = {{"scene.toml", yard::scene + "[[shapes]]\nfile = \"" + file +
                                                      "\"\nmaterial = \"asphalt\"\n" + more},
                                   {file, text}}});
    };
    for (const auto& [name, text] : no_file()) {
        for (const char* file : {"s.geojson", "s.shp", "s.gpkg"}) shape(name, file, text);
    }
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "[";
    std::string ring = "[[";
    for (int i = 0; i < 60000; ++i) {
        ring += fmt::format("[9.{:06},47.0{:05}],", i, (i * 7919) % 60000);
    }
    const auto json = [&](const std::string& name, const std::string& text,
                          const std::string& more = "") { shape(name, "s.geojson", text, more); };
    json("half of it", collection(polygon(square)).substr(0, 120));
    json("brackets alone", deep);
    json("coordinates of brackets", collection(polygon(deep)));
    json("coordinates of text", collection(polygon("\"here\"")));
    json("corners of text", collection(polygon("[[[\"a\",\"b\"],[1,2],[3,4],[\"a\",\"b\"]]]")));
    json("corners at nan", collection(polygon("[[[NaN,47],[9.001,46.999],[9,47],[NaN,47]]]")));
    json("corners at 1e300",
         collection(polygon("[[[1e300,47],[9.001,46.999],[9,1e300],[1e300,47]]]")));
    json("corners at 999 degrees",
         collection(polygon("[[[999,47],[999.1,46.999],[999,46.9],[999,47]]]")));
    json("a fetched CRS",
         collection(polygon(square),
                    "\"crs\":{\"type\":\"link\",\"properties\":{\"href\":\"http://127.0.0.1:9/\","
                    "\"type\":\"proj4\"}},"));
    json("a CRS that is none",
         collection(polygon(square),
                    "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:999999\"}},"));
    json("a field that is not there", collection(polygon(square)), "field = \"kind\"\n");
    json("a height that is not there", collection(polygon(square)),
         "wall = \"concrete_wall\"\nheight_field = \"h\"\n");
    json("a height of -5", collection(polygon(square, "{\"h\":-5}")),
         "wall = \"concrete_wall\"\nheight_field = \"h\"\n");
    json("a height of 1e9", collection(polygon(square, "{\"h\":1e9}")),
         "wall = \"concrete_wall\"\nheight_field = \"h\"\n");
    json("a height of nan", collection(polygon(square, "{\"h\":\"nan\"}")),
         "wall = \"concrete_wall\"\nheight_field = \"h\"\n");
    return cases;
}

Family land_cover() {
    Family cases;
    const auto cover = [&](const std::string& name, const std::string& file,
                           const std::string& text, const std::string& more = "1 = \"sand\"\n") {
        cases.push_back(
            {.name = file + ": " + name,
             .files = {{"scene.toml", yard::scene + "[terrain.land_cover]\nfile = \"" + file +
                                          "\"\n[terrain.land_cover.material]\n" + more},
                       {file, text},
                       {"c.prj", yard::projection}}});
    };
    for (const auto& [name, text] : no_file()) {
        for (const char* file : {"c.tif", "c.asc", "c.png"}) cover(name, file, text);
    }
    const std::string fine = yard::posts(yard::raster_head, 1600, "1");
    const auto head = [&](const std::string& name, const std::string& from, const std::string& to) {
        cover(name, "c.asc", changed(fine, from, to));
    };
    cover("too few cells", "c.asc", yard::posts(yard::raster_head, 1000, "1"));
    head("10^9 columns", "ncols 40", "ncols 1000000000");
    head("no row", "nrows 40", "nrows 0");
    head("cells of 0", "cellsize 10", "cellsize 0");
    head("cells of nan", "cellsize 10", "cellsize nan");
    head("classes of text", "1 1 1", "1 x 1");
    head("classes of 1.5", "1 1 1", "1 1.5 1");
    head("classes of nan", "1 1 1", "1 nan 1");
    head("classes of 1e30", "1 1 1", "1 1e30 1");
    cover("a material that is not there", "c.asc", fine, "1 = \"nothing\"\n");
    cover("a class of text", "c.asc", fine, "grass = \"sand\"\n");
    cover("a class of 1.5", "c.asc", fine, "\"1.5\" = \"sand\"\n");
    cover("no class at all", "c.asc", fine, "");
    return cases;
}

}  // namespace

TEST_CASE("textures that cannot be are refused") { corpus::no_fault("textures", textures()); }
TEST_CASE("shapes that cannot be are refused") { corpus::no_fault("shapes", shapes()); }
TEST_CASE("land cover that cannot be is refused") { corpus::no_fault("land cover", land_cover()); }
