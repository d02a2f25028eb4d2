#include "scenes/app/commands/export_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/number_of.hpp"
#include "scenes/app/commands/printed_lines.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/store/inputs.hpp"
#include "scenes/products/export/coloured_ply.hpp"
#include "scenes/products/export/curve_csv.hpp"
#include "scenes/products/export/files_of_run.hpp"
#include "scenes/products/export/heat_raster.hpp"
#include "scenes/products/export/kmz_file.hpp"
#include "scenes/products/export/run_heat.hpp"
#include "scenes/products/export/vtu_file.hpp"

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
        throw InputError("--of", "applies to --to csv only; the other formats contain all facets");
    }
    const bool raster = a.to == "geotiff" || a.to == "kmz";
    if (raster && a.scene.empty()) {
        throw InputError(
            "--scene",
            fmt::format("is required for --to {}, which uses the raster of the scene", a.to));
    }
    if (!raster && (!a.scene.empty() || !a.settings.empty() || a.allow_outside)) {
        throw InputError("--scene, --set, --allow-outside", "apply to --to geotiff and kmz only");
    }
    if (a.to == "ply" && a.at.size() != 1) {
        throw InputError("--at",
                         fmt::format("found {} values, expected one for --to ply", a.at.size()));
    }
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
    if (const std::string note = represented_note(heat); !note.empty()) print_notes({note});
    const std::string out = a.out.string();
    std::vector<FileRead> taken = files_of_run(a.folder);
    for (FileRead& file : opened.files()) taken.push_back(std::move(file));
    if (a.to == "csv") {
        check_output_file(a.out, taken);
        const std::vector<NamedGroup> groups = named_groups(heat, a.of);
        write_whole_file(a.out, curve_csv(heat, groups, instants));
        fmt::print("{} at {}: {}\n", number_of(groups.size(), "curve"),
                   number_of(instants.size(), "instant"), out);
    } else if (a.to == "vtu") {
        const std::size_t files = write_vtu_day(a.out, heat, instants, taken);
        fmt::print("{}, {}, {}: {}\n", number_of(heat.field.facets, "facet"),
                   number_of(instants.size(), "instant"), number_of(files, "file"), out);
    } else if (a.to == "geotiff") {
        const Scene scene = read_scene(a.scene, a.settings, a.allow_outside);
        check_output_file(a.out, taken);
        check_output_file(a.out, opened.files());
        check_output_file(a.out, named_inputs(scene));
        const std::size_t posts = write_heat_geotiff(a.out, heat, scene, instants);
        fmt::print("{}, {}: {}\n", number_of(posts, "post"), number_of(instants.size(), "instant"),
                   out);
    } else if (a.to == "kmz") {
        const Scene scene = read_scene(a.scene, a.settings, a.allow_outside);
        check_output_file(a.out, taken);
        check_output_file(a.out, opened.files());
        check_output_file(a.out, named_inputs(scene));
        const ColourScale scale = write_kmz(a.out, heat, scene, instants);
        fmt::print("{}, {:g} to {:g} degC: {}\n", number_of(instants.size(), "instant"), scale.low,
                   scale.high, out);
    } else {
        check_output_file(a.out, taken);
        const ColourScale scale = write_coloured_ply(a.out, heat, heat_at(heat, instants.front()));
        fmt::print("{}, {:g} to {:g} degC: {}\n", number_of(heat.field.facets, "facet"), scale.low,
                   scale.high, out);
    }
}

}  // namespace

void add_export_verb(CLI::App& app) {
    const auto a = std::make_shared<ExportArguments>();
    CLI::App* verb =
        app.add_subcommand("export", "convert the temperatures of a run to other formats");
    verb->add_option("FOLDER", a->folder, "folder of a run")->required();
    verb->add_option("--to", a->to,
                     "csv: curves; vtu: meshes for ParaView; geotiff: ground on the scene's "
                     "raster; ply: coloured mesh; kmz: overlays for globes")
        ->required()
        ->check(CLI::IsMember({"csv", "vtu", "geotiff", "ply", "kmz"}));
    verb->add_option("--out", a->out,
                     "output file: FILE.csv, FILE.pvd (with .vtu files beside it), FILE.tif, "
                     "FILE.ply or FILE.kmz")
        ->required();
    verb->add_option(
        "--at", a->at,
        "instant; may be repeated (default: all stored instants; every hour for geotiff and kmz)");
    verb->add_option("--of", a->of,
                     "material:NAME or object:NAME; may be repeated (csv; default: all)");
    verb->add_option("--scene", a->scene, "scene file of the run (geotiff, kmz)");
    verb->add_option("--set", a->settings, "KEY=VALUE settings of the run (geotiff, kmz)");
    verb->add_flag(
        "--allow-outside", a->allow_outside,
        "permit input files outside the scene's folder and the program's data (geotiff, kmz)");
    verb->callback([a] { export_verb(*a); });
}

}  // namespace diurna
