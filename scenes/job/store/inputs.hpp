#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/files_read.hpp"
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

/// Those that the scene names itself and that exist, opened yet or not.
std::vector<FileRead> named_inputs(const Scene& scene);

/// Paths of RunInput or FileRead.
template <class File>
std::vector<std::filesystem::path> paths_of(const std::vector<File>& files) {
    std::vector<std::filesystem::path> paths;
    for (const File& file : files) paths.push_back(file.path);
    return paths;
}

/// SHA-256 over everything a job's results depend on: the program by its sources, the versions
/// of its libraries, the settings, names and contents of the inputs. The same key: the
/// same results.
std::string job_key(const std::vector<RunInput>& inputs, const std::vector<std::string>& settings);

}  // namespace diurna
