#include "scenes/app/sweep/merged_labels.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"
#include "scenes/app/sweep/records.hpp"
#include "scenes/products/labels/coco.hpp"
#include "scenes/products/labels/split.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

using OrderedJson = nlohmann::ordered_json;

/// Of one variant, as label_frames() wrote it.
struct Part {
    std::string variant, heat, folder;
    OrderedJson coco;

    /// What its pictures of an instant are drawn by.
    std::string drawn_by(SweepSplit split, const std::string& instant) const {
        return split == SweepSplit::heats      ? heat
               : split == SweepSplit::variants ? variant
                                               : instant;
    }
};

OrderedJson empty_set() {
    return {{"info",
             {{"description", made_by()},
              {"version", "1.0"},
              {"libraries", made_with()},
              {"grey_pictures", grey_picture_words()}}},
            {"licenses", OrderedJson::array()},
            {"images", OrderedJson::array()},
            {"annotations", OrderedJson::array()},
            {"categories", OrderedJson::array()}};
}

/// Names of all classes, in alphabetical order as in each part.
std::vector<std::string> classes_of(const std::vector<Part>& parts, bool& alike) {
    std::set<std::string> names;
    for (const Part& part : parts) {
        for (const OrderedJson& category : part.coco["categories"]) names.insert(category["name"]);
    }
    alike = std::all_of(parts.begin(), parts.end(), [&](const Part& part) {
        return part.coco["categories"].size() == names.size();
    });
    return {names.begin(), names.end()};
}

/// Whether the pictures of an instant, a variant or a heat, by its name, are for validation.
std::map<std::string, bool> drawn_split(const Sweep& sweep, const std::vector<Part>& parts,
                                        SweepSplit by) {
    std::set<std::string> names;
    for (const Part& part : parts) {
        for (const OrderedJson& image : part.coco["images"]) {
            names.insert(part.drawn_by(by, image["date_captured"]));
        }
    }
    const std::vector<bool> chosen =
        validation_instants(names.size(), sweep.base.labels.validation_share, sweep.base.seed);
    std::map<std::string, bool> split;
    std::size_t next = 0;
    for (const std::string& name : names) split[name] = chosen[next++];
    return split;
}

/// All sets with their ids run through: 0 training, 1 validation, 2 both.
struct Sets {
    OrderedJson coco[3] = {empty_set(), empty_set(), empty_set()};
    std::string list[2];

    void add(const Part& part, const std::map<std::string, bool>& split, SweepSplit by,
             const std::vector<std::string>& classes) {
        std::map<int, int> category;
        for (const OrderedJson& c : part.coco["categories"]) {
            const std::string name = c["name"];
            category[c["id"]] =
                1 + int(std::lower_bound(classes.begin(), classes.end(), name) - classes.begin());
        }
        struct At {
            std::size_t side, in_side, in_all;
        };
        std::map<int, At> at;
        for (const OrderedJson& image : part.coco["images"]) {
            const std::string instant = image["date_captured"];
            const bool validation = split.at(part.drawn_by(by, instant));
            const std::size_t side = validation ? 1 : 0;
            OrderedJson moved = image;
            for (const char* key : {"file_name", "planes"}) {
                moved[key] = part.folder + "/" + image[key].get<std::string>();
            }
            moved["split"] = validation ? "validation" : "train";
            moved["variant"] = part.variant;
            list[side] += "./" + moved["file_name"].get<std::string>() + "\n";
            at[image["id"]] = {side, coco[side]["images"].size() + 1, coco[2]["images"].size() + 1};
            for (const std::size_t set : {side, std::size_t{2}}) {
                moved["id"] = coco[set]["images"].size() + 1;
                coco[set]["images"].push_back(moved);
            }
        }
        for (const OrderedJson& annotation : part.coco["annotations"]) {
            const At& image = at.at(annotation["image_id"]);
            OrderedJson moved = annotation;
            moved["category_id"] = category.at(annotation["category_id"]);
            for (const std::size_t set : {image.side, std::size_t{2}}) {
                moved["id"] = coco[set]["annotations"].size() + 1;
                moved["image_id"] = set == 2 ? image.in_all : image.in_side;
                coco[set]["annotations"].push_back(moved);
            }
        }
    }
};

}  // namespace

MergedLabels merge_labels(const Sweep& sweep, const fs::path& out) {
    std::vector<Part> parts;
    for (const Variant& variant : sweep.variants) {
        const std::string folder = "variants/" + variant.name;
        parts.push_back(
            {variant.name, variant.heat, folder,
             OrderedJson::parse(read_text(out / folder / "annotations.json", 1u << 30))});
    }
    MergedLabels merged;
    SweepSplit by = sweep.base.sweep.split;
    std::map<std::string, bool> split = drawn_split(sweep, parts, by);
    if (by == SweepSplit::instants && split.size() < 2) {
        by = SweepSplit::variants;
        split = drawn_split(sweep, parts, by);
        merged.notes.emplace_back(
            "labels: all pictures have the same instant; the validation set is drawn from the "
            "variants");
    } else if (by == SweepSplit::heats && split.size() < 2) {
        merged.notes.emplace_back(
            "labels: all variants share their temperatures (sweep.split = \"heats\"); all pictures "
            "are in one set of the split");
    }
    bool alike = false;
    const std::vector<std::string> classes = classes_of(parts, alike);
    Sets sets;
    for (const Part& part : parts) sets.add(part, split, by, classes);
    const auto write = [&](const std::string& name, const std::string& text) {
        write_whole_file(out / name, text);
        merged.files.push_back(name);
    };
    const char* names[] = {"annotations_train.json", "annotations_validation.json",
                           "annotations.json"};
    for (std::size_t set = 0; set < 3; ++set) {
        for (std::size_t c = 0; c < classes.size(); ++c) {
            sets.coco[set]["categories"].push_back(
                {{"id", c + 1}, {"name", classes[c]}, {"supercategory", "object"}});
        }
        write(names[set],
              sets.coco[set].dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
    if (!alike) {
        merged.notes.emplace_back(
            "labels: the variants have different classes, so the class numbers in labels/*.txt "
            "differ; no YOLO lists are written");
        return merged;
    }
    const fs::path first = out / parts.front().folder;
    write("data.yaml", read_text(first / "data.yaml"));
    write("classes.txt", read_text(first / "classes.txt"));
    write("train.txt", sets.list[0]);
    write("validation.txt", sets.list[1]);
    return merged;
}

}  // namespace diurna
