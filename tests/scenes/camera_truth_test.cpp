#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>

#include <png.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "render/picture/exr.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/labelled_yard.hpp"

using namespace diurna;
using namespace diurna::testing;
namespace fs = std::filesystem;

// What pictures, labels and manifest tell of camera, sun, air and scale.

TEST_CASE("worldToNDC leads from a place to the pixel that shows it", "[scenes][camera]") {
    const Json& image = yard().coco["images"][0];
    const fs::path file = yard().out / image["planes"].get<std::string>();
    Imf::InputFile exr(file.c_str());
    const Imf::Header& header = exr.header();
    REQUIRE(Imf::hasWorldToNDC(header));
    REQUIRE(Imf::hasWorldToCamera(header));
    const Frame frame = read_exr(file);
    // Along the roof's middle line of the truck in the open, north edge to south edge, and on the
    // wall's face towards the camera.
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(-4.2, 0.0, 1.5), Eigen::Vector3d(-5.5, 0.4, 1.5),
          Eigen::Vector3d(-3.0, -0.5, 1.5), Eigen::Vector3d(4.0, -4.1, 1.0)}) {
        const Imath::V3f world(float(place.x()), float(place.y()), float(place.z()));
        Imath::V3f ndc, camera;
        Imf::worldToNDC(header).multVecMatrix(world, ndc);
        Imf::worldToCamera(header).multVecMatrix(world, camera);
        const Eigen::Vector2d expected = projected(place);
        CHECK(ndc.x * columns == Approx(expected.x()).margin(2e-3));
        CHECK(ndc.y * rows == Approx(expected.y()).margin(2e-3));
        CHECK(camera.length() == Approx((place - eye).norm()).epsilon(1e-5));
        const auto p = std::size_t(int(ndc.y * rows) * columns + int(ndc.x * columns));
        const auto labels = yard().of_image(1);
        const std::string name = place.x() > 0.0 ? "wall" : "open";
        CHECK(frame["object"].pixel[p] == labels.at(name)["instance"]["object_id"].get<float>());
        // As far as the pixel is: on the roof a pixel is 0.45 m deep, on the wall 0.05 m.
        CHECK(frame["range"].pixel[p] == Approx(camera.length()).margin(0.3));
    }
    const std::optional<CameraTags> read = read_camera_tags(file);
    REQUIRE(read);
    REQUIRE(read->world_to_ndc);
    const Eigen::Vector4d ndc = *read->world_to_ndc * Eigen::Vector4d(-4.2, 0.0, 1.5, 1.0);
    const Eigen::Vector2d seen = projected({-4.2, 0.0, 1.5});
    CHECK(ndc.x() / ndc.w() * columns == Approx(seen.x()).margin(2e-3));
    CHECK(ndc.y() / ndc.w() * rows == Approx(seen.y()).margin(2e-3));
    CHECK(read->cap_date == "2026:03:20 00:00:00");
    CHECK(read->altitude == Approx(120.0).margin(0.01));
    CHECK(read->window_width == Approx(double{header.screenWindowWidth()}));
    // 12:00 UTC on the equator's plain, the scene's clock being UTC.
    CHECK(Imf::capDate(header) == "2026:03:20 00:00:00");
    CHECK(Imf::utcOffset(header) == 0.0f);
    CHECK(std::isinf(Imf::focus(header)));
    CHECK(Imf::latitude(header) == Approx(-60.0 / 110574.0).epsilon(0.01));  // m to a degree there
    CHECK(std::abs(Imf::longitude(header)) < 1e-4f);
    CHECK(Imf::altitude(header) == Approx(120.0).margin(0.01));
    CHECK(header.screenWindowWidth() ==
          Approx(2.0 * std::tan(0.5 * field_deg * std::numbers::pi / 180.0)).epsilon(1e-6));
}

