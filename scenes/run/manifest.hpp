#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/plan/progress.hpp"

namespace diurna {

/// SHA-256 over everything a job's results depend on: the program's version, the scene's text and
/// settings, the files it names, the material library. The same key: the same results.
std::string job_key(const Scene& scene, const std::vector<std::string>& settings);

/// The key in a folder's manifest.json, or "" if there is none to be read.
std::string manifest_key(const std::filesystem::path& folder);

/// Writes manifest.json: key, inputs and outputs with SHA-256, versions, seed, settings, timings.
/// Written once without outputs when a job begins, so that a killed run can be resumed, and
/// again when it is done.
void write_manifest(const std::filesystem::path& folder, const Scene& scene,
                    const std::vector<std::string>& settings, const std::string& key,
                    const std::vector<std::string>& outputs = {},
                    const std::vector<Progress::Stage>& stages = {});

}  // namespace diurna
