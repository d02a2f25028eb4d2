#include "scenes/app/sweep/checked_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/unfinished.hpp"
#include "scenes/app/sweep/records.hpp"
#include "scenes/job/run/listed_outputs.hpp"
#include "scenes/job/run/run_folder.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Of a folder, ascending by name; none if it does not exist. Temporary files are skipped.
std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
    std::vector<fs::directory_entry> all;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        if (!is_temporary_name(entry.path().filename().string())) all.push_back(entry);
    }
    std::sort(all.begin(), all.end());
    return all;
}

[[noreturn]] void refuse(const fs::path& out, const fs::path& file) {
    throw InputError("--out",
                     fmt::format("{} holds {}, which was not written by an earlier run of a sweep",
                                 out.string(), file.lexically_relative(out).string()),
                     "remove it, or choose another folder");
}

/// The folders in "variants" or "heat".
std::vector<fs::path> parts_of(const fs::path& out, const char* group) {
    std::vector<fs::path> folders;
    for (const auto& entry : entries_of(out / group)) {
        if (!entry.is_directory() || entry.is_symlink()) refuse(out, entry.path());
        folders.push_back(entry.path());
    }
    return folders;
}

/// Refuses a variant's folder without a record or a ledger that holds files, and other files
/// among its pictures and labels.
void check_variant(const fs::path& out, const fs::path& folder) {
    if (!fs::exists(folder / "variant.json") && !is_listed(folder)) {
        std::error_code none;
        for (const auto& entry : fs::recursive_directory_iterator(folder, none)) {
            if (!entry.is_directory()) refuse(out, entry.path());
        }
    }
    const auto check = [&] {
        check_clearable(folder, recorded_files(read_variant_record(folder)));
    };
    try {
        check();
    } catch (const InputError&) {
        check();  // another shard may just have put its record in the place of its ledger
    }
}

bool is_netcdf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string head(4, '\0');
    stream.read(head.data(), std::streamsize(head.size()));
    return head.starts_with("CDF") || head == "\x89HDF";
}

/// Only the files of a heat balance may be there; a killed one leaves no record.
void check_heat(const fs::path& out, const fs::path& folder) {
    for (const auto& entry : entries_of(folder)) {
        const std::string name = entry.path().filename().string();
        const bool own = name == "done.json" || name.starts_with("radiometer_") ||
                         (name == "temperatures.nc" && is_netcdf(entry.path()));
        if (!own) refuse(out, entry.path());
    }
}

}  // namespace

void check_sweep_folder(const fs::path& out, const std::vector<fs::path>& inputs, bool shared) {
    check_run_folder(out, FolderKind::sweep);
    check_not_in_use(out, shared);
    check_no_input_in(out, inputs);
    for (const fs::path& folder : parts_of(out, "variants")) check_variant(out, folder);
    for (const fs::path& folder : parts_of(out, "heat")) check_heat(out, folder);
}

}  // namespace diurna
