#include "scenes/job/run/gathered_parts.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <system_error>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/run_folder.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// A folder's ledger whose every file was found whole.
std::unique_ptr<const Ledger> part_in(const fs::path& folder, const std::string& key) {
    const std::string found = ledger_key(folder);
    if (found.empty()) {
        throw InputError(folder.string(), "found no ledger.jsonl of a run",
                         "expected the folder of run --shard or run --only");
    }
    if (found != key) {
        throw InputError(
            folder.string(),
            "belongs to another scene, other settings or another version of the program",
            "merge with the program version of the run and the same --set");
    }
    auto part = std::make_unique<const Ledger>(folder, key, true);
    if (const auto& changed = part->changed(); !changed.empty()) {
        throw InputError(folder.string(),
                         fmt::format("{} changed since the run, for example {}",
                                     number_of(changed.size(), "file"), changed.front()),
                         "repeat that shard with --resume");
    }
    return part;
}

void bring(const fs::path& from, const fs::path& to) {
    if (fs::exists(to) && fs::equivalent(from, to)) return;
    fs::create_directories(to.parent_path());
    fs::remove(to);
    std::error_code problem;
    fs::create_hard_link(from, to, problem);
    if (problem) fs::copy_file(from, to);
}

}  // namespace

void gather_parts(const std::vector<fs::path>& parts, const fs::path& out, const std::string& key,
                  const std::vector<std::string>& expected) {
    std::vector<std::unique_ptr<const Ledger>> ledgers;
    std::vector<std::unique_ptr<const FolderLock>> locks;
    std::map<std::string, std::pair<std::string, fs::path>> known;  // digest and where, by name
    for (const fs::path& folder : parts) {
        if (!fs::is_directory(folder))
            throw InputError(folder.string(), "the folder does not exist");
        locks.push_back(std::make_unique<const FolderLock>(folder, true));
        ledgers.push_back(part_in(folder, key));
        for (const auto& [name, digest] : ledgers.back()->digests()) {
            const auto& [first, at] = known.try_emplace(name, digest, folder).first->second;
            if (first == digest) continue;
            throw InputError(folder.string(),
                             fmt::format("its {} differs from that of {}", name, at.string()));
        }
    }
    std::vector<std::string> missing;
    for (const std::string& name : expected) {
        if (!known.contains(name)) missing.push_back(name);
    }
    if (!missing.empty()) {
        throw InputError("merge",
                         fmt::format("{} of {} files are in none of the folders, for example {}",
                                     missing.size(), expected.size(), missing.front()),
                         "name the folders of all shards");
    }
    const FolderLock lock(out);
    for (const auto& [name, file] : known) bring(file.second / name, out / name);
    Ledger whole(out, key, false);
    for (const auto& part : ledgers) whole.take(*part);
    whole.write();
}

}  // namespace diurna
