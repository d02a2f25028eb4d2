#include "scenes/job/run/listed_outputs.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "materials/base/error.hpp"
#include "scenes/job/plan/sweep_folder.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/store/digest.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

/// Names that lead out of the folder are no run's.
bool stays_below(const fs::path& name) {
    const fs::path normal = name.lexically_normal();
    return !normal.empty() && normal.is_relative() && *normal.begin() != "..";
}

void add(const Json& json, const char* key, const std::string& folder, ListedOutputs& listed) {
    if (!json.contains(key) || !json[key].is_object()) return;
    for (const auto& [name, digest] : json[key].items()) {
        if (digest.is_string() && stays_below(folder + name)) {
            listed.digest[folder + name] = digest.get<std::string>();
        }
    }
}

std::string listed_text(const Json& json, const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
}

std::vector<std::string> listed_texts(const Json& json, const char* key) {
    std::vector<std::string> texts;
    for (const Json& text : json.value(key, Json::array())) {
        if (text.is_string()) texts.push_back(text.get<std::string>());
    }
    return texts;
}

/// One line of what is changed with a file; "" where it is what it was.
std::string changed(const fs::path& folder, const std::string& name, const std::string& digest) {
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(folder / name, ignored);
    if (!fs::exists(status)) return name + ": missing";
    if (!fs::is_regular_file(status)) return name + ": not a regular file";
    return sha256_of_file(folder / name) == digest ? "" : name + ": changed since the run";
}

}  // namespace

ListedOutputs listed_outputs(const fs::path& folder) {
    ListedOutputs listed;
    std::ifstream file(folder / "manifest.json");
    const Json json = Json::parse(file, nullptr, false);
    if (!json.is_object() || !listed_text(json, "program").starts_with("diurna")) return listed;
    listed.found = true;
    add(json, "outputs", "", listed);
    if (!json.contains("variants")) {  // of a run
        listed.done = listed_text(json, "state") == "done";
        listed.scene = listed_text(json, "scene_file");
        listed.key = listed_text(json, "key");
        listed.settings = listed_texts(json, "settings");
        const Json inputs = json.value("inputs", Json::object());
        for (const auto& [name, digest] : inputs.items()) listed.inputs.emplace_back(name);
        for (const Json& round : json.value("rounds", Json::array())) {
            listed.rounds.emplace_back(listed_text(round, "missed"),
                                       listed_texts(round, "settings"));
        }
        return listed;
    }
    listed.done = true;  // a sweep's is written last
    for (const Json& variant : json["variants"]) {
        add(variant, "outputs", listed_text(variant, "folder") + "/", listed);
    }
    for (const Json& heat : json.value("heats", Json::array())) {
        const std::string name = listed_text(heat, "temperatures");
        if (stays_below(name)) listed.digest[name] = listed_text(heat, "sha256");
    }
    return listed;
}

bool is_listed(const fs::path& folder) {
    if (listed_outputs(folder).found) return true;
    std::ifstream file(folder / ledger_file);
    std::string line;
    std::getline(file, line);
    return listed_text(Json::parse(line, nullptr, false), "program").starts_with("diurna");
}

bool is_whole(const fs::path& folder, const std::map<std::string, std::string>& digests) {
    return std::all_of(digests.begin(), digests.end(), [&](const auto& file) {
        return !file.second.empty() && changed(folder, file.first, file.second).empty();
    });
}

std::vector<std::string> verify(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw InputError(folder.string(), "no such folder");
    const ListedOutputs listed = listed_outputs(folder);
    if (!listed.found && !sweep_around(folder).empty()) {
        throw InputError(folder.string(), "is a part of a sweep, which is verified as a whole",
                         "diurna verify " + sweep_around(folder).string());
    }
    if (!listed.found && is_sweep_folder(folder)) {
        return {"manifest.json: missing, as the sweep is not complete (--resume completes it)"};
    }
    if (!listed.found) return {"manifest.json: missing, or not written by a run"};
    std::vector<std::string> lines;
    if (!listed.done) lines.push_back("manifest.json: the run is not complete");
    std::map<std::string, std::string> files = listed.digest;
    if (!listed.done) files.merge(ledger_digests(folder));
    std::set<fs::path> folders;
    for (const auto& [name, digest] : files) {
        if (!stays_below(name)) continue;
        if (std::string line = changed(folder, name, digest); !line.empty()) {
            lines.push_back(std::move(line));
        }
        if (fs::path(name).has_parent_path()) folders.insert(fs::path(name).parent_path());
    }
    for (const fs::path& inner : folders) {
        std::error_code none;
        std::set<std::string> others;
        for (const auto& entry : fs::directory_iterator(folder / inner, none)) {
            const std::string name = (inner / entry.path().filename()).string();
            const std::string file = entry.path().filename().string();
            const bool own_list = file == "variant.json" || file == "done.json";
            if (entry.is_directory() || files.contains(name) || own_list) continue;
            others.insert(name + ": not written by this run");
        }
        lines.insert(lines.end(), others.begin(), others.end());
    }
    return lines;
}

}  // namespace diurna
