#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/plain_text.hpp"
#include "materials/base/unfinished.hpp"
#include "scenes/app/commands/audit_command.hpp"
#include "scenes/app/commands/calibrate_command.hpp"
#include "scenes/app/commands/check_command.hpp"
#include "scenes/app/commands/column_command.hpp"
#include "scenes/app/commands/doctor_command.hpp"
#include "scenes/app/commands/export_command.hpp"
#include "scenes/app/commands/help_page.hpp"
#include "scenes/app/commands/inspect_command.hpp"
#include "scenes/app/commands/keys_command.hpp"
#include "scenes/app/commands/materials_command.hpp"
#include "scenes/app/commands/model_command.hpp"
#include "scenes/app/commands/movie_command.hpp"
#include "scenes/app/commands/new_command.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "scenes/app/commands/pages_command.hpp"
#include "scenes/app/commands/path_command.hpp"
#include "scenes/app/commands/raster_commands.hpp"
#include "scenes/app/commands/reshade_command.hpp"
#include "scenes/app/commands/run_command.hpp"
#include "scenes/app/commands/slurm_command.hpp"
#include "scenes/app/commands/solve_command.hpp"
#include "scenes/app/commands/study_commands.hpp"
#include "scenes/app/commands/sun_command.hpp"
#include "scenes/app/commands/verify_command.hpp"

namespace {

using namespace diurna;

enum ExitCode { done = 0, failed = 1, bad_input = 2 };

/// The verbs in the order of `diurna --help`.
constexpr void (*verbs[])(CLI::App&) = {
    add_check_verb,     add_plan_verb,   add_run_verb,   add_solve_verb,     add_render_verb,
    add_column_verb,    add_path_verb,   add_sun_verb,   add_mesh_verb,      add_visibility_verb,
    add_materials_verb, add_model_verb,  add_movie_verb, add_verify_verb,    add_keys_verb,
    add_doctor_verb,    add_study_verbs, add_new_verb,   add_calibrate_verb, add_pages_verb,
    add_inspect_verb,   add_export_verb, add_merge_verb, add_slurm_verb,     add_audit_verb,
    add_reshade_verb,
};

/// "diurna rnu ..." gets "did you mean 'run'?"; CLI11 would say only that RUN is required.
void check_first_word(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    std::vector<std::string> known;
    for (const CLI::App* verb : app.get_subcommands({})) known.push_back(verb->get_name());
    if (std::find(known.begin(), known.end(), argv[1]) != known.end()) return;
    const std::string hint = did_you_mean(argv[1], known);
    throw InputError("diurna", fmt::format("unknown verb '{}'", argv[1]),
                     hint.empty() ? fmt::format("{}", fmt::join(known, ", ")) : hint);
}

void run_program(int argc, char** argv) {
    CLI::App app(
        "diurna: temperatures of terrain scenes, and their pictures by calibrated instruments",
        "diurna");
    app.set_version_flag("--version", "diurna " DIURNA_VERSION);
    app.require_subcommand(1);
    for (const auto add_verb : verbs) add_verb(app);
    group_verbs(app);
    app.formatter(help_page());
    check_option_values(app);
    check_first_word(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            app.exit(error);  // --help and --version
            return;
        }
        throw InputError("diurna", error.what(), "see diurna --help");
    }
}

/// Where no one catches: one line, no file half done, an exit code and no core.
[[noreturn]] void end_uncaught() {
    end_at_once("diurna: out of memory, or a defect of the program\n");
}

/// GDAL and others end the program so where memory fails.
extern "C" void end_aborted(int) { end_uncaught(); }

/// Before any library begins: what they set up before main() needs memory too.
void begin() {
    std::set_terminate(end_uncaught);
    std::signal(SIGABRT, end_aborted);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const at_first)() = begin;

}  // namespace

int main(int argc, char** argv) {
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
        std::fputs("diurna: the processor lacks AVX2 and FMA, which the program requires\n",
                   stderr);
        return failed;
    }
    try {
        std::signal(SIGXFSZ, SIG_IGN);  // too large a file is an error of write(), not an end
        remove_unfinished_at_signals();
        run_program(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
            throw std::runtime_error(std::string("stdout: cannot be written: ") +
                                     std::strerror(errno));
        }
        return done;
    } catch (const InputError& error) {
        error.print(stderr);
        return bad_input;
    } catch (const std::bad_alloc&) {
        std::fputs("diurna: out of memory\n", stderr);
        return failed;
    } catch (const std::exception& error) {
        std::istringstream lines(error.what());
        for (std::string line; std::getline(lines, line);) {
            fmt::print(stderr, "diurna: {}\n", plain(line));
        }
        return failed;
    }
}
