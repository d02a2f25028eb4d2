#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "tests/support/confined_place.hpp"

// What the files of a scene name in turn is read within the same bounds (SECURITY.md).

using namespace confined;

namespace {

const PrivateTempFolder temp;

}  // namespace

TEST_CASE("a mesh's library of materials is not opened", "[confinement][mesh_file]") {
    const Place place;
    const fs::path library = place.outside / "paint.mtl";
    write_text(library, "newmtl " + secret + "\nKd 1 1 1\n");
    fs::create_symlink(library, place.yard / "link.mtl");
    REQUIRE(::mkfifo((place.yard / "pipe.mtl").c_str(), 0600) == 0);
    place.write({.mesh = "named.obj"});
    for (const std::string& name :
         {std::string("../outside/paint.mtl"), std::string("inner/../../outside/paint.mtl"),
          std::string("../outside/none.mtl"), std::string("link.mtl"), std::string("pipe.mtl"),
          std::string("none.mtl"), library.string(), std::string("/dev/zero")}) {
        CAPTURE(name);
        write_text(place.yard / "named.obj", "mtllib " + name + "\n" + crate_mesh);
        const Ran ran = place.ran();
        CHECK(ran.code == 0);
        CHECK_THAT(ran.out, !Catch::Contains(secret));
        fs::remove(place.yard / "t.nc");
    }
    fs::create_directories(place.yard / "meshes");
    write_text(place.yard / "meshes/named.obj", crate_mesh);
    place.write({.mesh = "meshes/named.obj"});
    CHECK(place.ran().code == 0);
    write_text(place.outside / "named.parts.toml", secret + "\n");
    fs::create_symlink(place.outside / "named.parts.toml", place.yard / "meshes/named.parts.toml");
    fs::remove(place.yard / "t.nc");
    place.refused(beyond);
}

TEST_CASE("a glTF names no file beyond the scene's folder", "[confinement][mesh_file]") {
    const Place place;
    // One triangle: three corners of 12 bytes, three indices of 2.
    std::string bytes(42, '\0');
    const float corner[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::copy_n(reinterpret_cast<const char*>(corner), 36, bytes.data());
    bytes[38] = 1;
    bytes[40] = 2;
    write_text(place.outside / "b.bin", bytes);
    fs::create_symlink(place.outside / "b.bin", place.yard / "link.bin");
    REQUIRE(::mkfifo((place.yard / "pipe.bin").c_str(), 0600) == 0);
    const auto gltf = [&](const std::string& uri) {
        write_text(
            place.yard / "t.gltf",
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"byteLength":42,"uri":")" +
                uri + R"("}],"bufferViews":[{"buffer":0,"byteLength":36},
{"buffer":0,"byteOffset":36,"byteLength":6}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})");
    };
    place.write({.mesh = "t.gltf"});
    for (const std::string uri : {"../outside/b.bin", "link.bin"}) {
        CAPTURE(uri);
        gltf(uri);
        place.refused(beyond);
    }
    gltf("pipe.bin");
    place.refused("is not a regular file");
    for (const std::string uri :
         {"file:///etc/passwd", "%2e%2e/outside/b.bin", "http://127.0.0.1:9/b.bin"}) {
        CAPTURE(uri);
        gltf(uri);
        place.refused("t.gltf");
    }
    gltf((place.outside / "b.bin").string());
    place.refused("t.gltf");
    write_text(place.yard / "b.bin", bytes);
    gltf("b.bin");
    CHECK(run_diurna("check '" + (place.yard / "scene.toml").string() + "'").code == 0);
}

TEST_CASE("files beside a raster lead to no file outside the scene's folder",
          "[confinement][dem]") {
    const Place place;
    const fs::path beside = place.outside / "beside";
    write_text(beside, secret + "\n");
    for (const std::string name : {"level.prj", "level.asc.aux.xml"}) {
        CAPTURE(name);
        const fs::path sidecar = place.yard / name;
        place.write({});
        fs::remove(sidecar);
        fs::create_symlink(beside, sidecar);
        place.refused(beyond);
        fs::remove(sidecar);
        REQUIRE(::mkfifo(sidecar.c_str(), 0600) == 0);
        place.refused("is not a regular file");
        fs::remove(sidecar);
        fs::copy_file(DIURNA_SOURCE_DIR "/scenes/crossover/level.prj", place.yard / "level.prj",
                      fs::copy_options::skip_existing);
        CHECK(run_diurna("check '" + (place.yard / "scene.toml").string() + "'").code == 0);
    }
    // By the user's own name it may be a link; not so what GDAL finds beside it.
    fs::create_symlink(place.yard / "level.asc", place.outside / "mine.asc");
    fs::copy_file(place.yard / "level.prj", place.outside / "mine.prj");
    const std::string mesh = "mesh --tolerance-m 1 '" + (place.outside / "mine.asc").string() + "'";
    CHECK(run_diurna(mesh).code == 0);
    fs::remove(place.outside / "mine.prj");
    fs::create_symlink(place.yard / "level.prj", place.outside / "mine.prj");
    CHECK(run_diurna(mesh).code == 2);
}

