#include "scenes/app/commands/materials_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "materials/matter/read_library.hpp"
#include "scenes/products/report/material_pages.hpp"
#include "scenes/products/report/swatch_chart.hpp"

namespace diurna {

namespace {

struct MaterialsArguments {
    std::string name;
    bool page = false, chart = false;
};

void materials_verb(const MaterialsArguments& arguments) {
    if (int{arguments.page} + int{arguments.chart} + int{!arguments.name.empty()} > 1) {
        throw InputError("diurna materials", "expected exactly one of a name, --page or --chart");
    }
    const std::filesystem::path file = data_folder() / "library.toml";
    const MaterialLibrary library = load_material_library(file);
    if (arguments.chart) {
        fmt::print("{}", swatch_chart(library));
        return;
    }
    const LibraryNotes notes = library_notes(file);
    if (arguments.page) {
        fmt::print("{}", materials_page(library, notes));
    } else if (arguments.name.empty()) {
        fmt::print("{}", materials_list(library, notes));
    } else {
        const MaterialId id = library.find(arguments.name, "diurna materials");
        fmt::print("{}", material_sheet(library[id], notes, data_folder()));
    }
}

}  // namespace

void add_materials_verb(CLI::App& app) {
    const auto a = std::make_shared<MaterialsArguments>();
    CLI::App* verb = app.add_subcommand(
        "materials", "list the material library, or print one material with its sources");
    verb->add_option("NAME", a->name, "name of a material");
    verb->add_flag("--page", a->page, "print the page materials/LIBRARY.md");
    verb->add_flag("--chart", a->chart, "print the page's chart as SVG");
    verb->callback([a] { materials_verb(*a); });
}

}  // namespace diurna
