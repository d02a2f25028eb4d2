#include "scenes/app/commands/command_pages.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

namespace diurna {

namespace {

/// Text as man(7) prints it: its backslashes, hyphens and leading dots mean nothing else.
std::string plain_roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
            out += fmt::format("\\&{}", c);
        else
            out += c;
    }
    return out;
}

/// {a,b,c} of "TEXT:{a,b,c}": the words an option chooses from; empty where it takes any.
std::vector<std::string> words_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t from = type.find('{'), to = type.find('}');
    if (from == std::string::npos || to == std::string::npos) return {};
    return CLI::detail::split(type.substr(from + 1, to - from - 1), ',');
}

/// What represents its value: "TEXT", "INT", "a|b"; empty for a flag.
std::string value_of(const CLI::Option& option) {
    if (option.get_type_size() == 0) return "";
    const std::vector<std::string> words = words_of(option);
    if (!words.empty()) return fmt::format("{}", fmt::join(words, "|"));
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}

std::string option_roff(const CLI::Option& option) {
    std::string names;
    for (const std::string& name : option.get_snames()) names += "-" + name + ", ";
    for (const std::string& name : option.get_lnames()) names += "--" + name + ", ";
    if (!names.empty()) names.erase(names.size() - 2);
    if (names.empty()) names = option.get_name();  // a positional
    const std::string value = option.get_positional() ? "" : value_of(option);
    const std::string tag =
        value.empty() ? fmt::format(".B \"{}\"", plain_roff(names))
                      : fmt::format(".BI \"{} \" \"{}\"", plain_roff(names), plain_roff(value));
    return fmt::format(".TP\n{}\n{}{}\n", tag, plain_roff(option.get_description()),
                       option.get_required() ? " (required)" : "");
}

std::vector<const CLI::Option*> options_of(const CLI::App& verb) {
    std::vector<const CLI::Option*> options = verb.get_options();
    for (const CLI::App* group : verb.get_subcommands([](const CLI::App*) { return true; })) {
        for (const CLI::Option* option : group->get_options()) {  // verbs without a name
            if (option != group->get_help_ptr()) options.push_back(option);
        }
    }
    return options;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string verb_roff(const CLI::App& verb) {
    std::string title = "diurna " + verb.get_name(), options;
    for (const CLI::Option* option : options_of(verb)) {
        if (option->get_positional()) {
            const std::string name = option->get_name();
            title += option->get_required() ? " " + name : " [" + name + "]";
        }
        if (option != verb.get_help_ptr()) options += option_roff(*option);
    }
    return fmt::format(".SS \"{}\"\n{}\n{}", plain_roff(title), plain_roff(verb.get_description()),
                       options);
}

constexpr const char* man_head = R"(.TH DIURNA 1 "" "diurna {0}" "User Commands"
.SH NAME
diurna \- thermal and diurnal terrain scenes, rendered for calibrated instruments
.SH SYNOPSIS
.B diurna
.I VERB
.RI [ options ]
.SH DESCRIPTION
From elevation data, materials, weather, objects and observers,
.B diurna
computes the temperature of every facet over one or more days and renders the pictures of instruments
between 0.35 and 20 micrometres as OpenEXR files.
.B diurna new
writes a first scene;
.B diurna keys
prints every key of a scene file.
.SH VERBS
)";

constexpr const char* man_foot = R"(.SH EXIT STATUS
.TP
.B 0
success
.TP
.B 1
failure during the run, or the solver has not converged (results are written)
.TP
.B 2
invalid input or usage; nothing was written
.SH ENVIRONMENT
.TP
.B DIURNA_DATA
folder of the material library, spectra and atmospheric tables (default: the one installed with the program)
.TP
.B DIURNA_STAGES
cache folder for the results of stages (default: ~/.cache/diurna); "off" disables the cache
.SH SEE ALSO
README.md, KEYS.md and SECURITY.md in the share/doc folder of the package.
)";

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
    std::string page = fmt::format(fmt::runtime(man_head), version);
    for (const CLI::App* verb : verbs_of(app)) page += verb_roff(*verb);
    return page + man_foot;
}

std::string bash_completion(const CLI::App& app) {
    std::string verbs, cases;
    for (const CLI::App* verb : verbs_of(app)) {
        verbs += (verbs.empty() ? "" : " ") + verb->get_name();
        std::string names, chosen;
        for (const CLI::Option* option : options_of(*verb)) {
            for (const std::string& name : option->get_lnames()) {
                names += (names.empty() ? "--" : " --") + name;
                const std::vector<std::string> words = words_of(*option);
                if (words.empty()) continue;
                chosen +=
                    fmt::format("            --{}) words=\"{}\" ;;\n", name, fmt::join(words, " "));
            }
        }
        cases += fmt::format("    {})\n        [[ $word == -* ]] && words=\"{}\"\n",
                             verb->get_name(), names);
        if (!chosen.empty())
            cases += fmt::format("        case $before in\n{}        esac\n", chosen);
        cases += "        ;;\n";
    }
    return fmt::format(R"(# Bash completion for diurna; printed by `diurna pages --bash`.
_diurna() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
    case ${{COMP_WORDS[1]}} in
{}    esac
    [ "$COMP_CWORD" -eq 1 ] && words="{} --help --version"
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _diurna diurna
)",
                       cases, verbs);
}

}  // namespace diurna
