#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/run/check_error.hpp"
#include "scenes/job/store/inputs.hpp"

/// A run whose surface check (scenes/job/run/check_error.hpp) finds more than `tolerance_K` solves
/// its heat again with finer settings, at most Scene::rounds times.
namespace diurna {

/// What ends a round: settings for the next one.
struct Round {
    std::string missed{};                 // by how much, and what is set instead; in one line
    std::vector<std::string> settings{};  // "scene.object_sky_rays=1024"; empty: there is none
};

/// Empty if the error is within the tolerance or no setting would reduce it. Edges are divided by
/// at most 2 more than they were: facets become four times as many.
Round round_after(const CheckError& error, const Scene& scene);

/// Settings with others added, which replace those of the same key.
std::vector<std::string> with_settings(std::vector<std::string> settings,
                                       const std::vector<std::string>& added);
/// Settings of a run after its rounds.
std::vector<std::string> after_rounds(std::vector<std::string> settings,
                                      const std::vector<Round>& rounds);

/// Rounds of an earlier run in one of some folders, from its manifest.json, if it began with the
/// same settings and inputs; otherwise none.
///
/// - scene: with those settings
std::vector<Round> earlier_rounds(const std::vector<std::filesystem::path>& folders,
                                  const std::vector<std::string>& settings, const Scene& scene);

/// Settings of the rounds of the run that wrote a file of temperatures, from the manifest.json
/// beside it, except those whose keys are given; empty without one.
std::vector<std::string> rounds_of_temperatures(const std::filesystem::path& file,
                                                const std::vector<std::string>& given);

}  // namespace diurna
