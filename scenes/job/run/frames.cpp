#include "scenes/job/run/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "materials/base/number_of.hpp"
#include "materials/base/parallel.hpp"
#include "render/picture/cube.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/frame.hpp"
#include "render/picture/grey_picture.hpp"
#include "render/picture/quicklook.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/run/frame_messages.hpp"
#include "scenes/job/run/instrument_pictures.hpp"
#include "scenes/job/run/picture.hpp"
#include "scenes/job/run/series.hpp"
#include "scenes/job/run/sigma_planes.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

std::string not_held(const GreyPicture& counts, Instant instant) {
    return fmt::format(
        "{} outside {} at {}, written as the last count; the EXR file has the true values",
        number_of(counts.beyond, "pixel"), counts.scale, format_instant(instant));
}

/// EXR, quick-look and plain grey picture of every band; returns what the pictures could not hold.
Messages write_bands(const fs::path& out, const Frame& frame, const std::vector<Band>& bands,
                     const Scene& scene, const CameraTags& camera) {
    const LabelsInput& labels = scene.labels;
    Messages reported;
    for (const Band& band : bands) {
        const std::string name = frame_base(frame.observer, band.name, frame.instant);
        const Frame one = band_frame(frame, band.name);
        write_exr(out / (name + ".exr"), one, scene.output.compression, &camera);
        write_quicklook(out / (name + ".png"), one, shown_plane(band));
        const std::filesystem::path grey =
            out / grey_picture(frame.observer, band.name, frame.instant, labels.format);
        std::filesystem::create_directories(grey.parent_path());
        const GreyPicture counts = grey_picture_of(one, shown_plane(band), labels.bits);
        write_grey_picture(grey, counts, labels.format);
        // The ends of eight bits are those of the quick-look, which leave some out by intent.
        if (labels.bits == 16 && counts.beyond > 0) {
            reported.emplace_back("beyond." + band.name, not_held(counts, frame.instant));
        }
    }
    return reported;
}

/// In the spectral OpenEXR layout and for ENVI.
void write_cube(const fs::path& base, const Cube& cube, const Facts& facts,
                const CameraTags& camera) {
    Frame frame = spectral_frame(cube);
    frame.attributes.insert(facts.begin(), facts.end());
    write_exr(base.string() + ".exr", frame, ExrCompression::piz, &camera);
    write_envi(base.string() + ".img", cube);
}

using InstrumentViews = std::vector<std::unique_ptr<const InstrumentView>>;

/// An observer's frames: from what they are rendered, and where they go.
struct FrameWork {
    const Stages& stages;
    const ShownHeat& heat;
    std::size_t observer;        // of the scene's
    const ObserverInput& input;  // with the bands that are wanted
    const InstrumentViews& instruments;
    const fs::path& out;
    Ledger& ledger;

    const Sequence& sequence() const { return stages.scene().sequences[observer]; }
};

/// The observer's view and its instruments' of a scene whose objects are at one place each, and of
/// the scenes with uncertain values changed.
struct CastViews {
    const Prepared& prepared;
    const FacetViews& views;
    Series series;
    std::vector<InstrumentSeries> instruments;
    const std::vector<ChangedSeries>& changed;
};

/// - frames: instants of all frames with this view
/// - known: it, with the observer's samples a pixel, if it was cast before
CastViews cast_views(const FrameWork& work, const Prepared& here, const SceneStage& stage,
                     const Observer& eye, std::span<const Instant> frames,
                     const std::vector<ChangedSeries>& changed, std::optional<View> known = {}) {
    const TemperatureField& field = work.heat.field;
    return {here, stage.views,
            cast_series(here, work.input, eye, frames, stage.views, field, {}, std::move(known)),
            cast_instruments(work.instruments, here, eye, frames, stage.views, field), changed};
}

