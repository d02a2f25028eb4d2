#include "scenes/app/sweep/records.hpp"

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson read_json(const fs::path& path) {
    std::ifstream file(path);
    OrderedJson json = OrderedJson::parse(file, nullptr, false);
    return json.is_object() ? json : OrderedJson::object();
}

/// {"observer.east.width": 320, ...}
OrderedJson values_json(const SweepInput& sweep, const Variant& variant) {
    OrderedJson values = OrderedJson::object();
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
        const SweepAxis& axis = sweep.axes[a];
        for (std::size_t k = 0; k < axis.keys.size(); ++k) {
            values[axis.keys[k]] = OrderedJson::parse(axis.values[variant.choice[a]][k]);
        }
    }
    return values;
}

OrderedJson axes_json(const SweepInput& sweep) {
    OrderedJson axes = OrderedJson::array();
    for (const SweepAxis& axis : sweep.axes) {
        OrderedJson values = OrderedJson::array();
        for (const std::vector<std::string>& row : axis.values) {
            OrderedJson each = OrderedJson::array();
            for (const std::string& text : row) each.push_back(OrderedJson::parse(text));
            values.push_back(std::move(each));
        }
        axes.push_back({{"name", axis.name}, {"keys", axis.keys}, {"values", values}});
    }
    return axes;
}

}  // namespace

fs::path heat_folder(const fs::path& out, const std::string& heat) { return out / "heat" / heat; }

fs::path variant_folder(const fs::path& out, const std::string& variant) {
    return out / "variants" / variant;
}

SweptHeat read_heat_record(const fs::path& folder) {
    const OrderedJson json = read_json(folder / "done.json");
    if (!json.contains("key")) return {};
    return {.key = json.value("key", ""),
            .sha256 = json.value("temperatures_sha256", ""),
            .start = json.value("start", ""),
            .not_converged = json.value("not_converged", ""),
            .notes = json.value("notes", std::vector<std::string>{}),
            .content = json.value("heat_content", "")};
}

VariantRecord read_variant_record(const fs::path& folder) {
    const OrderedJson json = read_json(folder / "variant.json");
    if (!json.contains("key")) return {};
    return {.key = json.value("key", ""),
            .done = json.value("state", "") == "done",
            .outputs = json.value("outputs", std::map<std::string, std::string>{}),
            .notes = json.value("notes", std::vector<std::string>{})};
}

std::vector<std::string> recorded_files(const VariantRecord& record) {
    std::vector<std::string> names;
    for (const auto& [name, digest] : record.outputs) names.push_back(name);
    return names;
}

void write_heat_record(const fs::path& folder, const SweptHeat& record) {
    const OrderedJson json = {{"key", record.key},     {"temperatures_sha256", record.sha256},
                              {"start", record.start}, {"not_converged", record.not_converged},
                              {"notes", record.notes}, {"heat_content", record.content}};
    write_whole_file(folder / "done.json",
                     json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void write_variant_record(const fs::path& folder, const Sweep& sweep, const Variant& variant,
                          const VariantRecord& record) {
    const OrderedJson json = {{"variant", variant.name},
                              {"state", record.done ? "done" : "running"},
                              {"key", record.key},
                              {"heat", variant.heat},
                              {"values", values_json(sweep.base.sweep, variant)},
                              {"notes", record.notes},
                              {"outputs", record.outputs}};
    write_whole_file(folder / "variant.json",
                     json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void write_sweep_manifest(const fs::path& out, const Sweep& sweep,
                          const std::map<std::string, std::string>& outputs) {
    const SweepInput& input = sweep.base.sweep;
    OrderedJson json;
    json["program"] = made_by();
    json["libraries"] = made_with();
    json["scene"] = sweep.base.name;
    json["seed"] = sweep.base.seed;
    json["settings"] = sweep.settings;
    json["sweep"] = {{"axes", axes_json(input)},
                     {"combinations", std::uint64_t(input.grid())},
                     {"drawn", bool(input.draw)},
                     {"split", word_of(input.split)}};
    json["heats"] = OrderedJson::array();
    std::set<std::string> heats;
    for (const Variant& variant : sweep.variants) heats.insert(variant.heat);
    for (const std::string& heat : heats) {
        const SweptHeat record = read_heat_record(heat_folder(out, heat));
        OrderedJson entry = {{"name", heat},
                             {"temperatures", "heat/" + heat + "/temperatures.nc"},
                             {"sha256", record.sha256},
                             {"key", record.key},
                             {"start", record.start}};
        if (!record.not_converged.empty()) entry["not_converged"] = record.not_converged;
        json["heats"].push_back(std::move(entry));
    }
    json["variants"] = OrderedJson::array();
    for (const Variant& variant : sweep.variants) {
        const VariantRecord record = read_variant_record(variant_folder(out, variant.name));
        json["variants"].push_back({{"name", variant.name},
                                    {"folder", "variants/" + variant.name},
                                    {"heat", variant.heat},
                                    {"key", record.key},
                                    {"values", values_json(input, variant)},
                                    {"outputs", record.outputs}});
    }
    json["outputs"] = outputs;
    write_whole_file(out / "manifest.json",
                     json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace diurna
