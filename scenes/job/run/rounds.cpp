#include "scenes/job/run/rounds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/job/run/listed_outputs.hpp"

namespace diurna {

namespace {

constexpr double most_at_once = 2.0;  // division of edges in one round

std::string key_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// Of one folder.
std::vector<Round> rounds_in(const std::filesystem::path& folder,
                             const std::vector<std::string>& settings,
                             const std::vector<RunInput>& inputs) {
    const ListedOutputs listed = listed_outputs(folder);
    std::vector<Round> rounds;
    for (const auto& [missed, set] : listed.rounds) rounds.push_back({missed, set});
    const bool same = listed.key == job_key(inputs, after_rounds(settings, rounds));
    return same ? rounds : std::vector<Round>{};
}

}  // namespace

Round round_after(const CheckError& error, const Scene& scene) {
    if (!(scene.tolerance > 0.0) || !(error.low > scene.tolerance) || error.set.empty()) return {};
    std::vector<Recommended> set = error.set;
    for (Recommended& one : set) {
        if (one.key == "scene.finer_edges")
            one.value = std::min(one.value, most_at_once * scene.finer_edges);
    }
    Round round{.missed = fmt::format(
                    "surface check: {:.2f} K rms (95 % interval {:.2f} to {:.2f}), more than "
                    "tolerance_K = {:g}; solved again with {}",
                    error.rms, error.low, error.high, scene.tolerance, in_words(set))};
    for (const Recommended& one : set) {
        round.settings.push_back(fmt::format("{}={:g}", one.key, one.value));
    }
    return round;
}

std::vector<std::string> with_settings(std::vector<std::string> settings,
                                       const std::vector<std::string>& added) {
    for (const std::string& one : added) {
        std::erase_if(settings,
                      [&](const std::string& other) { return key_of(other) == key_of(one); });
        settings.push_back(one);
    }
    return settings;
}

std::vector<std::string> after_rounds(std::vector<std::string> settings,
                                      const std::vector<Round>& rounds) {
    for (const Round& round : rounds) settings = with_settings(std::move(settings), round.settings);
    return settings;
}

std::vector<std::string> rounds_of_temperatures(const std::filesystem::path& file,
                                                const std::vector<std::string>& given) {
    if (file.empty()) return {};
    std::vector<std::string> settings;
    for (const auto& [missed, set] : listed_outputs(file.parent_path()).rounds) {
        settings = with_settings(std::move(settings), set);
    }
    std::erase_if(settings, [&](const std::string& one) {
        return std::any_of(given.begin(), given.end(),
                           [&](const std::string& other) { return key_of(other) == key_of(one); });
    });
    return settings;
}

std::vector<Round> earlier_rounds(const std::vector<std::filesystem::path>& folders,
                                  const std::vector<std::string>& settings, const Scene& scene) {
    if (folders.empty()) return {};
    const std::vector<RunInput> inputs = run_inputs(scene);
    for (const std::filesystem::path& folder : folders) {
        std::vector<Round> rounds = rounds_in(folder, settings, inputs);
        if (!rounds.empty()) return rounds;
    }
    return {};
}

}  // namespace diurna