/// Renders and writes the bands and cubes of one instant, enters them with the tables' notes of
/// their error, and leaves what instruments see of it.
///
/// - blurred: objects go on while the picture is taken
void render_instant(const FrameWork& work, const CastViews& cast, Instant instant,
                    bool blurred = false) {
    const auto& [prepared, views, s, instruments, changed] = cast;
    const fs::path& out = work.out;
    const ShownHeat& heat = work.heat;
    Picture picture = picture_at(prepared, s, views, heat.field, instant, blurred);
    add_sigma_planes(changed, s.bands, instant, blurred, picture.frame);
    Messages reported(picture.frame.notes.begin(), picture.frame.notes.end());
    for (const std::string& change : heat.changes) reported.emplace_back("uncertain", change);
    if (picture.sample_error > 0.0) {
        reported.emplace_back("samples", fmt::format("{:.2g} K rms", picture.sample_error));
    }
    for (auto& beyond : write_bands(out, picture.frame, s.bands, prepared.scene, picture.camera)) {
        reported.push_back(std::move(beyond));
    }
    for (std::size_t c = 0; c < s.cubes.size(); ++c) {
        write_cube(out / frame_base(s.input.name, s.cubes[c].name, instant), picture.cube[c],
                   picture.facts, picture.camera);
    }
    const std::vector<std::string> files =
        picture_files(s.input, instant, prepared.scene.labels.format);
    if (!files.empty()) work.ledger.add(files, std::move(reported));
    for (const InstrumentSeries& one : instruments) {
        const Frame frame = seen_flux(one, prepared, views, heat.field, instant, blurred, picture);
        const fs::path file =
            out / (instrument_base(s.input.name, one.view.band.name, instant) + ".exr");
        fs::create_directories(file.parent_path());
        write_exr(file, frame, ExrCompression::none, &picture.camera);
    }
}

/// Whether objects go on while a picture is taken.
bool blurs(const Movement& movement, const Observer& observer, Instant when) {
    return !movement.none() && observer.takes_time() && movement.moves_at(when);
}

/// A scene at an instant, with objects on their way if any are.
StandingScene standing(const Stages& stages, const Observer& eye, Instant instant) {
    const Prepared& scene = stages.scene();
    const Movement& movement = scene.movement;
    StandingScene here{.stage = stages.at(movement.stage_of(instant))};
    if (blurs(movement, eye, instant)) {
        here.on_the_way.emplace(
            moving(scene, movement.poses_at(instant), movement.motions_at(instant), eye.reach()));
    } else if (!movement.none() && movement.is_under_way(instant)) {
        here.on_the_way.emplace(moved(scene, movement.poses_at(instant)));
    }
    return here;
}

/// An observer's bands in every scene with an uncertain value changed.
class ChangedViews {
 public:
    /// - standing: (ChangedScene) as it stands in these frames
    template <class Standing>
    ChangedViews(const ShownHeat& heat, const ObserverInput& input, const Observer& eye,
                 std::span<const Instant> frames, const Standing& standing)
        : input_(input) {
        if (!heat.changed) return;
        input_.cubes.clear();
        input_.terms = false;
        input_.surfaces = 0;
        for (const auto& scene : *heat.changed) {
            scene_.push_back(std::make_unique<const StandingScene>(standing(scene->stages)));
            const StandingScene& here = *scene_.back();
            series_.push_back({here, scene->field,
                               cast_series(here.prepared(), input_, eye, frames, here.stage.views,
                                           scene->field)});
        }
    }
    const std::vector<ChangedSeries>& series() const { return series_; }

 private:
    ObserverInput input_;
    std::vector<std::unique_ptr<const StandingScene>> scene_;
    std::vector<ChangedSeries> series_;
};

/// A frame of a moving observer, or while an object moves: with a view of its own, so that it has
/// the same bytes alone as in its sequence.
void render_alone(const FrameWork& work, std::size_t frame) {
    const Instant instant = work.sequence().frame[frame];
    const Observer& eye = work.sequence().at(frame);
    const StandingScene here = standing(work.stages, eye, instant);
    const ChangedViews changed(work.heat, work.input, eye, {&instant, 1},
                               [&](const Stages& other) { return standing(other, eye, instant); });
    const CastViews cast =
        cast_views(work, here.prepared(), here.stage, eye, {&instant, 1}, changed.series());
    render_instant(work, cast, instant, blurs(work.stages.scene().movement, eye, instant));
}

