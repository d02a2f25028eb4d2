#include "scenes/run/manifest.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/labels/attribute_json.hpp"
#include "scenes/run/digest.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> input_files(const Scene& scene) {
    std::vector<fs::path> files{scene.file, scene.terrain.elevation, scene.weather.file};
    files.insert(files.end(), scene.terrain.tiles.begin(), scene.terrain.tiles.end());
    if (scene.terrain.land_cover) files.push_back(scene.terrain.land_cover->file);
    if (!scene.air.table_file.empty()) files.push_back(scene.air.table_file);
    if (!scene.air.sounding_file.empty()) files.push_back(scene.air.sounding_file);
    for (const ShapesInput& shapes : scene.terrain.shapes) files.push_back(shapes.file);
    const ObjectInput* before = nullptr;
    for (const ObjectInput& object : scene.terrain.objects) {
        const bool again =
            before != nullptr && !object.copy_of.empty() && object.copy_of == before->copy_of;
        before = &object;
        if (again) continue;
        for (const fs::path& file : {object.file, object.target.file, object.copies_file}) {
            if (!file.empty()) files.push_back(file);
        }
    }
    for (const BandInput& band : scene.bands) {
        if (!band.file.empty()) files.push_back(band.file);
    }
    for (const TextureInput& texture : scene.textures) {
        if (!texture.file.empty()) files.push_back(texture.file);
    }
    for (const PlumeInput& plume : scene.plumes) {
        if (!plume.file.empty()) files.push_back(plume.file);
    }
    for (const TrajectoryInput& way : scene.trajectories) {
        if (!way.file.empty()) files.push_back(way.file);
    }
    if (!scene.time.state.empty()) files.push_back(scene.time.state);
    std::vector<fs::path> data;
    for (const auto& entry : fs::recursive_directory_iterator(data_folder())) {
        const std::string extension = entry.path().extension();
        if (entry.is_regular_file() && (extension == ".csv" || extension == ".toml")) {
            data.push_back(entry.path());
        }
    }
    std::sort(data.begin(), data.end());
    files.insert(files.end(), data.begin(), data.end());
    return files;
}

nlohmann::ordered_json legend_json(const Legend& legend) {
    nlohmann::ordered_json json{{"objects", nlohmann::json::array()},
                                {"parts", nlohmann::json::array()},
                                {"materials", nlohmann::json::array()}};
    for (const auto& [id, name, kind] : legend.object) {
        json["objects"].push_back({{"id", id}, {"name", name}, {"class", kind}});
    }
    for (const auto& [object, part, name, material, materials] : legend.part) {
        json["parts"].push_back({{"object", object},
                                 {"part", part},
                                 {"name", name},
                                 {"material", material},
                                 {"material_ids", materials}});
    }
    for (const auto& [id, name] : legend.material) {
        json["materials"].push_back({{"id", id}, {"name", name}});
    }
    return json;
}

/// One camera, or an array of them, each with its instant.
nlohmann::ordered_json course_json(const CameraCourse& course) {
    if (course.frame.empty()) return attribute_json(course.facts.front())["camera"];
    nlohmann::ordered_json json = nlohmann::json::array();
    for (std::size_t i = 0; i < course.frame.size(); ++i) {
        json.push_back({{"utc", format_instant(course.frame[i])}});
        json.back().update(attribute_json(course.facts[i])["camera"]);
    }
    return json;
}

}  // namespace

std::string job_key(const Scene& scene, const std::vector<std::string>& settings) {
    std::string text = DIURNA_VERSION;
    for (const std::string& setting : settings) text.append(1, '\n').append(setting);
    for (const fs::path& file : input_files(scene)) {
        text.append(1, '\n').append(sha256_of_file(file));
    }
    return sha256(text);
}

Manifest read_manifest(const fs::path& folder) {
    std::ifstream file(folder / "manifest.json");
    const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object()) return {};
    return {.key = json.value("key", std::string()),
            .start = json.value("start", std::string()),
            .not_converged = json.value("not_converged", std::string())};
}

void write_manifest(const fs::path& folder, const Scene& scene, const Manifest& manifest) {
    nlohmann::ordered_json json;
    json["program"] = "diurna " DIURNA_VERSION;
    json["compiler"] = "g++ " __VERSION__;
    json["state"] = manifest.outputs.empty() ? "running" : "done";
    if (!manifest.not_converged.empty()) json["not_converged"] = manifest.not_converged;
    json["key"] = manifest.key;
    json["scene"] = scene.name;
    json["seed"] = scene.seed;
    json["settings"] = manifest.settings;
    if (!manifest.weather.empty()) json["weather"] = manifest.weather;
    const double offset = scene.time.utc_offset;
    json["span"] = {format_local(scene.time.start, offset), format_local(scene.time.end(), offset)};
    for (std::size_t i = 0; i < manifest.frames.size(); ++i) {
        const Instant when = manifest.frames[i];
        json["frames"].push_back({{"utc", format_instant(when)},
                                  {"local_time", format_local(when, offset)},
                                  {"solar_time", format_solar_time(manifest.site, when)}});
        if (i >= manifest.facts.size()) continue;
        nlohmann::ordered_json facts = attribute_json(manifest.facts[i]);
        for (const char* group : {"sun", "air"}) json["frames"].back()[group] = facts[group];
    }
    for (const auto& [observer, course] : manifest.cameras) {
        json["cameras"][observer] = course_json(course);
    }
    json["legend"] = legend_json(manifest.legend);
    if (!manifest.start.empty()) json["start"] = manifest.start;
    json["threads"] = thread_count();
    for (const fs::path& file : input_files(scene)) {
        json["inputs"][file.lexically_normal().string()] = sha256_of_file(file);
    }
    for (const std::string& name : manifest.outputs) {
        json["outputs"][name] = sha256_of_file(folder / name);
    }
    for (const Progress::Stage& stage : manifest.stages)
        json["seconds"][stage.name] = stage.seconds;
    write_whole_file(folder / "manifest.json", json.dump(2) + "\n");
}

}  // namespace diurna
