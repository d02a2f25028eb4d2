#include "scenes/app/commands/study_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "materials/base/parallel.hpp"
#include "scenes/app/commands/printed_lines.hpp"
#include "scenes/app/commands/scene_arguments.hpp"
#include "scenes/studies/asked_studies.hpp"

namespace diurna {

namespace {

struct StudyArguments {
    std::filesystem::path temperatures, out;
};

void study_verb(const StudyKind& kind, const SceneArguments& a, const StudyArguments& own) {
    set_thread_count(a.threads);
    const std::filesystem::path out = own.out.empty() ? "." : own.out;
    std::vector<std::string> settings = a.settings;
    take_rounds(own.temperatures, settings);
    const StudyFindings found = kind.find({.scene = a.scene,
                                           .settings = settings,
                                           .allow_outside = a.allow_outside,
                                           .temperatures = own.temperatures,
                                           .out = out,
                                           .progress = a.style()});
    tell(found, out);
}

}  // namespace

void tell(const StudyFindings& found, const std::filesystem::path& out) {
    print_notes(found.notes);
    for (const StudyFinding& one : found.finding) {
        fmt::print("{}{}{}\n", one.reported, (out / one.name).string(), one.texts.endings());
        print_notes(one.notes);
    }
    if (!found.not_converged.empty()) throw std::runtime_error(found.not_converged);
}

void add_study_verbs(CLI::App& app) {
    for (const StudyKind& kind : study_kinds()) {
        CLI::App* verb = app.add_subcommand(kind.word, kind.says);
        const auto a = scene_arguments(*verb);
        const auto own = std::make_shared<StudyArguments>();
        own->out = kind.word;
        if (kind.temperatures != nullptr) {
            verb->add_option("--temperatures", own->temperatures, kind.temperatures);
        }
        verb->add_option("--out", own->out,
                         fmt::format("folder for the results (default: {})", kind.word));
        verb->callback([&kind, a, own] { study_verb(kind, *a, *own); });
    }
}

}  // namespace diurna
