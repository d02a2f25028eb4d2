#include "scenes/commands/signature_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/commands/scene_arguments.hpp"
#include "scenes/commands/told_lines.hpp"
#include "scenes/studies/signature_files.hpp"
#include "scenes/studies/study_files.hpp"

namespace diurna {

namespace {

void signature_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                    const std::filesystem::path& out) {
    Study study(a.read(), a.style());
    const Scene& scene = study.scene();
    if (scene.signatures.empty()) {
        throw InputError(scene.file.string(), "no table [[signature]], expected one at least");
    }
    std::vector<StudiedObject> studied;
    std::vector<std::string> names;
    for (const SignatureInput& input : scene.signatures) {
        studied.push_back(input.studied);
        names.push_back(input.name);
    }
    check_study_files(out, names, scene.files);
    const TemperatureField field = study.heat(temperatures, studied);
    const double offset = scene.time.utc_offset;
    std::vector<SignatureReport> reports;
    for (const SignatureInput& input : scene.signatures) {
        reports.push_back(signature_of(study.stages(), input, field, study.progress()));
    }
    study.progress().finish();
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const SignatureInput& input = scene.signatures[i];
        const SignatureReport& report = reports[i];
        std::vector<std::string> own = study.notes();
        own.push_back(fmt::format("{} of {} directions lie below the level, where the ground is",
                                  report.below, input.directions));
        if (input.range == 0.0) {
            own.emplace_back(
                "rays begin just beyond the sphere around it: the air of some metres "
                "is before it");
        }
        if (report.hidden > 0) {
            own.push_back(fmt::format("nothing of it is seen in {} rows", report.hidden));
        }
        if (report.alone > 0) {
            own.push_back(fmt::format("no background is seen in {} rows: their contrast is empty",
                                      report.alone));
        }
        const std::filesystem::path base = out / input.name;
        write_study_files(out, input.name,
                          {.csv = signature_csv(report, offset),
                           .json = signature_json(input, report, own, offset),
                           .svg = signature_svg(input, report, offset)});
        fmt::print("{}: {} rows: {}.csv, .json, .svg\n", input.name, report.rows.size(),
                   base.string());
        print_notes(own);
    }
    if (!study.not_converged().empty()) throw std::runtime_error(study.not_converged());
}

}  // namespace

void add_signature_verb(CLI::App& app) {
    CLI::App* verb = app.add_subcommand(
        "signature", "radiant and contrast intensity of objects in every direction: [[signature]]");
    const auto a = scene_arguments(*verb);
    const auto temperatures = std::make_shared<std::filesystem::path>();
    const auto out = std::make_shared<std::filesystem::path>("signature");
    verb->add_option("--temperatures", *temperatures,
                     "netCDF file of `solve`; else they are solved");
    verb->add_option("--out", *out, "folder for the results (default: signature)");
    verb->callback([a, temperatures, out] { signature_verb(*a, *temperatures, *out); });
}

}  // namespace diurna
