#include "scenes/app/sweep/merged_labels.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "materials/base/files.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

using Json = nlohmann::json;

/// A sweep of `heats` days from four sides each, with a picture of each of two instants a variant,
/// as runs leave it in a folder.
Sweep swept(const ScratchFolder& folder, std::size_t heats) {
    Sweep sweep;
    sweep.base.labels.validation_share = 0.5;
    for (std::size_t v = 0; v < 4 * heats; ++v) {
        Variant variant;
        variant.name = "v" + std::to_string(v);
        variant.heat = "h" + std::to_string(v / 4);
        sweep.variants.push_back(variant);
        const auto of = folder.path / "variants" / variant.name;
        std::filesystem::create_directories(of);
        Json coco = {{"images", Json::array()},
                     {"annotations", Json::array()},
                     {"categories", {{{"id", 1}, {"name", "box"}}}}};
        for (const int hour : {6, 12}) {
            coco["images"].push_back({{"id", hour},
                                      {"file_name", "images/" + std::to_string(hour) + ".png"},
                                      {"planes", "frames/" + std::to_string(hour) + ".exr"},
                                      {"date_captured", std::to_string(hour)}});
        }
        write_text(of / "annotations.json", coco.dump());
        write_text(of / "data.yaml", "");
        write_text(of / "classes.txt", "box\n");
    }
    return sweep;
}

std::set<std::string> heats_of(const ScratchFolder& folder, const Sweep& sweep,
                               const std::string& side) {
    std::map<std::string, std::string> heat;
    for (const Variant& variant : sweep.variants) heat[variant.name] = variant.heat;
    std::set<std::string> all;
    const Json coco =
        Json::parse(read_text(folder.path / ("annotations_" + side + ".json"), 1u << 20));
    for (const Json& image : coco["images"]) all.insert(heat.at(image["variant"]));
    return all;
}

}  // namespace

TEST_CASE("a split by heats has no heat on both sides, one by instants has all",
          "[scenes][labels][sweep]") {
    const ScratchFolder folder("split");
    Sweep sweep = swept(folder, 4);
    sweep.base.sweep.split = SweepSplit::heats;
    merge_labels(sweep, folder.path);
    const auto train = heats_of(folder, sweep, "train"),
               validation = heats_of(folder, sweep, "validation");
    CHECK(train.size() == 2);
    CHECK(validation.size() == 2);
    for (const std::string& heat : train) CHECK_FALSE(validation.contains(heat));
    sweep.base.sweep.split = SweepSplit::instants;
    merge_labels(sweep, folder.path);
    CHECK(heats_of(folder, sweep, "train").size() == 4);
    CHECK(heats_of(folder, sweep, "validation").size() == 4);
}

TEST_CASE("a split by heats of one heat is reported", "[scenes][labels][sweep]") {
    const ScratchFolder folder("split_one");
    Sweep sweep = swept(folder, 1);
    sweep.base.sweep.split = SweepSplit::heats;
    const MergedLabels merged = merge_labels(sweep, folder.path);
    REQUIRE(merged.notes.size() == 1);
    CHECK(merged.notes[0].find("in one set") != std::string::npos);
}
