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
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <vector>

#include "materials/base/files.hpp"
#include "render/picture/exr.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/labels/contrast.hpp"
#include "scenes/labels/object_masks.hpp"
#include "scenes/labels/split.hpp"
#include "scenes/run/job.hpp"
#include "tests/support/sheet_scene.hpp"

using namespace diurna;
namespace fs = std::filesystem;

TEST_CASE("masks hold box, area and COCO's column-wise runs", "[scenes][annotations]") {
    // Sky above, ground below; object 2 as an L of three pixels, object 5 in a corner.
    Frame frame;
    frame.width = 4;
    frame.height = 3;
    frame.planes = {{.name = "object",
                     .unit = "1",
                     .pixel = {-1, -1, -1, -1,  //
                               0, 2, 0, 0,      //
                               0, 2, 2, 5}}};
    auto masks = object_masks(frame, "8-12");
    REQUIRE(masks.size() == 2);
    CHECK(masks[0].object == 2);
    CHECK(masks[0].left == 1);
    CHECK(masks[0].top == 1);
    CHECK(masks[0].width == 2);
    CHECK(masks[0].height == 2);
    CHECK(masks[0].pixels == 3);
    CHECK(masks[0].runs == std::vector<std::uint32_t>{4, 2, 2, 1, 3});
    CHECK(masks[1].object == 5);
    CHECK(masks[1].runs == std::vector<std::uint32_t>{11, 1});
    for (const ObjectMask& mask : masks) {
        CHECK(std::accumulate(mask.runs.begin(), mask.runs.end(), 0u) == 12);
    }
    // 5 is a net: 2 is seen through it, and in that pixel both are.
    frame.planes.push_back({.name = "object_behind.8-12",
                            .unit = "1",
                            .pixel = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 2}});
    masks = object_masks(frame, "8-12");
    CHECK(masks[0].pixels == 4);
    CHECK(masks[0].width == 3);
    CHECK(masks[1].pixels == 1);
    CHECK(object_masks(frame, "3-5")[0].pixels == 3);
}

TEST_CASE("contrast is the target's mean less that of the box about it", "[scenes][annotations]") {
    // A target of 301 and 303 K over 300 K at its left and 290 K at its right.
    Plane plane{"t", "K", {}};
    for (int row = 0; row < 6; ++row) {
        for (int column = 0; column < 6; ++column) {
            plane.pixel.push_back(column < 3 ? 300.0f : 290.0f);
        }
    }
    plane.pixel[2 * 6 + 2] = 301.0f;
    plane.pixel[3 * 6 + 2] = 303.0f;
    const ObjectMask mask{1, 2, 2, 1, 2, 2, {14, 2, 20}};
    // One column and two on each side, two rows and two on each side: columns 0 to 4, rows 0 to 5.
    const Contrast found = contrast(plane, 6, 6, mask);
    CHECK(found.background_pixels == 30 - 2);
    CHECK(found.target == Approx(302.0).epsilon(1e-9));
    CHECK(found.spread == Approx(1.0).epsilon(1e-6));
    CHECK(found.background == Approx((16 * 300.0 + 12 * 290.0) / 28.0).epsilon(1e-9));
    CHECK(found.rss() == Approx(std::hypot(302.0 - found.background, 1.0)).epsilon(1e-6));
}

TEST_CASE("a split takes its share of the instants and keeps to its seed",
          "[scenes][annotations]") {
    const std::vector<bool> split = validation_instants(1000, 0.2, 7);
    CHECK(std::count(split.begin(), split.end(), true) == 200);
    CHECK(split == validation_instants(1000, 0.2, 7));
    CHECK(split != validation_instants(1000, 0.2, 8));
    CHECK(validation_instants(1, 0.2, 1) == std::vector<bool>{false});
    // Drawn evenly: of the first half 100, give or take four deviations of a hypergeometric draw.
    const double first = double(std::count(split.begin(), split.begin() + 500, true));
    CHECK(std::abs(first - 100.0) < 4.0 * std::sqrt(200 * 0.25 * 800.0 / 999.0));
}

