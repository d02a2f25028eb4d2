#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenes/cache/inputs.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/camera_truth.hpp"
#include "scenes/run/legend.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// A camera's place and picture: of one that goes at each of its frames, of another once.
struct CameraCourse {
    std::vector<Instant> frame{};  // empty: it stands
    std::vector<Facts> facts{};    // camera_facts()
};

/// What manifest.json says of a run beside its scene, its inputs and the program's version.
struct Manifest {
    std::string key{};  // job_key()
    std::vector<RunInput> inputs{};
    std::vector<std::string> settings{};            // of the command line
    std::vector<std::string> only{};                // what of the pictures was chosen; empty: all
    std::vector<Instant> frames{};                  // when pictures are taken
    Site site{};                                    // for their solar time
    std::vector<Facts> facts{};                     // (frame) instant_facts()
    std::map<std::string, CameraCourse> cameras{};  // by observer
    Legend legend{};
    std::string weather{};               // what was modelled and filled in of it
    std::string start{};                 // how the heat balance's was found, and what it is worth
    std::string not_converged{};         // by how much the temperatures miss the tolerance
    std::vector<std::string> outputs{};  // files of the folder; empty: still running
    std::vector<Progress::Stage> stages{};
};

/// Writes manifest.json: key, inputs and outputs with SHA-256, versions, seed, settings, timings.
/// Written once without outputs when a job begins, so that a killed run can be resumed, and
/// again when it is done.
void write_manifest(const std::filesystem::path& folder, const Scene& scene,
                    const Manifest& manifest);

}  // namespace diurna
