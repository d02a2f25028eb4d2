#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/run/uncertain_scenes.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

struct FramesReport {
    std::size_t rendered = 0;             // (observer, instant); the others existed
    std::vector<std::string> notes{};     // errors of tables and water: worst frames
    std::vector<std::string> warnings{};  // pixels outside scales, instruments' warnings
};

/// From what pictures are rendered.
struct ShownHeat {
    const TemperatureField& field;
    /// The scene with uncertain values changed, solved, and what is reported of them: pictures get
    /// planes sigma.BAND.
    const ChangedScenes* changed = nullptr;
    std::span<const std::string> changes{};

    ShownHeat(const TemperatureField& of) : field(of) {}  // NOLINT: temperatures alone are enough
    ShownHeat(const TemperatureField& of, const ChangedScenes& others,
              std::span<const std::string> notes)
        : field(of), changed(others.empty() ? nullptr : &others), changes(notes) {}
};

/// Renders every frame that is not in the ledger, writes it as EXR with a PNG quick-look
/// (scenes/job/plan/frame_files.hpp) and enters it. The report covers all frames, existing or
/// rendered.
///
/// - chosen: the scene's observers with the bands and frames to render
///   (scenes/job/plan/chosen_pictures)
FramesReport render_frames(const Stages& stages, const std::vector<ObserverInput>& chosen,
                           const ShownHeat& heat, const std::filesystem::path& out,
                           Progress& progress, Ledger& ledger);
/// Renders them even if they exist.
FramesReport render_frames(const Stages& stages, const std::vector<ObserverInput>& chosen,
                           const ShownHeat& heat, const std::filesystem::path& out,
                           Progress& progress);
/// Those of all observers.
FramesReport render_frames(const Stages& stages, const ShownHeat& heat,
                           const std::filesystem::path& out, Progress& progress);

}  // namespace diurna
