#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/picture/frame.hpp"
#include "render/view/view.hpp"
#include "scenes/run/job.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Files of all frames, relative to the run's folder: for each observer, frame and band an EXR,
/// and a PNG beside it.
std::vector<std::string> frame_files(const Prepared& prepared);

/// Renders every frame that is not there yet and writes it as EXR with a PNG quick-look.
/// returns how many (observer, instant) were rendered
///
/// errors  if given: a line for every observer and band, what the tables of its worst frame say of
///         their error against the direct sum (Frame::notes)
std::size_t render_frames(const Prepared& prepared, const FacetViews& views,
                          const TemperatureField& field, const std::filesystem::path& out,
                          Progress& progress, std::vector<std::string>* errors = nullptr);

/// The truth plane "void": 1 at pixels whose ground was filled in for want of elevation
/// (World::filled, which is not empty), 0 elsewhere, −1 where it is sky.
Plane void_plane(const View& view, const World& world);

/// Writes annotations.json (scenes/report/annotations.hpp) for all frames. Nothing moves, so one
/// frame of an observer tells where the objects are in all of them.
void annotate_frames(const Prepared& prepared, const std::filesystem::path& out);

}  // namespace diurna
