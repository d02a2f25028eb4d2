#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/app/sweep/run_sweep.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/passed_over.hpp"
#include "tests/support/small_scene.hpp"

// A sweep is as many runs by hand, and one data set.

using namespace diurna;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const PrivateTempFolder temp;

std::string swept(const std::string& axes) {
    return with(small_scene(), "frame_every_s = 21600.0", "frame_every_s = 43200.0") + "[sweep]\n" +
           axes;
}

const std::string two_axes = R"([[sweep.axis]]
key = "building.hangar.roof"
values = ["painted_steel", "concrete"]
[[sweep.axis]]
name = "flight"
keys = ["observer.east.height_above_ground_m", "observer.east.look_at_m"]
values = [[450.0, [0.0, 0.0]], [300.0, [53.0, -88.4]]]
)";

Sweep read(const ScratchFolder& folder, const std::string& text) {
    write_text(folder.path / "scene.toml", text);
    return read_sweep_variants(folder.path / "scene.toml", {});
}

/// The same files with the same bytes.
void check_same(const fs::path& a, const fs::path& b) {
    const auto first = contents(a), second = contents(b);
    CHECK(first.size() == second.size());
    for (const auto& [name, text] : first) {
        CAPTURE(name);
        REQUIRE(second.contains(name));
        CHECK((second.at(name) == text));
    }
}

std::string printed(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string text;
    std::array<char, 4096> block{};
    while (const std::size_t count = fread(block.data(), 1, block.size(), pipe)) {
        text.append(block.data(), count);
    }
    pclose(pipe);
    return text;
}

std::string lines_of(const ScratchFolder& folder, const std::string& axes) {
    try {
        read(folder, swept(axes));
    } catch (const InputError& error) {
        std::string lines;
        for (const Mistake& mistake : error.mistakes()) lines += mistake.line() + "\n";
        return lines;
    }
    return "no mistake";
}

/// The scene of two axes run as a whole, once.
struct Whole {
    ScratchFolder folder{"sweep"};
    Sweep sweep = read(folder, swept(two_axes));
    fs::path out = folder.path / "whole";
    SweepReport report;
    Whole() {
        SweepOptions options;
        options.out = out;
        report = run_sweep(sweep, options);
    }
};
const Whole& whole() {
    static const Whole once;
    return once;
}

void check_by_hand() {
    const ScratchFolder folder("hand");
    std::string text = with(small_scene(), "frame_every_s = 21600.0", "frame_every_s = 43200.0");
    text = with(text, "roof = \"painted_steel\"", "roof = \"concrete\"");
    text = with(text, "height_above_ground_m = 450.0", "height_above_ground_m = 300.0");
    text = with(text, "look_at_m = [0.0, 0.0]", "look_at_m = [53.0, -88.4]");
    write_text(folder.path / "scene.toml", text);
    JobOptions options;
    options.out = folder.path / "out";
    run_job(read_scene(folder.path / "scene.toml"), options);
    const auto by_hand = contents(folder.path / "out");
    const auto of_sweep = contents(whole().out / "variants/v3");
    CHECK(
        (contents(whole().out / "heat/h1").at("temperatures.nc") == by_hand.at("temperatures.nc")));
    std::size_t pictures = 0;
    for (const auto& [name, bytes] : by_hand) {
        if (!name.starts_with("frames/") && !name.starts_with("images/")) continue;
        CAPTURE(name);
        REQUIRE(of_sweep.contains(name));
        CHECK((of_sweep.at(name) == bytes));
        ++pictures;
    }
    CHECK(pictures == 2 * 2 * 3);
    CHECK((of_sweep.at("annotations.json") == by_hand.at("annotations.json")));
    // And the other materials and places are others.
    CHECK(
        (contents(whole().out / "heat/h0").at("temperatures.nc") != by_hand.at("temperatures.nc")));
}

