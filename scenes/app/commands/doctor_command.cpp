#include "scenes/app/commands/doctor_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "materials/air/profile.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/base/parallel.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"

namespace diurna {

namespace {

void doctor_verb() {
    const auto has = [](bool there) { return there ? "yes" : "no"; };
    fmt::print("diurna            {}\ncompiler          g++ {}\n", DIURNA_VERSION, __VERSION__);
    fmt::print("libraries         {}\n", DIURNA_LIBRARIES);
    fmt::print("AVX2, FMA         {}, {} (required)\n", has(__builtin_cpu_supports("avx2")),
               has(__builtin_cpu_supports("fma")));
    fmt::print("AVX-512           {}\n", has(__builtin_cpu_supports("avx512f")));
    fmt::print("threads           {}\n", thread_count());
    const std::filesystem::path data = data_folder();
    fmt::print("data              {} ({})\n", data.string(),
               std::filesystem::is_directory(data)
                   ? "found"
                   : "missing: set DIURNA_DATA to the program's data folder");
    fmt::print("materials         {}\n", fmt::join(default_material_library().names(), " "));
    fmt::print("profiles          {}\n", fmt::join(afgl_profile_names(), " "));
    fmt::print("aerosols          {}\n", fmt::join(aerosol_names(), " "));
}

}  // namespace

void add_doctor_verb(CLI::App& app) {
    app.add_subcommand("doctor", "print versions, processor features, threads and data folders")
        ->callback(doctor_verb);
}

}  // namespace diurna
