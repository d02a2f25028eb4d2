#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"

namespace diurna {

/// A file that a run's results depend on.
struct RunInput {
    std::filesystem::path path;
    std::string name;    // relative to the scene's folder or the data folder, else absolute
    std::string sha256;  // of its content
};

/// All files that results depend on, ascending by path: those opened so far for the scene
/// (Scene::files), those it names, possible sidecars (`dem.tif.aux.xml`, `dem.tfw`), and the
/// program's data. Throws std::runtime_error if one has changed since it was read.
std::vector<RunInput> run_inputs(const Scene& scene);

/// SHA-256 over everything a job's results depend on: the program by its sources, the versions
/// of its libraries, the settings, names and contents of the inputs. The same key: the
/// same results.
std::string job_key(const std::vector<RunInput>& inputs, const std::vector<std::string>& settings);

}  // namespace diurna
