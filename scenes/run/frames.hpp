#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "render/picture/frame.hpp"
#include "render/view/view.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/ledger.hpp"
#include "scenes/run/stages.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

struct FramesReport {
    std::size_t rendered = 0;             // (observer, instant); the others were there
    std::vector<std::string> notes{};     // how well tables and water were followed: worst frames
    std::vector<std::string> warnings{};  // what pictures could not hold, how instruments took them
};

/// Renders every frame that the ledger has not, writes it as EXR with a PNG quick-look
/// (scenes/plan/frame_files.hpp) and enters it. What is reported is of all frames, kept or
/// rendered.
///
/// - chosen: the scene's observers with the bands and frames to render
/// (scenes/plan/chosen_pictures)
FramesReport render_frames(const Stages& stages, const std::vector<ObserverInput>& chosen,
                           const TemperatureField& field, const std::filesystem::path& out,
                           Progress& progress, Ledger& ledger);
/// Renders them, whatever stands there.
FramesReport render_frames(const Stages& stages, const std::vector<ObserverInput>& chosen,
                           const TemperatureField& field, const std::filesystem::path& out,
                           Progress& progress);
/// Those of all observers.
FramesReport render_frames(const Stages& stages, const TemperatureField& field,
                           const std::filesystem::path& out, Progress& progress);

}  // namespace diurna
