#include "scenes/commands/export_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/export/coloured_ply.hpp"
#include "scenes/export/curve_csv.hpp"
#include "scenes/export/heat_raster.hpp"
#include "scenes/export/kmz_file.hpp"
#include "scenes/export/run_heat.hpp"
#include "scenes/export/vtu_file.hpp"
#include "scenes/input/scene_file.hpp"

namespace diurna {

namespace {

struct ExportArguments {
    std::filesystem::path folder, out, scene;
    std::string to;
    std::vector<std::string> at, of, settings;
    bool allow_outside = false;
};

void check_arguments(const ExportArguments& a) {
    if (!a.of.empty() && a.to != "csv") {
        throw InputError("--of", "is for --to csv: other kinds hold all facets");
    }
    const bool raster = a.to == "geotiff" || a.to == "kmz";
    if (raster && a.scene.empty()) {
        throw InputError("--scene",
                         fmt::format("is needed for --to {}: its raster is the scene's", a.to));
    }
    if (!raster && (!a.scene.empty() || !a.settings.empty() || a.allow_outside)) {
        throw InputError("--scene, --set, --allow-outside", "are for --to geotiff and kmz");
    }
    if (a.to == "ply" && a.at.size() != 1) {
        throw InputError("--at", fmt::format("found {}, expected one for --to ply", a.at.size()));
    }
}

/// What a scene names, though it is not opened here.
std::vector<FileRead> files_named_in(const Scene& scene) {
    std::vector<FileRead> files;
    for (const auto& file : scene.weather.files) files.push_back({.path = file});
    for (const ObjectInput& object : scene.terrain.objects) {
        files.push_back({.path = object.file});
        files.push_back({.path = object.copies_file});
    }
    return files;
}

void export_verb(const ExportArguments& a) {
    check_arguments(a);
    const FilesRead opened;
    const RunHeat heat = load_run_heat(a.folder);
    std::vector<Instant> instants = asked_instants(heat, a.at);
    if (instants.empty()) {
        const bool hourly = a.to == "geotiff" || a.to == "kmz";
        instants = hourly ? every_hour(heat) : heat.field.instant;
    }
    const std::string out = a.out.string();
    if (a.to == "csv") {
        check_output_file(a.out, opened.files());
        const std::vector<NamedGroup> groups = named_groups(heat, a.of);
        write_whole_file(a.out, curve_csv(heat, groups, instants));
        fmt::print("{} curves of {} instants: {}\n", groups.size(), instants.size(), out);
    } else if (a.to == "vtu") {
        const std::size_t files = write_vtu_day(a.out, heat, instants, opened.files());
        fmt::print("{} facets, {} instants, {} files: {}\n", heat.field.facets, instants.size(),
                   files, out);
    } else if (a.to == "geotiff") {
        const Scene scene = read_scene(a.scene, a.settings, a.allow_outside);
        check_output_file(a.out, opened.files());
        check_output_file(a.out, files_named_in(scene));
        const std::size_t posts = write_heat_geotiff(a.out, heat, scene, instants);
        fmt::print("{} posts, {} instants: {}\n", posts, instants.size(), out);
    } else if (a.to == "kmz") {
        const Scene scene = read_scene(a.scene, a.settings, a.allow_outside);
        check_output_file(a.out, opened.files());
        check_output_file(a.out, files_named_in(scene));
        const ColourScale scale = write_kmz(a.out, heat, scene, instants);
        fmt::print("{} instants, {:g} to {:g} degC: {}\n", instants.size(), scale.low, scale.high,
                   out);
    } else {
        check_output_file(a.out, opened.files());
        const ColourScale scale = write_coloured_ply(a.out, heat, heat_at(heat, instants.front()));
        fmt::print("{} facets, {:g} to {:g} degC: {}\n", heat.field.facets, scale.low, scale.high,
                   out);
    }
}

}  // namespace

void add_export_verb(CLI::App& app) {
    const auto a = std::make_shared<ExportArguments>();
    CLI::App* verb = app.add_subcommand("export", "a run's temperatures for other programs");
    verb->add_option("FOLDER", a->folder, "of a run")->required();
    verb->add_option("--to", a->to,
                     "csv curves; vtu meshes for ParaView; geotiff the ground on the scene's "
                     "raster; ply a coloured mesh; kmz overlays for globes")
        ->required()
        ->check(CLI::IsMember({"csv", "vtu", "geotiff", "ply", "kmz"}));
    verb->add_option("--out", a->out,
                     "FILE.csv, FILE.pvd (with .vtu beside it), FILE.tif, FILE.ply, "
                     "FILE.kmz")
        ->required();
    verb->add_option(
        "--at", a->at,
        "an instant, may be repeated (default: all kept ones; of geotiff and kmz every hour)");
    verb->add_option("--of", a->of,
                     "material:NAME or object:NAME, may be repeated (csv; default: all)");
    verb->add_option("--scene", a->scene, "the run's scene file (geotiff, kmz)");
    verb->add_option("--set", a->settings, "key=value, as the run had it (geotiff, kmz)");
    verb->add_flag("--allow-outside", a->allow_outside,
                   "read files beside the scene that lie elsewhere (geotiff, kmz)");
    verb->callback([a] { export_verb(*a); });
}

}  // namespace diurna
