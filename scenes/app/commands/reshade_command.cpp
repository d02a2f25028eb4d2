#include "scenes/app/commands/reshade_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/plain_text.hpp"
#include "materials/base/unfinished.hpp"
#include "materials/matter/read_library.hpp"
#include "render/picture/exr.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "scenes/job/run/run_folder.hpp"
#include "scenes/products/export/reshade.hpp"
#include "scenes/products/export/run_heat.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

struct ReshadeArguments {
    fs::path folder, out, heat;
    std::string of, paint;
    std::vector<std::string> frames;
    std::optional<double> emissivity, reflectance;
    double warmer = 0.0, heat_share = 1.0;
};

void check_reshade(const ReshadeArguments& a) {
    if (!a.emissivity && !a.reflectance && a.paint.empty() && a.warmer == 0.0 && a.heat.empty()) {
        throw InputError("reshade", "expected at least one change",
                         "--emissivity, --reflectance, --paint, --warmer or --heat");
    }
    if (!a.paint.empty() && (a.emissivity || a.reflectance)) {
        throw InputError("--paint", "cannot be combined with --emissivity or --reflectance");
    }
}

/// Refuses a folder in which anything but an earlier reshade's pictures would be overwritten:
/// another file than one of the names of the run's pictures, or a folder that a run fills.
void check_out(const ReshadeArguments& a) {
    const auto refuse = [&](const std::string& why) {
        throw InputError("--out", fmt::format("{} {}", a.out.string(), why),
                         "choose another folder, new or empty");
    };
    if (const std::string why = why_no_output_folder(a.out); !why.empty()) refuse(why);
    check_not_in_use(a.out);
    if (is_results_folder(a.out)) refuse("holds the results of a run or a sweep");
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(a.out, none)) {
        const fs::path name = entry.path().filename();
        const bool picture = entry.is_regular_file() && name.extension() == ".exr" &&
                             fs::exists(a.folder / "frames" / name, none);
        if (picture || is_temporary_name(name.string())) continue;
        refuse(fmt::format("holds {}, which is not one of the run's pictures", name.string()));
    }
}

/// The run's pictures whose names contain one of the texts; all without any.
std::vector<fs::path> chosen_frames(const ReshadeArguments& a) {
    std::vector<fs::path> frames;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(a.folder / "frames", none)) {
        const std::string name = entry.path().filename().string();
        const bool asked = a.frames.empty() ||
                           std::any_of(a.frames.begin(), a.frames.end(), [&](const auto& text) {
                               return name.find(text) != std::string::npos;
                           });
        if (entry.path().extension() == ".exr" && asked) frames.push_back(entry.path());
    }
    std::sort(frames.begin(), frames.end());
    if (frames.empty()) {
        throw InputError((a.folder / "frames").string(),
                         a.frames.empty() ? "has no pictures (.exr)"
                                          : "has no picture whose name contains the given text");
    }
    return frames;
}

std::string reported(const fs::path& file, const ReshadedFrame& found, bool heat) {
    std::string text =
        fmt::format("{}: {} pixels, apparent temperature changes by {:.3g} K rms; error: ",
                    file.filename().string(), found.pixels, found.change);
    text += found.summed > 0
                ? fmt::format(
                      "the listed surfaces differ from the picture by {:.2g} K rms, {:.2g} "
                      "K at most",
                      found.sum_rms, found.sum_worst)
                : "not known (no pixel with all its surfaces and the plane path.BAND)";
    if (found.unlisted > 0) {
        text += fmt::format("; {} pixels have surfaces that are not listed (more surfaces = N)",
                            found.unlisted);
    }
    if (found.mirrors > 0) {
        text += fmt::format("; in {} pixels the mirrored light is unchanged", found.mirrors);
    }
    if (!heat && std::abs(found.heat_estimate) >= 5e-3) {
        text += fmt::format("; effect on heat not included: about {:+.2g} K", found.heat_estimate);
    }
    return text;
}

void reshade_verb(const ReshadeArguments& a) {
    check_reshade(a);
    check_out(a);
    const RunHeat heat = load_run_heat(a.folder);
    const std::string name = a.of.find(':') == std::string::npos ? "object:" + a.of : a.of;
    const NamedGroup group = named_groups(heat, std::span(&name, 1)).front();
    ChangedFacets facets{.of_object = std::vector<std::uint8_t>(heat.field.facets, 0),
                         .warmer = {}};
    for (const std::uint32_t f : group.group.facet) facets.of_object[f] = 1;
    std::optional<TemperatureField> other;
    if (!a.heat.empty()) {
        other = load_temperature_field(a.heat);
        if (other->facets != heat.field.facets) {
            throw InputError(a.heat.string(),
                             fmt::format("found temperatures of {} facets, expected {} as in {}",
                                         other->facets, heat.field.facets, heat.file.string()));
        }
    }
    const MaterialLibrary library = default_material_library();
    SurfaceChange change{
        .emissivity = a.emissivity, .reflectance = a.reflectance, .warmer = a.warmer};
    if (!a.paint.empty()) change.paint = &library[library.find(a.paint, "--paint")];
    const std::vector<fs::path> frames = chosen_frames(a);
    std::optional<FolderLock> lock;  // creates the folder: not before a picture is understood
    for (const fs::path& file : frames) {
        const Frame frame = read_exr(file);
        if (other) {
            const std::vector<float> now = heat.field.interpolate(frame.instant);
            const std::vector<float> then = other->interpolate(frame.instant);
            facets.warmer.resize(now.size());
            for (std::size_t f = 0; f < now.size(); ++f) {
                facets.warmer[f] = float(a.heat_share) * (then[f] - now[f]);
            }
        }
        ReshadedFrame one = reshade(frame, facets, change);
        if (!lock) lock.emplace(a.out);
        const std::optional<CameraTags> camera = read_camera_tags(file);
        write_exr(a.out / file.filename(), one.frame, ExrCompression::none,
                  camera ? &*camera : nullptr);
        fmt::print("{}\n", plain(reported(file, one, bool(other))));
    }
}

}  // namespace

void add_reshade_verb(CLI::App& app) {
    const auto a = std::make_shared<ReshadeArguments>();
    CLI::App* verb = app.add_subcommand(
        "reshade", "change an object's paint, emissivity or temperature in a run's pictures");
    verb->add_option("DIR", a->folder, "folder of a run whose pictures have surfaces = N")
        ->required();
    verb->add_option("--of", a->of, "object NAME, or material:NAME, that changes")->required();
    within(verb->add_option("--emissivity", a->emissivity,
                            "new emissivity in every band; the reflectance becomes 1 minus it"),
           {0.0, 1.0});
    within(verb->add_option("--reflectance", a->reflectance,
                            "new reflectance of sun, sky and surroundings"),
           {0.0, 1.0});
    verb->add_option("--paint", a->paint,
                     "material of the library whose spectra the object takes (without gloss)");
    within(verb->add_option("--warmer", a->warmer, "added to the object's temperature"),
           {-200.0, 1000.0}, "K");
    verb->add_option("--heat", a->heat,
                     "temperatures FILE.nc of the same scene with the change (diurna solve): their "
                     "difference from the run's is added");
    within(
        verb->add_option("--heat-share", a->heat_share,
                         "share of that difference, for a smaller or larger change (default: 1)"),
        {-10.0, 10.0});
    verb->add_option("--frames", a->frames,
                     "only pictures whose file name contains this text; may be repeated");
    verb->add_option("--out", a->out, "folder for the new pictures")->required();
    verb->callback([a] { reshade_verb(*a); });
}

}  // namespace diurna
