#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenes/app/sweep/variants.hpp"

/// Progress records in a sweep's folder: a file written when a variant or a common heat balance is
/// done. Whole or not at all, so that an interrupted sweep can continue.
namespace diurna {

/// "heat/h2/done.json"
struct SweptHeat {
    std::string key;     // of all inputs
    std::string sha256;  // of its temperatures.nc
    std::string start, not_converged;
    std::vector<std::string> notes;
    std::string content{};  // heat_content() of its scene
};
/// "variants/v07/variant.json"
struct VariantRecord {
    std::string key;
    bool done = false;                           // else its pictures are being rendered
    std::map<std::string, std::string> outputs;  // SHA-256 by name, relative to its folder
    std::vector<std::string> notes{};            // messages of its pictures
};

std::filesystem::path heat_folder(const std::filesystem::path& out, const std::string& heat);
std::filesystem::path variant_folder(const std::filesystem::path& out, const std::string& variant);

/// Empty if there is none.
SweptHeat read_heat_record(const std::filesystem::path& folder);
VariantRecord read_variant_record(const std::filesystem::path& folder);
/// Names of its outputs.
std::vector<std::string> recorded_files(const VariantRecord& record);

void write_heat_record(const std::filesystem::path& folder, const SweptHeat& record);
/// With the variant's values.
void write_variant_record(const std::filesystem::path& folder, const Sweep& sweep,
                          const Variant& variant, const VariantRecord& record);

/// "manifest.json" of the whole: axes, variants with their values, folders and outputs, heats. The
/// same bytes for any division of the work.
void write_sweep_manifest(const std::filesystem::path& out, const Sweep& sweep,
                          const std::map<std::string, std::string>& outputs);

}  // namespace diurna
