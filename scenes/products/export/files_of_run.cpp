#include "scenes/products/export/files_of_run.hpp"

#include "scenes/job/plan/sweep_folder.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/listed_outputs.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Inputs of a run. A manifest has their paths as the run named them, from the folder it was
/// started in, and the scene file's whole path: so they are found from where the scene is.
std::vector<fs::path> inputs_of(const ListedOutputs& listed) {
    std::vector<fs::path> all = listed.inputs;
    for (const fs::path& scene : listed.inputs) {
        if (scene.filename() != listed.scene.filename()) continue;
        for (const fs::path& input : listed.inputs) {
            if (input.is_absolute() != scene.is_absolute()) continue;
            all.push_back(listed.scene.parent_path() /
                          input.lexically_proximate(scene.parent_path()));
        }
    }
    return all;
}

void add(const fs::path& folder, std::vector<FileRead>& all) {
    const ListedOutputs listed = listed_outputs(folder);
    for (const fs::path& input : inputs_of(listed)) all.push_back({.path = input});
    for (const auto& [name, digest] : listed.digest) all.push_back({.path = folder / name});
    for (const char* name : {"manifest.json", ledger_file}) all.push_back({.path = folder / name});
}

}  // namespace

std::vector<FileRead> files_of_run(const fs::path& folder) {
    std::vector<FileRead> all;
    add(folder, all);
    if (const fs::path sweep = sweep_around(folder); !sweep.empty()) add(sweep, all);
    return all;
}

}  // namespace diurna
