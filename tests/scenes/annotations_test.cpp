#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
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
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/products/labels/kitti.hpp"
#include "scenes/products/labels/label_contrast.hpp"
#include "scenes/products/labels/labelled.hpp"
#include "scenes/products/labels/object_masks.hpp"
#include "scenes/products/labels/split.hpp"
#include "scenes/products/labels/whole_objects.hpp"
#include "tests/support/labelled_yard.hpp"
#include "tests/support/passed_over.hpp"
#include "tests/support/slope_scene.hpp"

using namespace diurna;
using namespace diurna::testing;
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

TEST_CASE("the background of an odd mask reaches half its sides further, rounded up",
          "[scenes][annotations]") {
    const Plane plane{"t", "K", std::vector<float>(20 * 20, 300.0f)};
    // Five columns and three rows: three columns and two rows more on each side.
    const ObjectMask mask{1, 7, 8, 5, 3, 1, {7 * 20 + 8, 1, 20 * 20 - 7 * 20 - 9}};
    CHECK(contrast(plane, 20, 20, mask).background_pixels == 11 * 7 - 1);
}

TEST_CASE("boxes of ground lie along its rectangle, aspects on a slope are above the horizontal",
          "[scenes][annotations]") {
    const ScratchFolder folder("labels_on_slope");
    write_text(folder.path / "crate.obj", slope_scene::box(3.0, 6.0, 2.0));
    const Prepared scene = prepare(read_scene(slope_scene::written(
        folder.path, slope_scene::plane(15.0, 120.0),
        "[[ground]]\nname = \"pad\"\nmaterial = \"grass\"\nrectangle_m = [-14.0, 9.0, 18.0, "
        "12.0, 30.0]\n" +
            slope_scene::object("crate", "place_m = [4.0, -3.0]\nheading_deg = 70.0"))));
    const std::vector<Labelled> objects = labelled_objects(scene.scene, scene.world);
    const Observer eye = scene.sequences[0].at(0);
    const auto whole =
        whole_objects(scene.world.facets, scene.world.facets, scene.world.copies, objects, eye);
    const WholeObject &pad = whole.at(1), &crate = whole.at(2);
    CHECK(pad.heading_deg == 30.0);
    CHECK(pad.length == Approx(18.0).margin(0.01));
    CHECK(pad.width == Approx(12.0).margin(0.01));
    const Eigen::Vector3d away = eye.position - crate.middle;
    CHECK(crate.range == Approx(away.norm()));
    CHECK(crate.aspect_elevation_deg ==
          Approx(std::asin(away.z() / away.norm()) * 180.0 / std::numbers::pi));
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

TEST_CASE("a reader of the planes finds every mask, box and area of the labels",
          "[scenes][annotations][by_trace]") {
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
        for (const float id : seen) CHECK(id <= 0.0f);  // nothing seen is skipped
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

namespace {

/// Left, top, right, bottom of a KITTI box's eight corners by P2, as its development kit draws
/// them.
Eigen::Vector4d drawn(const std::vector<double>& p2, const std::vector<double>& number) {
    Eigen::Matrix<double, 3, 4> p;
    for (int i = 0; i < 12; ++i) p(i / 4, i % 4) = p2[std::size_t(i)];
    const double h = number[7], w = number[8], l = number[9], turn = number[13];
    Eigen::Vector4d box(1e9, 1e9, -1e9, -1e9);
    for (const double a : {-0.5 * l, 0.5 * l}) {
        for (const double b : {-0.5 * w, 0.5 * w}) {
            for (const double up : {0.0, h}) {
                const Eigen::Vector4d at(number[10] + std::cos(turn) * a + std::sin(turn) * b,
                                         number[11] - up,
                                         number[12] - std::sin(turn) * a + std::cos(turn) * b, 1.0);
                const Eigen::Vector3d seen = p * at;
                const Eigen::Vector2d pixel = seen.head<2>() / seen.z();
                box.head<2>() = box.head<2>().cwiseMin(pixel);
                box.tail<2>() = box.tail<2>().cwiseMax(pixel);
            }
        }
    }
    return box;
}

}  // namespace

TEST_CASE("KITTI's calibration draws its boxes where COCO's are, the camera rolled and inclined",
          "[scenes][annotations]") {
    const Json& image = yard().coco["images"][0];
    const std::string stem = fs::path(image["file_name"].get<std::string>()).stem();
    std::istringstream lines(read_text(yard().out / "kitti" / "calib" / (stem + ".txt")));
    std::vector<double> p2;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        if (name != "P2:") continue;
        for (double value = 0.0; words >> value;) p2.push_back(value);
    }
    REQUIRE(p2.size() == 12);
    std::istringstream kitti(read_text(yard().out / "kitti" / (stem + ".txt")));
    int compared = 0;
    for (const Json& label : yard().coco["annotations"]) {
        if (label["image_id"] != image["id"]) continue;
        std::string type, line;
        REQUIRE(std::getline(kitti, line));
        if (label["instance"]["name"] == "net") continue;  // no block
        std::istringstream words(line);
        words >> type;
        std::vector<double> number;
        for (double value = 0.0; words >> value;) number.push_back(value);
        REQUIRE(number.size() == 14);
        CAPTURE(label["instance"]["name"]);
        const Eigen::Vector4d box = drawn(p2, number);
        const std::vector<double> whole = label["amodal_bbox"];
        // KITTI counts from the middle of the first pixel, COCO from its corner. Sizes stand there
        // to a centimetre, some 0.07 pixels.
        CHECK(box[0] + 0.5 == Approx(whole[0]).margin(0.1));
        CHECK(box[1] + 0.5 == Approx(whole[1]).margin(0.1));
        CHECK(box[2] + 0.5 == Approx(whole[0] + whole[2]).margin(0.1));
        CHECK(box[3] + 0.5 == Approx(whole[1] + whole[3]).margin(0.1));
        ++compared;
    }
    CHECK(compared >= 4);

    // A camera rolled and looking steeply down: a place by hand, turned about the axis.
    Observer camera{.azimuth_deg = 90.0,
                    .elevation_deg = -90.0,
                    .roll_deg = 30.0,
                    .horizontal_fov_deg = 90.0,
                    .width = 101,
                    .height = 51};
    std::istringstream steep(kitti_calibration(camera));
    std::string name;
    Eigen::Matrix<double, 3, 4> p;
    steep >> name;
    for (int i = 0; i < 12; ++i) steep >> p(i / 4, i % 4);
    // 10 m below and 2 m ahead (east): up in the picture, which is turned clockwise.
    const Eigen::Vector3d seen = p * Eigen::Vector4d(0.0, 10.0, 2.0, 1.0);
    const double turn = 30.0 * std::numbers::pi / 180.0, pixels = 50.5 * 2.0 / 10.0;
    CHECK(seen.z() == Approx(10.0));
    CHECK(seen.x() / seen.z() == Approx(50.0 - pixels * std::sin(turn)).margin(1e-6));
    CHECK(seen.y() / seen.z() == Approx(25.0 - pixels * std::cos(turn)).margin(1e-6));
    camera.projection = Projection::panorama;
    CHECK(kitti_calibration(camera).empty());
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
        CHECK(number[11] == Approx(20.0).margin(2e-3));  // the frame is level, the camera not
        CHECK(number[12] == Approx(60.0).margin(2e-3));
        CHECK(number[13] == Approx(0.0).margin(1e-3));
    }
    const Json train = Json::parse(read_text(yard().out / "annotations_train.json"));
    const Json rest = Json::parse(read_text(yard().out / "annotations_validation.json"));
    CHECK(train["images"].size() + rest["images"].size() == yard().coco["images"].size());
    CHECK(train["categories"] == rest["categories"]);
}