TEST_CASE("a raster's metadata lead to no file beyond the scene's folder", "[confinement][dem]") {
    const Place place;
    const std::string tif = "elevation.tif";
    fs::copy_file(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif", place.yard / tif);
    fs::copy_file(place.yard / tif, place.outside / "other.tif");
    place.write({.elevation = tif});
    CHECK(run_diurna("check '" + (place.yard / "scene.toml").string() + "'").code == 0);
    for (const std::string name : {"elevation.tfw", "elevation.tif.ovr", "elevation.tif.msk",
                                   "elevation.tif.aux.xml", "elevation.aux"}) {
        CAPTURE(name);
        fs::create_symlink(place.outside / "other.tif", place.yard / name);
        const Ran ran = run_diurna("check '" + (place.yard / "scene.toml").string() + "'");
        CAPTURE(ran.out);
        CHECK((ran.code == 2) == (ran.out.find(beyond) != std::string::npos));
        fs::remove(place.yard / name);
    }
    // A virtual raster is another raster's programme: no reader here takes one.
    write_text(
        place.yard / "elevation.vrt",
        R"(<VRTDataset rasterXSize="4" rasterYSize="4"><VRTRasterBand dataType="Float32" band="1">
<SimpleSource><SourceFilename relativeToVRT="1">../outside/other.tif</SourceFilename></SimpleSource>
</VRTRasterBand></VRTDataset>)");
    for (const std::string& key : {std::string("elevation"), std::string("cover")}) {
        place.write(key == "cover"
                        ? More{.tables = "[terrain.land_cover]\nfile = \"elevation.vrt\"\n"
                                         "material = { 1 = \"concrete\" }\n"}
                        : More{.elevation = "elevation.vrt"});
        place.refused("cannot be read");
    }
    // Overviews by a name of the sidecar's choice are another raster that nobody asked for.
    write_text(place.yard / (tif + ".aux.xml"),
               "<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">" +
                   (place.outside / "other.tif").string() + "</MDI></Metadata></PAMDataset>");
    place.write({.elevation = tif});
    const Ran ran = run_diurna("check '" + (place.yard / "scene.toml").string() + "'");
    CAPTURE(ran.out);
    CHECK((ran.code == 0 || ran.out.find(beyond) != std::string::npos));
}

TEST_CASE("shapes lead to no file beyond the scene's folder and to no network",
          "[confinement][land_cover]") {
    const Place place;
    const More shapes{.tables = "[[shapes]]\nfile = \"s.geojson\"\nmaterial = \"concrete\"\n"};
    const auto geojson = [&](const std::string& crs) {
        write_text(
            place.yard / "s.geojson",
            R"({"type":"FeatureCollection",)" + crs +
                R"("features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[-84.2035,36.3199],[-84.2031,36.3199],[-84.2031,36.3202],[-84.2035,36.3199]]]}}]})");
    };
    place.write(shapes);
    geojson("");
    CHECK(run_diurna("check '" + (place.yard / "scene.toml").string() + "'").code == 0);
    const fs::path wkt = place.outside / "crs.prj";
    fs::copy_file(place.yard / "level.prj", wkt);
    for (const std::string& link : {std::string("http://127.0.0.1:9/c"), wkt.string()}) {
        CAPTURE(link);
        geojson(R"("crs":{"type":"link","properties":{"href":")" + link +
                R"(","type":"ogcwkt"}},)");
        place.refused("cannot be read");
    }
    // A Shapefile is of several files; here without any shape (ESRI Shapefile Technical
    // Description, 1998: 100 bytes of header, the length in words of 16 bits).
    std::string header(100, '\0');
    header[2] = '\x27';  // 9994, the most significant byte first
    header[3] = '\x0a';
    header[27] = 50;
    header[28] = '\xe8';  // 1000, the least significant first
    header[29] = '\x03';
    header[32] = 5;  // polygons
    write_text(place.yard / "s.shp", header);
    write_text(place.yard / "s.shx", header);
    place.write({.tables = "[[shapes]]\nfile = \"s.shp\"\nmaterial = \"concrete\"\n"});
    for (const std::string extension : {".dbf", ".cpg", ".qix", ".prj", ".shx"}) {
        CAPTURE(extension);
        const fs::path sidecar = place.yard / ("s" + extension);
        fs::remove(sidecar);
        fs::create_symlink(wkt, sidecar);
        place.refused(beyond);
        fs::remove(sidecar);
        fs::copy_file(wkt, place.yard / "s.prj", fs::copy_options::skip_existing);
        write_text(place.yard / "s.shx", header);
        place.refused("has no polygon or line (0 features)");  // read to its end
    }
}
