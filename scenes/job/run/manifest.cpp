#include "scenes/job/run/manifest.hpp"

#include <nlohmann/json.hpp>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/store/digest.hpp"
#include "scenes/products/labels/attribute_json.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

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

/// What the results depend on.
std::vector<RunInput> inputs_of(const Prepared& prepared, const fs::path& heat) {
    std::vector<RunInput> inputs = run_inputs(prepared.scene);
    if (!heat.empty() && !fs::is_regular_file(heat)) {
        throw InputError(heat.string(), "no such file",
                         "diurna solve SCENE --out FILE.nc computes it");
    }
    if (!heat.empty()) inputs.push_back({heat, "temperatures", sha256_of_file(heat)});
    return inputs;
}

}  // namespace

Manifest manifest_of(const Prepared& prepared, const fs::path& heat,
                     const std::vector<std::string>& settings) {
    Manifest manifest{.inputs = inputs_of(prepared, heat),
                      .settings = settings,
                      .frames = prepared.plan.frames,
                      .site = prepared.world.site,
                      .legend = legend_of(prepared),
                      .weather = prepared.weather.note};
    manifest.key = job_key(manifest.inputs, settings);
    for (const Sequence& sequence : prepared.sequences) {
        CameraCourse& course = manifest.cameras[sequence.at(0).name];
        if (sequence.goes) course.frame = sequence.frame;
        for (const Observer& pose : sequence.pose) {
            course.facts.push_back(camera_facts(prepared.world, pose));
        }
    }
    for (const Instant instant : prepared.plan.frames) {
        manifest.facts.push_back(instant_facts(prepared, instant));
    }
    return manifest;
}

void write_manifest(const fs::path& folder, const Scene& scene, const Manifest& manifest) {
    nlohmann::ordered_json json;
    json["program"] = made_by();
    json["compiler"] = "g++ " __VERSION__;
    json["libraries"] = made_with();
    json["state"] = manifest.outputs.empty() ? "running" : "done";
    if (!manifest.not_converged.empty()) json["not_converged"] = manifest.not_converged;
    json["key"] = manifest.key;
    json["scene"] = scene.name;
    json["scene_file"] = fs::absolute(scene.file).lexically_normal().string();
    json["seed"] = scene.seed;
    json["settings"] = manifest.settings;
    for (const auto& [missed, settings] : manifest.rounds) {
        json["rounds"].push_back({{"missed", missed}, {"settings", settings}});
    }
    if (!manifest.only.empty()) json["only"] = manifest.only;
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
        for (const char* group : {"sun", "sky", "air"}) {
            if (facts.contains(group)) json["frames"].back()[group] = facts[group];
        }
    }
    for (const auto& [observer, course] : manifest.cameras) {
        json["cameras"][observer] = course_json(course);
    }
    json["legend"] = legend_json(manifest.legend);
    if (!manifest.start.empty()) json["start"] = manifest.start;
    json["threads"] = thread_count();
    for (const RunInput& input : manifest.inputs) {
        json["inputs"][input.path.string()] = input.sha256;
    }
    for (const std::string& name : manifest.outputs) {
        const auto known = manifest.digests.find(name);
        json["outputs"][name] =
            known != manifest.digests.end() ? known->second : sha256_of_file(folder / name);
    }
    for (const Progress::Stage& stage : manifest.stages)
        json["seconds"][stage.name] = stage.seconds;
    write_whole_file(folder / "manifest.json",
                     json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace diurna
