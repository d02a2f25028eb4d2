#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/camera_truth.hpp"
#include "scenes/job/run/legend.hpp"
#include "scenes/job/run/rounds.hpp"
#include "scenes/job/store/inputs.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// A camera's pose and picture: for a moving one at each of its frames, otherwise once.
struct CameraCourse {
    std::vector<Instant> frame{};  // empty: at rest
    std::vector<Facts> facts{};    // camera_facts()
};

/// Content of manifest.json besides scene, inputs and the program's version.
struct Manifest {
    std::string key{};  // job_key()
    std::vector<RunInput> inputs{};
    std::vector<std::string> settings{};            // of the command line, and of rounds
    std::vector<Round> rounds{};                    // before the heat that is in the folder
    std::vector<std::string> only{};                // selection of the pictures; empty: all
    std::vector<Instant> frames{};                  // instants of pictures
    Site site{};                                    // for their solar time
    std::vector<Facts> facts{};                     // (frame) instant_facts()
    std::map<std::string, CameraCourse> cameras{};  // by observer
    Legend legend{};
    std::string weather{};               // notes on modelled and filled values
    std::string start{};                 // how the heat balance's start was computed; effect
    std::string not_converged{};         // how far the temperatures miss the tolerance
    std::vector<std::string> outputs{};  // files of the folder; empty: running
    std::map<std::string, std::string> digests{};  // SHA-256 of outputs, where known
    std::vector<Progress::Stage> stages{};
};

/// What is known before anything is computed. Throws InputError if the file of temperatures does
/// not exist.
///
/// - heat: temperatures from a file; "": they are computed
/// - settings: of the command line
Manifest manifest_of(const Prepared& prepared, const std::filesystem::path& heat,
                     const std::vector<std::string>& settings);

/// Writes manifest.json: key, inputs and outputs with SHA-256, versions, seed, settings, timings.
/// Written without outputs when a job begins, so that a killed run can be resumed, and again when
/// it is done.
void write_manifest(const std::filesystem::path& folder, const Scene& scene,
                    const Manifest& manifest);

}  // namespace diurna
