#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Files of all frames, relative to the run's folder: for each observer, frame and band an EXR,
/// and a PNG beside it.
std::vector<std::string> frame_files(const Prepared& prepared);

/// Renders every frame that is not there yet and writes it as EXR with a PNG quick-look.
/// returns how many (observer, instant) were rendered
std::size_t render_frames(const Prepared& prepared, const SkyView& sky_view,
                          const TemperatureField& field, const std::filesystem::path& out,
                          Progress& progress);

/// Writes annotations.json (scenes/annotations.hpp) for all frames. Nothing moves, so one frame of
/// an observer tells where the objects are in all of them.
void annotate_frames(const Prepared& prepared, const std::filesystem::path& out);

}  // namespace diurna