/// The frames of an observer, those whose numbers are `wanted`. Of one that stands the view is cast
/// once for each stage.
void render_sequence(const FrameWork& work, std::span<const std::size_t> wanted,
                     Progress& progress) {
    const Movement& movement = work.stages.scene().movement;
    const Sequence& sequence = work.sequence();
    std::vector<std::size_t> alone;                                   // places in `wanted`
    std::vector<std::vector<std::size_t>> still(work.stages.size());  // (stage) likewise
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Instant when = sequence.frame[wanted[i]];
        const bool goes = sequence.goes || (!movement.none() && movement.is_under_way(when)) ||
                          blurs(movement, sequence.at(wanted[i]), when);
        (goes ? alone : still[movement.stage_of(when)]).push_back(i);
    }
    std::atomic<std::size_t> done = 0;
    const auto each = [&](const std::vector<std::size_t>& of, const auto& render_one) {
        for_each_index(
            of.size(),
            [&](std::size_t k) {
                render_one(wanted[of[k]]);
                progress.done(static_cast<double>(++done) / static_cast<double>(wanted.size()));
            },
            1);
    };
    for (std::size_t s = 0; s < still.size(); ++s) {
        if (still[s].empty()) continue;
        progress.stage(StageId::views, work.input.name);
        const SceneStage stage = work.stages.at(s);
        std::vector<Instant> frames;  // of the stage, whichever are still to be rendered
        for (const Instant when : sequence.frame) {
            if (movement.stage_of(when) == s) frames.push_back(when);
        }
        const ChangedViews changed(
            work.heat, work.input, sequence.at(0), frames,
            [&](const Stages& other) { return StandingScene{.stage = other.at(s)}; });
        const CastViews cast =
            cast_views(work, stage.prepared, stage, sequence.at(0), frames, changed.series(),
                       work.stages.take_view(work.observer, s));
        progress.stage(StageId::frames, work.input.name);
        each(still[s],
             [&](std::size_t frame) { render_instant(work, cast, sequence.frame[frame]); });
    }
    if (!alone.empty()) progress.stage(StageId::frames, work.input.name);
    each(alone, [&](std::size_t frame) { render_alone(work, frame); });
}

}  // namespace

FramesReport render_frames(const Stages& stages, const std::vector<ObserverInput>& chosen,
                           const ShownHeat& heat, const fs::path& out, Progress& progress,
                           Ledger& ledger) {
    FramesReport report;
    const Prepared& prepared = stages.scene();
    for (std::size_t o = 0; o < prepared.sequences.size(); ++o) {
        const ObserverInput& input = chosen[o];
        const std::vector<Instant>& all = prepared.sequences[o].frame;
        const auto files = [&](Instant when) {
            return frame_files(input, when, prepared.scene.labels.format);
        };
        std::vector<std::size_t> wanted;  // places in all
        for (const Instant when : input.frames) {
            if (ledger.has(files(when))) continue;
            wanted.push_back(
                std::size_t(std::lower_bound(all.begin(), all.end(), when) - all.begin()));
        }
        if (!wanted.empty()) {
            const InstrumentViews instruments = instrument_views(prepared.scene, input);
            render_sequence({stages, heat, o, input, instruments, out, ledger}, wanted, progress);
            if (!instruments.empty()) progress.stage(StageId::instruments, input.name);
            for (const auto& view : instruments) {
                Messages notes;
                for (std::string& note :
                     take_pictures(*view, prepared, prepared.sequences[o], wanted, out)) {
                    notes.emplace_back("instrument", std::move(note));
                }
                ledger.add({calibration_file(input.name, view->band.name)}, std::move(notes));
            }
            for (const std::size_t i : wanted) {
                const std::vector<std::string> taken =
                    instrument_files(input, all[i], prepared.scene.labels.format);
                if (!taken.empty()) ledger.add(taken, {});
            }
        }
        for (const std::string& band : input.instruments) {
            for (const auto& [what, note] : ledger.reported(calibration_file(input.name, band))) {
                report.warnings.push_back("instrument " + note);
            }
        }
        report.rendered += wanted.size();
        std::vector<Messages> reported;
        for (const Instant when : input.frames) {
            if (!files(when).empty()) reported.push_back(ledger.reported(files(when).front()));
        }
        for (std::string& line : changes_reported(reported)) {
            if (std::find(report.notes.begin(), report.notes.end(), line) == report.notes.end()) {
                report.notes.push_back(std::move(line));
            }
        }
        for (std::string& line : errors_reported(input, reported))
            report.notes.push_back(std::move(line));
        for (std::string& line : beyond_reported(input, reported)) {
            report.warnings.push_back(std::move(line));
        }
    }
    return report;
}

FramesReport render_frames(const Stages& stages, const std::vector<ObserverInput>& chosen,
                           const ShownHeat& heat, const fs::path& out, Progress& progress) {
    Ledger ledger(out, "", false);
    ledger.write();
    return render_frames(stages, chosen, heat, out, progress, ledger);
}

FramesReport render_frames(const Stages& stages, const ShownHeat& heat, const fs::path& out,
                           Progress& progress) {
    return render_frames(stages, stages.scene().scene.observers, heat, out, progress);
}

}  // namespace diurna
