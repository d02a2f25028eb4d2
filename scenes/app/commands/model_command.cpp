#include "scenes/app/commands/model_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/number_of.hpp"
#include "terrain/objects/models/models.hpp"
#include "terrain/objects/obj_file.hpp"

namespace diurna {

namespace {

struct ModelArguments {
    std::string name, detail = "medium";
    std::filesystem::path out;
};

void list_models() {
    fmt::print("{:<20} {:>7} {:>7} {:>7}  {:<22} {}\n", "model", "low", "medium", "high",
               "x, y, z [m]", "description");
    for (const std::string& name : model_names()) {
        std::string line = fmt::format("{:<20}", name);
        Eigen::AlignedBox3d box;
        for (const Detail detail : {Detail::low, Detail::medium, Detail::high}) {
            const MeshFile mesh = model_mesh(name, detail);
            line += fmt::format(" {:>7}", mesh.triangle.size());
            for (const Eigen::Vector3d& v : mesh.vertex) box.extend(v);
        }
        const Eigen::Vector3d size = box.sizes();
        fmt::print("{}  {:<22} {}\n", line,
                   fmt::format("{:.2f} {:.2f} {:.2f}", size.x(), size.y(), size.z()),
                   model_line(name));
    }
}

void model_verb(const ModelArguments& arguments) {
    if (arguments.name.empty()) {
        if (!arguments.out.empty())
            throw InputError("diurna model", "--out needs the name of a model");
        list_models();
        return;
    }
    static const std::map<std::string, Detail> details{
        {"low", Detail::low}, {"medium", Detail::medium}, {"high", Detail::high}};
    const auto detail = details.find(arguments.detail);
    if (detail == details.end()) {
        throw InputError("diurna model", fmt::format("found --detail '{}', expected low, medium "
                                                     "or high",
                                                     arguments.detail));
    }
    const MeshFile mesh = model_mesh(arguments.name, detail->second);
    if (arguments.out.empty()) throw InputError("diurna model", "missing --out FILE.obj");
    if (arguments.out.extension() != ".obj") {
        throw InputError("diurna model", fmt::format("found --out '{}', expected a name that ends "
                                                     "in .obj",
                                                     arguments.out.string()));
    }
    std::filesystem::path parts = arguments.out;
    parts.replace_extension(".parts.toml");
    check_output_file(arguments.out);
    check_output_file(parts);
    write_obj(arguments.out, mesh,
              fmt::format("{}: {}; {} detail", arguments.name, model_line(arguments.name),
                          arguments.detail));
    write_whole_file(parts, read_text(model_part_file(arguments.name)));
    fmt::print("{} in {}: {}, {}\n", number_of(mesh.triangle.size(), "triangle"),
               number_of(mesh.part.size(), "part"), arguments.out.string(), parts.string());
}

}  // namespace

void add_model_verb(CLI::App& app) {
    const auto a = std::make_shared<ModelArguments>();
    CLI::App* verb =
        app.add_subcommand("model", "list the built-in object models, or write one as OBJ");
    verb->add_option("NAME", a->name, "name of a model");
    verb->add_option("--detail", a->detail, "level of detail: low, medium or high");
    verb->add_option("--out", a->out, "OBJ file; NAME.parts.toml is written beside it");
    verb->callback([a] { model_verb(*a); });
}

}  // namespace diurna