namespace {

constexpr int columns = 96, rows = 64;
constexpr double field_deg = 12.0;
// The level plain falls away from the site's plane by 0.28 mm there.
const Eigen::Vector3d eye(0.0, -60.0, 20.0 - 60.0 * 60.0 / (2.0 * 6371e3));

/// A truck in the open, one behind a wall's left half, one behind a net, one partly out of the
/// picture; over a plain, from 60 m south and 20 m above.
void write_yard(const fs::path& folder) {
    namespace plain = testing::over_plain;
    plain::Given given{.mesh = plain::block(-1.0, 1.0, -2.0, 2.0, 1.5), .height = 0.0};
    given.longwave = 300.0;
    given.ground_edge = 10.0;
    given.observer = R"(place_m = [0.0, -60.0]
height_above_ground_m = 20.0
azimuth_deg = 0.0
elevation_deg = -18.0
horizontal_fov_deg = 12.0
)";
    const auto object = [](const std::string& name, const std::string& mesh, double east,
                           double north, const std::string& more) {
        return fmt::format(
            "[[object]]\nname = \"{}\"\nmesh = \"{}.obj\"\nup = \"z\"\nplace_m = [{}, {}]\n"
            "largest_edge_m = 2.0\n{}\n",
            name, mesh, east, north, more);
    };
    const std::string truck = "class = \"truck\"\nmaterial = \"sheet\"\n";
    given.observer += object("open", "mesh", -4.2, 0.0, truck + "heading_deg = 90.0");
    given.observer += object("hidden", "mesh", 4.0, 0.0, truck);
    given.observer += object("edge", "mesh", 6.5, -3.0, truck);
    given.observer += object("wall", "wall", 4.0, -4.0, "material = \"sheet\"");
    given.observer += object("net", "net", 0.0, -4.0,
                             "class = \"camouflage net\"\nmaterial = \"net\"\n"
                             "height_above_ground_m = 0.2");
    given.sheet = R"([material.net]
albedo = 0.2
emissivity = 0.9
cover = 0.65
roughness_length_m = 0.01
layers = [{ thickness_m = 0.001, conductivity_W_mK = 1.0, density_kg_m3 = 1000.0, heat_capacity_J_kgK = 1000.0 }]
convection = { kind = "constant", value_W_m2K = 10.0 }
)";
    plain::write_scene(folder, given);
    write_text(folder / "wall.obj", plain::block(-1.0, 1.0, -0.1, 0.1, 2.0));
    write_text(folder / "net.obj", "v -1.8 0 0\nv 1.8 0 0\nv 1.8 0 4\nv -1.8 0 4\nf 1 2 3 4\n");
    std::string scene = read_text(folder / "scene.toml");
    scene = with(scene, "width = 32", fmt::format("width = {}", columns));
    scene = with(scene, "height = 32", fmt::format("height = {}", rows));
    scene = with(scene, "name = \"sheet\"\nmesh", "name = \"netted\"\nclass = \"truck\"\nmesh");
    write_text(folder / "scene.toml", scene + "[labels]\nvalidation_share = 0.5\n");
}

/// Column and row of a place by the pinhole's own equations, the axis 18 degrees down to the north.
Eigen::Vector2d projected(const Eigen::Vector3d& place) {
    const double down = 18.0 * std::numbers::pi / 180.0;
    const Eigen::Vector3d axis(0.0, std::cos(down), -std::sin(down));
    const Eigen::Vector3d below(0.0, -std::sin(down), -std::cos(down));
    const Eigen::Vector3d away = place - eye;
    const double focal = 0.5 * columns / std::tan(0.5 * field_deg * std::numbers::pi / 180.0);
    return {0.5 * columns + focal * away.x() / away.dot(axis),
            0.5 * rows + focal * away.dot(below) / away.dot(axis)};
}