TEST_CASE("labels and manifest contain camera, sun, air and the meaning of numbers",
          "[scenes][camera]") {
    const Json& image = yard().coco["images"][0];
    // The quaternion turns the camera's forward to where it looks, 18 degrees down to the north,
    // and its right to the east: v' = v + 2 q × (q × v + w v).
    const std::vector<double> q = image["camera"]["quaternion"];
    const Eigen::Vector3d vector(q[1], q[2], q[3]);
    const auto turned = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d {
        return v + 2.0 * vector.cross(vector.cross(v) + q[0] * v);
    };
    const double down = 18.0 * std::numbers::pi / 180.0;
    CHECK((turned({0, 0, 1}) - Eigen::Vector3d(0.0, std::cos(down), -std::sin(down))).norm() <
          1e-8);
    CHECK((turned({1, 0, 0}) - Eigen::Vector3d(1.0, 0.0, 0.0)).norm() < 1e-8);
    const double focal = 0.5 * columns / std::tan(0.5 * field_deg * std::numbers::pi / 180.0);
    CHECK(image["camera"]["intrinsics_pixels"][0].get<double>() == Approx(focal).epsilon(1e-8));
    CHECK(image["air"]["temperature_K"] == 290.0);
    CHECK(image["time"]["utc"] == "2026-03-20T00:00:00Z");
    const Json manifest = Json::parse(read_text(yard().out / "manifest.json"));
    CHECK(manifest["cameras"]["o"] == image["camera"]);
    CHECK_THAT(manifest["libraries"].get<std::string>(),
               Catch::Contains("Embree 3.") && Catch::Contains(", GDAL 3."));
    CHECK(manifest["frames"][0]["sun"] == image["sun"]);
    CHECK(image["sun"]["elevation_deg"] < -60.0);  // midnight at Greenwich
    std::map<int, std::string> kind, material;
    for (const Json& entry : manifest["legend"]["objects"]) kind[entry["id"]] = entry["class"];
    for (const Json& entry : manifest["legend"]["materials"]) {
        material[entry["id"]] = entry["name"];
    }
    const Frame frame = read_exr(yard().out / image["planes"].get<std::string>());
    for (std::size_t p = 0; p < frame.pixels(); ++p) {
        if (frame["object"].pixel[p] < 0.0f) continue;
        REQUIRE(kind.count(int(frame["object"].pixel[p])) == 1);
        REQUIRE(material.count(int(frame["material"].pixel[p])) == 1);
        if (kind[int(frame["object"].pixel[p])] == "camouflage net") {
            CHECK(material[int(frame["material"].pixel[p])].substr(0, 3) == "net");
        }
    }
    std::size_t trucks = 0;
    for (const Json& part : manifest["legend"]["parts"]) {
        trucks += kind[part["object"]] == "truck" && part["material"] == "sheet";
        CHECK_FALSE(part["material_ids"].empty());
    }
    CHECK(trucks == 4);
}

TEST_CASE("the grey picture's counts are the plane's values by its scale", "[scenes][camera]") {
    const Json& image = yard().coco["images"][0];
    const fs::path file = yard().out / image["file_name"].get<std::string>();
    std::FILE* from = std::fopen(file.c_str(), "rb");
    REQUIRE(from != nullptr);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, from);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    REQUIRE(png_get_image_width(png, info) == columns);
    REQUIRE(png_get_image_height(png, info) == rows);
    REQUIRE(png_get_bit_depth(png, info) == 16);
    REQUIRE(png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY);
    CHECK(image["scale"]["step"] == 0.01);
    CHECK(image["scale"]["zero"] == 0.0);
    const Frame frame = read_exr(yard().out / image["planes"].get<std::string>());
    const Plane& plane = frame[image["scale"]["plane"].get<std::string>()];
    png_bytepp row = png_get_rows(png, info);
    double worst = 0.0;
    for (int p = 0; p < rows * columns; ++p) {
        const png_byte* at = row[p / columns] + 2 * (p % columns);
        worst = std::max(
            worst, std::abs(0.01 * (256 * at[0] + at[1]) - double(plane.pixel[std::size_t(p)])));
    }
    CHECK(worst <= 0.005 + 1e-5);  // rounded
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(from);
}
