#include "scenes/app/commands/help_page.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "scenes/studies/asked_studies.hpp"

namespace diurna {

namespace {

struct VerbGroup {
    const char* title;
    std::vector<const char*> verbs;
};

const std::vector<VerbGroup>& verb_groups() {
    std::vector<const char*> studies;
    for (const StudyKind& kind : study_kinds()) studies.push_back(kind.word);
    static const std::vector<VerbGroup> groups{
        {"Prepare a scene", {"new", "inspect", "keys", "materials", "model", "check", "plan"}},
        {"Compute", {"run", "solve", "render", "slurm", "merge"}},
        {"Study a scene", studies},
        {"Use results", {"audit", "verify", "export", "reshade", "movie"}},
        {"Single calculations", {"column", "calibrate", "path", "sun", "mesh", "visibility"}},
        {"Installation", {"doctor", "pages"}},
    };
    return groups;
}

class HelpPage : public CLI::Formatter {
 public:
    std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
        std::string page = fmt::format(
            "{}\n\nUsage: diurna VERB [OPTIONS]    options of a verb: diurna VERB --help    "
            "version: diurna --version\n",
            app->get_description());
        for (const VerbGroup& group : verb_groups()) {
            page += fmt::format("{}:\n", group.title);
            for (const char* name : group.verbs) {
                page += fmt::format("  {:<12} {}\n", name,
                                    app->get_subcommand(name)->get_description());
            }
        }
        return page;
    }
};

}  // namespace

void group_verbs(CLI::App& app) {
    for (const VerbGroup& group : verb_groups()) {
        for (const char* name : group.verbs) app.get_subcommand(name)->group(group.title);
    }
}

std::shared_ptr<CLI::FormatterBase> help_page() { return std::make_shared<HelpPage>(); }

}  // namespace diurna