/// Pixels whose centres lie in a block's picture, which is the convex hull of its corners: a centre
/// lies in it unless a line through it has all corners on one side. Columns from −96 to 192.
int silhouette(const Eigen::Vector2d& middle, const Eigen::Vector2d& half, double height) {
    std::vector<Eigen::Vector2d> corner;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {0.0, height}) {
                corner.push_back(
                    projected({middle.x() + x * half.x(), middle.y() + y * half.y(), z}));
            }
        }
    }
    int inside = 0;
    for (int column = -columns; column < 2 * columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            std::vector<double> bearing;
            for (const Eigen::Vector2d& c : corner) {
                bearing.push_back(std::atan2(c.y() - row - 0.5, c.x() - column - 0.5));
            }
            std::sort(bearing.begin(), bearing.end());
            double gap = bearing.front() + 2.0 * std::numbers::pi - bearing.back();
            for (std::size_t i = 1; i < bearing.size(); ++i) {
                gap = std::max(gap, bearing[i] - bearing[i - 1]);
            }
            inside += gap < std::numbers::pi;
        }
    }
    return inside;
}

using Json = nlohmann::json;

struct Yard {
    ScratchFolder folder{"yard"};
    fs::path out = folder.path / "out";
    Json coco;

    Yard() {
        write_yard(folder.path);
        JobOptions options;
        options.out = out;
        run_job(read_scene(folder.path / "scene.toml"), options);
        coco = Json::parse(read_text(out / "annotations.json"));
    }
    /// (name of the object) its label in an image.
    std::map<std::string, Json> of_image(int id) const {
        std::map<std::string, Json> found;
        for (const Json& label : coco["annotations"]) {
            if (label["image_id"] == id) found[label["instance"]["name"]] = label;
        }
        return found;
    }
};
const Yard& yard() {
    static const Yard once;
    return once;
}

}  // namespace

TEST_CASE("a reader of the planes finds every mask, box and area of the labels",
          "[scenes][annotations]") {
    const Json& coco = yard().coco;
    REQUIRE(coco["images"].size() >= 2);
    std::set<std::string> kinds;
    for (const Json& category : coco["categories"]) kinds.insert(category["name"]);
    CHECK(kinds == std::set<std::string>{"camouflage net", "pad", "truck", "wall"});
    std::size_t labels = 0;
    for (const Json& image : coco["images"]) {
        const Frame frame = read_exr(yard().out / image["planes"].get<std::string>());
        const std::vector<float>& front = frame["object"].pixel;
        const std::vector<float>& behind = frame["object_behind.8-12"].pixel;
        CHECK(fs::is_regular_file(yard().out / image["file_name"].get<std::string>()));
        std::set<float> seen;
        for (std::size_t p = 0; p < front.size(); ++p) seen.insert({front[p], behind[p]});
        for (const Json& label : coco["annotations"]) {
            if (label["image_id"] != image["id"]) continue;
            ++labels;
            const auto id = label["instance"]["object_id"].get<float>();
            CAPTURE(id, image["file_name"]);
            seen.erase(id);
            CHECK(label["iscrowd"] == 0);
            // As pycocotools decodes it: down the columns, first the pixels outside.
            REQUIRE(label["segmentation"]["size"] == Json({rows, columns}));
            std::size_t at = 0, wrong = 0, area = 0;
            int left = columns, top = rows, right = -1, bottom = -1;
            bool inside = false;
            for (const std::size_t run : label["segmentation"]["counts"]) {
                for (std::size_t i = 0; i < run; ++i, ++at) {
                    const int column = int(at / rows), row = int(at % rows);
                    const std::size_t p = std::size_t(row * columns + column);
                    wrong += inside != (front[p] == id || behind[p] == id);
                    if (!inside) continue;
                    ++area;
                    left = std::min(left, column);
                    right = std::max(right, column);
                    top = std::min(top, row);
                    bottom = std::max(bottom, row);
                }
                inside = !inside;
            }
            CHECK(at == std::size_t(rows * columns));
            CHECK(wrong == 0);
            CHECK(label["area"] == area);
            CHECK(label["bbox"] == Json({left, top, right - left + 1, bottom - top + 1}));
        }
        for (const float id : seen) CHECK(id <= 0.0f);  // nothing seen is left out
    }
    CHECK(labels == coco["annotations"].size());
}

