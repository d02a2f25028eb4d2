#include "scenes/job/run/frame_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace diurna {

namespace {

/// Of all frames' notes of one name, which begin with a number, that of the greatest.
std::string worst_note(std::span<const Messages> notes, const std::string& name) {
    std::string worst;
    double most = -1.0;
    for (const Messages& of_frame : notes) {
        for (const auto& [key, note] : of_frame) {
            const double value = std::strtod(note.c_str(), nullptr);
            if (key != name || value <= most) continue;
            most = value;
            worst = note;
        }
    }
    return worst;
}

/// The error of samples over all frames, and in the worst where they differ.
std::string samples_note(std::span<const Messages> reported) {
    double squares = 0.0, worst = 0.0;
    int count = 0;
    for (const Messages& of_frame : reported) {
        for (const auto& [key, note] : of_frame) {
            if (key != "samples") continue;
            const double kelvins = std::strtod(note.c_str(), nullptr);
            squares += kelvins * kelvins;
            worst = std::max(worst, kelvins);
            ++count;
        }
    }
    if (count == 0) return "";
    const std::string rms = fmt::format("{:.2g} K rms", std::sqrt(squares / count));
    return count == 1 ? rms : fmt::format("{} (the worst of them by {:.2g} K)", rms, worst);
}

}  // namespace

std::vector<std::string> errors_reported(const ObserverInput& observer,
                                         std::span<const Messages> reported) {
    std::vector<std::string> lines;
    for (const std::string& band : observer.bands) {
        const std::string table = worst_note(reported, "error." + band);
        if (table.empty()) continue;  // none of its pictures was rendered
        std::string line = "radiance tables against direct sums, worst frame: " + observer.name +
                           ", " + band + ": " + table;
        const std::string scattered = worst_note(reported, "scattered." + band);
        if (!scattered.empty()) line += "; light scattered in front of surfaces: " + scattered;
        lines.push_back(std::move(line));
    }
    if (const std::string samples = samples_note(reported); !samples.empty()) {
        lines.push_back("samples: pictures of " + observer.name + " differ by " + samples +
                        " from those with unlimited rays per pixel (estimated from differences "
                        "within pixels; without textures, edges of plumes and what mirrors show)");
    }
    if (const std::string water = worst_note(reported, "water"); !water.empty()) {
        lines.push_back("wet and snow-covered surfaces, frame with most of them: " + observer.name +
                        ": " + water);
    }
    return lines;
}

std::vector<std::string> changes_reported(std::span<const Messages> reported) {
    std::vector<std::string> lines;
    for (const Messages& of_frame : reported) {
        for (const auto& [key, note] : of_frame) {
            if (key == "uncertain") lines.push_back(note);
        }
        if (!lines.empty()) break;
    }
    return lines;
}

std::vector<std::string> beyond_reported(const ObserverInput& observer,
                                         std::span<const Messages> reported) {
    std::vector<std::string> lines;
    for (const std::string& band : observer.bands) {
        const std::string beyond = worst_note(reported, "beyond." + band);
        if (beyond.empty()) continue;
        lines.push_back("grey picture of " + observer.name + ", " + band + ": " + beyond);
    }
    return lines;
}

}  // namespace diurna