// The same by a reader of its own, in another language and without any library: as pycocotools
// indexes and evaluates. A truth found whole has an average precision of 1; boxes that overlap
// theirs by 0.62 count at three of ten thresholds (0.50, 0.55, 0.60).
TEST_CASE("a loader in Python finds labels, planes and pictures to be one",
          "[scenes][annotations]") {
    if (std::system("python3 --version > /dev/null 2>&1") != 0) {
        pass_over("no python3");
        return;
    }
    const std::string command = "python3 '" DIURNA_SOURCE_DIR "/tests/support/coco_reader.py' '" +
                                yard().out.string() + "' 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string text;
    char block[4096];
    while (const std::size_t count = fread(block, 1, sizeof block, pipe)) text.append(block, count);
    pclose(pipe);
    CAPTURE(text);
    std::map<std::string, double> reported;
    std::istringstream lines(text);
    std::string name;
    for (double value = 0.0; lines >> name >> value;) reported[name] = value;
    CHECK(reported["images"] == double(yard().coco["images"].size()));
    CHECK(reported["annotations"] == double(yard().coco["annotations"].size()));
    for (const char* what : {"ids", "size", "grey", "mask", "area", "box", "contrast", "yolo"}) {
        CAPTURE(what);
        REQUIRE(reported.contains(std::string("wrong_") + what));
        CHECK(reported[std::string("wrong_") + what] == 0.0);
    }
    CHECK(reported["precision_of_truth"] == 1.0);
    CHECK(reported["precision_of_overlap_0.62"] == Approx(0.3).margin(1e-6));
    CHECK(reported.contains("precision_of_nothing"));
    CHECK(reported["precision_of_nothing"] == 0.0);
}