TEST_CASE("the amodal box is that of a block's eight corners", "[scenes][annotations]") {
    const auto labels = yard().of_image(1);
    struct Block {
        std::string name;
        double east, north, half_x, half_y, height;
    };
    // The mesh looks along +y: a heading of 90 degrees lays it east and west.
    for (const Block& b :
         {Block{"open", -4.2, 0.0, 2.0, 1.0, 1.5}, Block{"hidden", 4.0, 0.0, 1.0, 2.0, 1.5},
          Block{"netted", 0.0, 0.0, 1.0, 2.0, 1.5}, Block{"edge", 6.5, -3.0, 1.0, 2.0, 1.5},
          Block{"wall", 4.0, -4.0, 1.0, 0.1, 2.0}}) {
        CAPTURE(b.name);
        REQUIRE(labels.count(b.name) == 1);
        Eigen::Vector2d least(1e9, 1e9), most(-1e9, -1e9);
        for (const double x : {-b.half_x, b.half_x}) {
            for (const double y : {-b.half_y, b.half_y}) {
                for (const double z : {0.0, b.height}) {
                    const Eigen::Vector2d at = projected({b.east + x, b.north + y, z});
                    least = least.cwiseMin(at);
                    most = most.cwiseMax(at);
                }
            }
        }
        const Json& label = labels.at(b.name);
        const std::vector<double> box = label["amodal_bbox"];
        CHECK(box[0] == Approx(least.x()).margin(0.01));
        CHECK(box[1] == Approx(least.y()).margin(0.01));
        CHECK(box[2] == Approx(most.x() - least.x()).margin(0.01));
        CHECK(box[3] == Approx(most.y() - least.y()).margin(0.01));
        const Eigen::Vector3d middle(b.east, b.north, 0.5 * b.height);
        CHECK(label["range_m"].get<double>() == Approx((eye - middle).norm()).epsilon(1e-4));
        // The camera stands south: at the right hand of what looks east, behind what looks north.
        const Eigen::Vector3d to_eye = eye - middle;
        const double bearing = std::atan2(to_eye.x(), to_eye.y()) * 180.0 / std::numbers::pi;
        const double aspect = std::remainder(bearing - (b.name == "open" ? 90.0 : 0.0), 360.0);
        const double off = label["aspect"]["azimuth_deg"].get<double>() - aspect;
        CHECK(std::remainder(off, 360.0) == Approx(0.0).margin(0.02));
        CHECK(label["aspect"]["elevation_deg"].get<double>() ==
              Approx(std::atan2(to_eye.z(), std::hypot(to_eye.x(), to_eye.y())) * 180.0 /
                     std::numbers::pi)
                  .margin(0.02));
    }
}