void check_shards() {
    const ScratchFolder folder("shards");
    SweepOptions options;
    options.out = folder.path / "out";
    options.shard.count = 3;  // four variants of two heats: the second heat is in two of them
    std::size_t rendered = 0;
    for (const std::size_t shard : {3u, 1u, 2u}) {
        options.shard.number = shard;
        const SweepReport report = run_sweep(whole().sweep, options);
        rendered += report.rendered;
        CHECK(report.missing == 4 - rendered);
        CHECK(fs::exists(options.out / "manifest.json") == (rendered == 4));
    }
    check_same(whole().out, options.out);

    // Killed at several moments, then taken up.
    const std::string command = "'" DIURNA_BINARY "' run '" +
                                (whole().folder.path / "scene.toml").string() + "' --out '" +
                                (folder.path / "killed").string() + "' --resume --progress none";
    for (const char* seconds : {"0.5", "1.5", "2.5"}) {
        printed(std::string("timeout -s KILL ") + seconds + " " + command + " 2>&1");
    }
    CHECK(printed(command + " 2>/dev/null").find("4 variants, 2 solves") != std::string::npos);
    check_same(whole().out, folder.path / "killed");
    // Killed after all else: its ledger is still there.
    write_text(folder.path / "killed/variants/v1/ledger.jsonl", "{}\n");
    CHECK(printed(command + " 2>/dev/null")
              .find("0 variants rendered, 4 reused, 0 heat balances computed") !=
          std::string::npos);
    check_same(whole().out, folder.path / "killed");
}

void check_manifest() {
    const fs::path& out = whole().out;
    const Json manifest = Json::parse(read_text(out / "manifest.json"));
    CHECK(whole().report.rendered == 4);
    CHECK(whole().report.solved == 2);
    REQUIRE(manifest["variants"].size() == 4);
    const Json& last = manifest["variants"][3];
    CHECK(last["name"] == "v3");
    CHECK(last["heat"] == "h1");
    CHECK(last["values"]["building.hangar.roof"] == "concrete");
    CHECK(last["values"]["observer.east.height_above_ground_m"] == 300.0);
    CHECK(last["values"]["observer.east.look_at_m"] == Json({53.0, -88.4}));
    for (const Json& variant : manifest["variants"]) {
        const fs::path folder = out / variant["folder"].get<std::string>();
        const std::string some = "annotations.json";
        const std::string sum = printed("sha256sum '" + (folder / some).string() + "'");
        CHECK(sum.substr(0, 64) == variant["outputs"][some].get<std::string>());
        for (const auto& [name, digest] : variant["outputs"].items()) {
            CHECK(fs::is_regular_file(folder / name));
        }
    }

    const Json coco = Json::parse(read_text(out / "annotations.json"));
    CHECK(coco["images"].size() == 4 * 2 * 2);  // variants, instants, bands
    std::set<int> images, labels;
    std::map<std::string, std::set<std::string>> sides;
    std::size_t expected = 0;
    for (const Json& image : coco["images"]) {
        images.insert(image["id"].get<int>());
        CHECK(fs::is_regular_file(out / image["file_name"].get<std::string>()));
        CHECK(fs::is_regular_file(out / image["planes"].get<std::string>()));
        sides[image["date_captured"]].insert(image["split"].get<std::string>());
    }
    CHECK(images.size() == coco["images"].size());
    for (const Json& variant : manifest["variants"]) {
        const fs::path folder = out / variant["folder"].get<std::string>();
        expected += Json::parse(read_text(folder / "annotations.json"))["annotations"].size();
    }
    for (const Json& label : coco["annotations"]) {
        labels.insert(label["id"].get<int>());
        CHECK(images.contains(label["image_id"].get<int>()));
    }
    CHECK(labels.size() == expected);
    CHECK(expected >= 8);
    for (const auto& [instant, split] : sides) CHECK(split.size() == 1);
    std::size_t parts = 0;
    for (const char* name : {"annotations_train.json", "annotations_validation.json"}) {
        parts += Json::parse(read_text(out / name))["annotations"].size();
    }
    CHECK(parts == expected);

    // And a reader of its own finds them to be what planes and pictures show.
    if (std::system("python3 --version > /dev/null 2>&1") != 0) {
        pass_over("no python3");
        return;
    }
    const std::string read = printed(
        "python3 '" DIURNA_SOURCE_DIR "/tests/support/coco_reader.py' '" + out.string() + "' 2>&1");
    CAPTURE(read);
    for (const char* line : {"images 16\n", "wrong_ids 0\n", "wrong_grey 0\n", "wrong_mask 0\n",
                             "wrong_box 0\n", "wrong_yolo 0\n", "precision_of_truth 1.0"}) {
        CAPTURE(line);
        CHECK(read.find(line) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("a grid has every combination once, those of one heat together", "[scenes][sweep]") {
    const ScratchFolder folder("grid");
    const Sweep sweep = read(folder, swept(R"([[sweep.axis]]
key = "observer.east.height_above_ground_m"
values = [400.0, 450.0, 500.0]
[[sweep.axis]]
key = "scene.seed"
values = [1, 2, 3, 4]
)"));
    std::set<std::vector<std::size_t>> seen;
    std::map<std::string, std::set<std::size_t>> seeds_of_heat;
    std::vector<std::string> order;
    for (const Variant& variant : sweep.variants) {
        seen.insert(variant.choice);
        seeds_of_heat[variant.heat].insert(variant.choice[1]);
        if (order.empty() || order.back() != variant.heat) order.push_back(variant.heat);
        const Scene scene = scene_of(sweep, variant);
        CHECK(scene.observers[0].stands.metres == 400.0 + 50.0 * double(variant.choice[0]));
        CHECK(scene.seed == 1 + variant.choice[1]);
    }
    CHECK(sweep.variants.size() == 12);
    CHECK(seen.size() == 12);
    CHECK(sweep.solves() == 4);
    CHECK(order.size() == 4);
    for (const auto& [heat, seeds] : seeds_of_heat) CHECK(seeds.size() == 1);
    // Ground that is finer where observers look is another for each.
    const std::string axis =
        "[[sweep.axis]]\nkey = \"observer.east.height_above_ground_m\"\nvalues = [400.0, 450.0]\n";
    CHECK(read(folder, swept(axis)).solves() == 1);
    CHECK(read(folder,
               with(swept(axis), "tolerance_m = 10.0", "tolerance_m = 10.0\ncoarsest_m = 30.0"))
              .solves() == 2);
}

TEST_CASE("variants are drawn evenly, each once, and more of them keep the first",
          "[scenes][sweep][by_replication]") {
    const ScratchFolder folder("draw");
    const auto drawn = [&](int draw) {
        const std::string text = swept("draw = " + std::to_string(draw) +
                                       "\n[[sweep.axis]]\nkey = \"scene.seed\"\nvalues = "
                                       "[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19]\n"
                                       "[[sweep.axis]]\nkey = \"observer.east.samples\"\nvalues = "
                                       "[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20]\n");
        std::set<std::string> names;
        for (const Variant& variant : read(folder, text).variants) names.insert(variant.name);
        return names;
    };
    const std::set<std::string> few = drawn(40), more = drawn(100);
    CHECK(few.size() == 40);
    CHECK(more.size() == 100);
    CHECK(std::includes(more.begin(), more.end(), few.begin(), few.end()));
    double sum = 0.0;
    for (const std::string& name : more) sum += std::stod(name.substr(1));
    // Mean of 100 of 0 to 399 without putting back: sd 115.5 / 10 · sqrt(300/399) = 10; four of it.
    CHECK(std::abs(sum / 100.0 - 199.5) < 40.0);
}

TEST_CASE("shards share out all variants", "[scenes][sweep]") {
    for (const std::size_t variants : {1u, 7u, 100u}) {
        for (const std::size_t shards : {1u, 3u, 11u}) {
            std::size_t next = 0;
            for (std::size_t shard = 1; shard <= shards; ++shard) {
                const ShardRange part = range_of({shard, shards}, variants);
                CHECK(part.first == next);
                next = part.last;
                CHECK(part.last - part.first <= variants / shards + 1);
            }
            CHECK(next == variants);
        }
    }
}

TEST_CASE("cameras of an aspect sphere are where requested, and look at the middle",
          "[scenes][sweep][around]") {
    const ScratchFolder folder("sphere");
    std::string text = with(small_scene(), "frame_every_s = 21600.0", "frame_every_s = 86400.0");
    text = with(text,
                "place_m = [2000.0, 1100.0]\nheight_above_ground_m = 450.0\nlook_at_m = "
                "[0.0, 0.0]\n",
                "around = { object = \"hangar\" }\n");
    text += R"([sweep]
[[sweep.axis]]
key = "observer.east.around.range_m"
values = [500.0, 1500.0]
[[sweep.axis]]
keys = ["observer.east.around.aspect_deg", "observer.east.around.elevation_deg"]
values = [[90.0, 30.0], [-135.0, 60.0]]
)";
    text = with(text, "object = \"hangar\"", "object = \"hangar\", range_m = 1000.0");
    SweepOptions options;
    options.out = folder.path / "out";
    const SweepReport report = run_sweep(read(folder, text), options);
    CHECK(report.solved == 1);
    const Json coco = Json::parse(read_text(options.out / "annotations.json"));
    const Json manifest = Json::parse(read_text(options.out / "manifest.json"));
    std::map<std::string, Json> values;
    for (const Json& variant : manifest["variants"]) values[variant["name"]] = variant["values"];
    std::map<std::pair<double, double>, Eigen::Vector3d> eye;  // (range, aspect)
    std::map<int, Json> image_of;
    for (const Json& image : coco["images"]) {
        const auto at = image["camera"]["position_m"].get<std::vector<double>>();
        const Json& asked = values.at(image["variant"]);
        eye[{asked["observer.east.around.range_m"], asked["observer.east.around.aspect_deg"]}] = {
            at[0], at[1], at[2]};
        image_of[image["id"]] = image;
    }
    REQUIRE(eye.size() == 4);
    // 1000 m further along the ray from the middle; the hangar faces 45 degrees from north.
    for (const auto& [aspect, elevation] : {std::pair{90.0, 30.0}, {-135.0, 60.0}}) {
        const double azimuth = (45.0 + aspect) * std::numbers::pi / 180.0,
                     up = elevation * std::numbers::pi / 180.0;
        const Eigen::Vector3d ray(std::cos(up) * std::sin(azimuth),
                                  std::cos(up) * std::cos(azimuth), std::sin(up));
        CHECK((eye[{1500.0, aspect}] - eye[{500.0, aspect}] - 1000.0 * ray).norm() < 1e-3);
        // The middle lies over the middle of the plan.
        const Eigen::Vector3d middle = eye[{500.0, aspect}] - 500.0 * ray;
        CHECK((middle.head<2>() - Eigen::Vector2d(53.0, -88.4)).norm() < 1.0);
    }
    std::size_t hangars = 0;
    for (const Json& label : coco["annotations"]) {
        if (label["instance"]["name"] != "hangar") continue;
        ++hangars;
        const Json& asked = values.at(image_of.at(label["image_id"])["variant"]);
        CHECK(label["range_m"].get<double>() ==
              Approx(asked["observer.east.around.range_m"].get<double>()).epsilon(1e-4));
        CHECK(label["aspect"]["azimuth_deg"].get<double>() ==
              Approx(asked["observer.east.around.aspect_deg"].get<double>()).margin(0.01));
        CHECK(label["aspect"]["elevation_deg"].get<double>() ==
              Approx(asked["observer.east.around.elevation_deg"].get<double>()).margin(0.01));
        // In the middle of 64 x 48 pixels, perspective aside.
        const Json& box = label["amodal_bbox"];
        CHECK(box[0].get<double>() + 0.5 * box[2].get<double>() == Approx(32.0).margin(2.0));
        CHECK(box[1].get<double>() + 0.5 * box[3].get<double>() == Approx(24.0).margin(2.0));
    }
    CHECK(hangars == 4 * 2);
}

TEST_CASE("mistakes of a sweep are reported with their place", "[scenes][sweep]") {
    const ScratchFolder folder("wrong");
    const std::string file = (folder.path / "scene.toml").string();
    const auto axis = [](const std::string& key, const std::string& values) {
        return "[[sweep.axis]]\nkey = \"" + key + "\"\nvalues = " + values + "\n";
    };
    const auto place = [&](const std::string& line) {
        // The axis is the last thing in the file: line of `values`, column of the value.
        std::istringstream text(read_text(folder.path / "scene.toml"));
        int count = 0;
        for (std::string each; std::getline(text, each);) ++count;
        return file + ":" + std::to_string(count) + line;
    };
    std::string reported = lines_of(folder, axis("building.hangar.roof", "[\"painted_stel\"]"));
    CHECK(reported.starts_with(place(":11: building.roof: unknown material \"painted_stel\"")));
    reported = lines_of(folder, axis("observer.east.hieght_above_ground_m", "[1.0, 2.0]"));
    CHECK(reported.starts_with(place(":11: observer.hieght_above_ground_m: unknown key")));
    CHECK(std::count(reported.begin(), reported.end(), '\n') == 1);
    reported = lines_of(folder, axis("observer.west.samples", "[1, 2]"));
    CHECK(reported.find("unknown observer \"west\"") != std::string::npos);
    reported = lines_of(folder, axis("observer.east.samples", "[4, -1]"));
    CHECK(reported.starts_with(place(":14: observer.samples: found -1")));
    CHECK(lines_of(folder, axis("sweep.draw", "[1]")).find("cannot change a sweep") !=
          std::string::npos);
    CHECK(lines_of(folder, "draw = 3\n" + axis("scene.seed", "[1, 2]")).find("there are only 2") !=
          std::string::npos);
    CHECK(lines_of(folder, axis("scene.seed", "[]")).find("at least one value") !=
          std::string::npos);
    CHECK(lines_of(folder, axis("scene.seed", "[1, 2]") + axis("scene.seed", "[1]"))
              .find("two axes change scene.seed") != std::string::npos);
    CHECK(lines_of(folder,
                   "[[sweep.axis]]\nkeys = [\"scene.seed\", \"time.step_s\"]\nvalues = "
                   "[[1, 600.0], [2]]\n")
              .find("an array of 2 values") != std::string::npos);
}

// What only the world knows: whether an eye is somewhere.
TEST_CASE("eyes of every value are placed before anything is run", "[scenes][sweep]") {
    const ScratchFolder folder("eyes");
    const Sweep sweep = read(folder, swept("[[sweep.axis]]\nkey = \"observer.east.place_m\"\n"
                                           "values = [[0.0, 0.0], [9e5, 0.0]]\n"));
    std::size_t tried = 0;
    try {
        for_each_value(sweep, [&](Scene scene) {
            ++tried;
            prepare(std::move(scene));
        });
        FAIL("an eye 900 km away was taken");
    } catch (const InputError& error) {
        REQUIRE(error.mistakes().size() == 1);
        const std::string where = error.mistakes().front().where;
        CAPTURE(where);
        CHECK(where.find(":23: observer.place_m") != std::string::npos);  // of the second
    }
    CHECK(tried == 2);
}

// Sections of one case, so that the sweep is run once.
TEST_CASE("a sweep is its variants, however it is run", "[scenes][sweep]") {
    SECTION("a variant is what a run of that scene by hand is") { check_by_hand(); }
    SECTION("shards make the bytes of the whole, in any order and after any end") {
        check_shards();
    }
    SECTION("a sweep's manifest and labels tell of all variants") { check_manifest(); }
}