TEST_CASE("a net hides nothing, a wall does, an edge cuts off", "[scenes][annotations]") {
    const auto labels = yard().of_image(1);
    CHECK(labels.at("open")["occlusion"] == 0.0);
    CHECK(labels.at("open")["truncation"] == 0.0);
    // All of the truck behind the net shows through it, as much as of one without.
    CHECK(labels.at("netted")["occlusion"] == 0.0);
    CHECK(labels.at("netted")["area"].get<double>() ==
          Approx(silhouette({0.0, 0.0}, {1.0, 2.0}, 1.5)).margin(1.0));
    CHECK(labels.at("hidden")["occlusion"] > 0.3);
    CHECK(labels.at("hidden")["occlusion"] < 1.0);
    const double out = labels.at("edge")["truncation"];
    CHECK(out > 0.0);
    CHECK(out < 1.0);
    const std::vector<double> seen = labels.at("edge")["bbox"];
    const std::vector<double> whole = labels.at("edge")["amodal_bbox"];
    CHECK(seen[0] + seen[2] == columns);
    CHECK(whole[0] + whole[2] > columns);
    // Cut off by the edge alone: what is in the picture is all seen.
    CHECK(labels.at("edge")["occlusion"] == 0.0);
    CHECK(labels.at("edge")["area"].get<double>() / (1.0 - out) ==
          Approx(silhouette({6.5, -3.0}, {1.0, 2.0}, 1.5)).margin(1.0));
}

TEST_CASE("YOLO's and KITTI's text have the boxes of COCO's labels", "[scenes][annotations]") {
    const Json& image = yard().coco["images"][0];
    const std::string stem = fs::path(image["file_name"].get<std::string>()).stem();
    std::istringstream yolo(read_text(yard().out / "labels" / (stem + ".txt")));
    std::istringstream kitti(read_text(yard().out / "kitti" / (stem + ".txt")));
    std::istringstream classes(read_text(yard().out / "classes.txt"));
    std::vector<std::string> names;
    for (std::string line; std::getline(classes, line);) names.push_back(line);
    for (const Json& label : yard().coco["annotations"]) {
        if (label["image_id"] != image["id"]) continue;
        const std::vector<double> box = label["bbox"];
        std::size_t kind = 0;
        double x = 0.0, y = 0.0, w = 0.0, h = 0.0;
        REQUIRE(yolo >> kind >> x >> y >> w >> h);
        CHECK(kind + 1 == label["category_id"]);
        CHECK((x - 0.5 * w) * columns == Approx(box[0]).margin(1e-3));
        CHECK((y - 0.5 * h) * rows == Approx(box[1]).margin(1e-3));
        CHECK(w * columns == Approx(box[2]).margin(1e-3));
        CHECK(h * rows == Approx(box[3]).margin(1e-3));
        std::string type, line;
        REQUIRE(std::getline(kitti, line));
        std::istringstream words(line);
        words >> type;
        std::vector<double> number;
        for (double value = 0.0; words >> value;) number.push_back(value);
        REQUIRE(number.size() == 14);
        CHECK(type.substr(0, 3) == names[kind].substr(0, 3));
        CHECK(number[3] == box[0]);
        CHECK(number[6] == box[1] + box[3] - 1.0);
        if (label["instance"]["name"] != "open") continue;
        // 1.5 m high, 2 m wide, 4 m long; its front looks along the camera's x.
        CHECK(number[7] == Approx(1.5).margin(2e-3));
        CHECK(number[8] == Approx(2.0).margin(2e-3));
        CHECK(number[9] == Approx(4.0).margin(2e-3));
        CHECK(number[10] == Approx(-4.2).margin(2e-3));
        CHECK(std::hypot(number[11], number[12]) == Approx(std::hypot(60.0, 20.0)).margin(5e-3));
        CHECK(number[13] == Approx(0.0).margin(1e-3));
    }
    const Json train = Json::parse(read_text(yard().out / "annotations_train.json"));
    const Json rest = Json::parse(read_text(yard().out / "annotations_validation.json"));
    CHECK(train["images"].size() + rest["images"].size() == yard().coco["images"].size());
    CHECK(train["categories"] == rest["categories"]);
}

TEST_CASE("worldToNDC leads from a place to the pixel that shows it", "[scenes][annotations]") {
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

TEST_CASE("labels and manifest carry camera, sun, air and what numbers stand for",
          "[scenes][annotations]") {
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

TEST_CASE("the grey picture's counts are the plane's values by its scale",
          "[scenes][annotations]") {
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
