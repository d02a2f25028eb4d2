#include "scenes/app/sweep/run_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/app/sweep/checked_folder.hpp"
#include "scenes/app/sweep/merged_labels.hpp"
#include "scenes/app/sweep/records.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/plan/memory_limit.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/shard.hpp"
#include "scenes/job/run/frames.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/heat_report.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/listed_outputs.hpp"
#include "scenes/job/run/radiometers.hpp"
#include "scenes/job/run/run_folder.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/store/digest.hpp"
#include "scenes/job/store/heat_content.hpp"
#include "scenes/job/store/inputs.hpp"
#include "scenes/job/world/stepping.hpp"
#include "scenes/products/labels/label_frames.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Variants of one heat, and what they share.
struct Group {
    const Sweep& sweep;
    const SweepOptions& options;
    std::span<const Variant> variants;
    std::string key;  // of all that their temperatures depend on

    fs::path folder() const { return heat_folder(options.out, variants.front().heat); }
    std::string key_of(const Variant& variant) const {
        std::string text = key + variant.name;
        const std::vector<SweepAxis>& axes = sweep.base.sweep.axes;
        for (std::size_t a = 0; a < axes.size(); ++a) {
            for (const std::string& value : axes[a].values[variant.choice[a]]) {
                text.append(1, '\n').append(value);
            }
        }
        return sha256(text);
    }
    /// Those that an earlier run has not left whole.
    std::vector<const Variant*> pending() const {
        std::vector<const Variant*> left;
        for (const Variant& variant : variants) {
            const VariantRecord record =
                read_variant_record(variant_folder(options.out, variant.name));
            const bool kept = options.resume && record.done && record.key == key_of(variant) &&
                              is_whole(variant_folder(options.out, variant.name), record.outputs);
            if (!kept) left.push_back(&variant);
        }
        return left;
    }
};

/// Of what the variants of a heat share: the scene's files, the settings, the values that touch
/// heat.
std::string heat_key(const Sweep& sweep, const Variant& variant) {
    return job_key(run_inputs(heat_scene_of(sweep, variant)), heat_settings(sweep, variant));
}

void tell_once(std::vector<std::string>& notes, const std::string& note) {
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

void tell(const SweptHeat& record, const std::string& heat, SweepReport& report) {
    if (!record.not_converged.empty()) {
        report.not_converged.push_back(fmt::format("heat {}: {}", heat, record.not_converged));
    }
    for (const std::string& note : record.notes) tell_once(report.notes, note);
}

/// A heat of the sweep, already solved, whose scene has the same content (heat_content): its
/// record and temperatures at the same instants. Not where states, fluxes or radiometers are
/// written, which are not stored with it.
struct EqualHeat {
    SweptHeat record;
    TemperatureField field;
};
std::optional<EqualHeat> equal_heat(const Group& group, const Prepared& prepared,
                                    const std::string& content) {
    const OutputInput& output = prepared.scene.output;
    if (output.state || output.fluxes || !prepared.radiometers.empty()) return std::nullopt;
    if (!prepared.movement.none()) return std::nullopt;
    std::set<std::string> heats;
    for (const Variant& variant : group.sweep.variants) heats.insert(variant.heat);
    for (const std::string& heat : heats) {
        const fs::path folder = heat_folder(group.options.out, heat);
        SweptHeat record = read_heat_record(folder);
        if (record.content != content || folder == group.folder()) continue;
        if (!is_whole(folder, {{"temperatures.nc", record.sha256}})) continue;
        TemperatureField field = load_temperature_field(folder / "temperatures.nc");
        if (field.instant != scene_span(prepared.scene).wanted) continue;
        return EqualHeat{std::move(record), std::move(field)};
    }
    return std::nullopt;
}

/// Temperatures of a group: kept, or taken from a heat of equal content, or solved; and written.
TemperatureField temperatures(const Group& group, const Stages& stages, Progress& progress,
                              SweepReport& report) {
    const fs::path folder = group.folder(), file = folder / "temperatures.nc";
    SweptHeat record = read_heat_record(folder);
    std::optional<TemperatureField> field;
    if (group.options.resume && record.key == group.key && !record.sha256.empty() &&
        is_whole(folder, {{"temperatures.nc", record.sha256}})) {
        field = load_temperature_field(file);
    } else {
        fs::create_directories(folder);
        fs::remove(folder / "done.json");
        const Prepared& prepared = stages.scene();
        const std::string content = heat_content(prepared);
        const std::vector<RunInput> inputs = run_inputs(prepared.scene);
        std::optional<EqualHeat> equal = equal_heat(group, prepared, content);
        SpanResult result;
        if (equal) {
            record = std::move(equal->record);
            result.temperature = std::move(equal->field);
            progress.stage(StageId::write_temperatures);
            write_heat(prepared, inputs, result, file);
        } else {
            result = solve_scene(stages, progress);
            progress.stage(StageId::write_temperatures);
            write_heat(prepared, inputs, result, file);
            HeatReport reported = heat_report(prepared, result);
            write_radiometers(stages, result, folder, reported);
            record = {"", "", reported.start, reported.not_converged, reported.notes, content};
            ++report.solved;
        }
        record.key = group.key;
        record.sha256 = sha256_of_file(file);
        write_heat_record(folder, record);
        field = std::move(result.temperature);
    }
    tell(record, group.variants.front().heat, report);
    return std::move(*field);
}

/// Pictures and labels of one variant, and its record.
void run_variant(const Group& group, const Variant& variant, const Stages& stages,
                 const TemperatureField& field, Progress& progress, SweepReport& report) {
    const Prepared& prepared = stages.scene();
    const fs::path folder = variant_folder(group.options.out, variant.name);
    VariantRecord record{.key = group.key_of(variant), .done = false, .outputs = {}};
    const FolderLock lock(folder);
    const std::vector<std::string> pictures =
        frame_files(prepared.scene.observers, prepared.scene.labels.format);
    Ledger ledger(folder, record.key, group.options.resume);
    std::set<std::string> keep{"variant.json"};
    for (const auto& [name, digest] : ledger.digests()) keep.insert(name);
    std::vector<std::string> known = recorded_files(read_variant_record(folder));
    known.insert(known.end(), pictures.begin(), pictures.end());
    clear_run_folder(folder, keep, known);
    ledger.write(pictures);
    for (const char* inner : {"frames", "images", "labels", "kitti", "kitti/calib"}) {
        fs::create_directories(folder / inner);
    }
    write_variant_record(folder, group.sweep, variant, record);
    FramesReport frames =
        render_frames(stages, prepared.scene.observers, field, folder, progress, ledger);
    for (const std::string& note : frames.warnings) tell_once(report.notes, note);
    record.notes = std::move(frames.notes);
    progress.stage(StageId::labels, variant.name);
    for (const std::string& file : label_frames(prepared, folder)) {
        record.outputs[file] = sha256_of_file(folder / file);
    }
    for (const std::string& file : pictures) record.outputs[file] = sha256_of_file(folder / file);
    record.done = true;
    write_variant_record(folder, group.sweep, variant, record);
    fs::remove(folder / ledger_file);  // the record has it all
}

/// A variant's scene stands; what is wrong with it is reported with its name.
Prepared prepare_variant(const Sweep& sweep, const Variant& variant, double max_memory) {
    try {
        Prepared prepared = prepare(scene_of(sweep, variant));
        check_memory(prepared.plan, max_memory);
        check_start(prepared);
        return prepared;
    } catch (const InputError& error) {
        std::vector<Mistake> mistakes = error.mistakes();
        for (Mistake& mistake : mistakes) {
            mistake.problem += fmt::format(" (in variant {})", variant.name);
        }
        throw InputError(std::move(mistakes));
    }
}

/// Temperatures of another variant of the heat serve this one: same facets, and all its instants
/// among those kept, for what lies between is not solved for.
void check_shared(const Variant& variant, const Prepared& prepared, const TemperatureField& field) {
    const bool facets = field.facets == prepared.world.surfaces().size();
    const std::vector<Instant> wanted = scene_span(prepared.scene).wanted;
    const bool instants = std::all_of(wanted.begin(), wanted.end(), [&](Instant when) {
        return std::binary_search(field.instant.begin(), field.instant.end(), when);
    });
    if (facets && instants) return;
    throw std::runtime_error(
        fmt::format("variant {} has other {} than the variants that it shares temperatures with",
                    variant.name, facets ? "instants of pictures" : "facets"));
}

void run_group(Group group, Progress& progress, SweepReport& report) {
    group.key = heat_key(group.sweep, group.variants.front());
    const std::vector<const Variant*> pending = group.pending();
    report.kept += group.variants.size() - pending.size();
    for (const Variant& variant : group.variants) {
        const bool kept = std::find(pending.begin(), pending.end(), &variant) == pending.end();
        // One that was killed when all was written except for this.
        if (kept) fs::remove(variant_folder(group.options.out, variant.name) / ledger_file);
    }
    if (pending.empty()) {
        tell(read_heat_record(group.folder()), group.variants.front().heat, report);
        return;
    }
    progress.stage(StageId::named, fmt::format("heat {}: terrain", group.variants.front().heat));
    const Prepared first = prepare_variant(group.sweep, *pending.front(), group.options.max_memory);
    for (const std::string& note : first.notes) tell_once(report.notes, note);
    if (!group.sweep.base.uncertain.empty()) {
        tell_once(report.notes,
                  "uncertain values: variants of a sweep get no planes sigma.BAND; diurna run "
                  "--only base makes them for the scene itself");
    }
    progress.stage(StageId::sky_view);
    const Stages stages(first);
    stages.at(0);
    const TemperatureField field = temperatures(group, stages, progress, report);
    for (const Variant* variant : pending) {
        std::optional<Prepared> other;
        std::optional<Stages> others;
        if (variant != pending.front()) {
            progress.stage(StageId::named, fmt::format("variant {}: terrain", variant->name));
            other.emplace(prepare_variant(group.sweep, *variant, group.options.max_memory));
            others.emplace(*other, stages);
        }
        const Stages& own = others ? *others : stages;
        check_shared(*variant, own.scene(), field);
        run_variant(group, *variant, own, field, progress, report);
        ++report.rendered;
    }
}

/// Manifest and labels of the whole, once every variant is there.
void merge(const Sweep& sweep, const SweepOptions& options, SweepReport& report) {
    Group group{sweep, options, {}, ""};
    for (const Variant& variant : sweep.variants) {
        if (group.variants.empty() || group.variants.front().heat != variant.heat) {
            group.variants = {&variant, 1};
            group.key = heat_key(sweep, variant);
        }
        const VariantRecord record = read_variant_record(variant_folder(options.out, variant.name));
        report.missing += record.done && record.key == group.key_of(variant) ? 0 : 1;
    }
    if (report.missing > 0) return;
    MergedLabels labels = merge_labels(sweep, options.out);
    for (std::string& note : labels.notes) report.notes.push_back(std::move(note));
    std::map<std::string, std::string> outputs;
    for (const std::string& file : labels.files) {
        outputs[file] = sha256_of_file(options.out / file);
    }
    write_sweep_manifest(options.out, sweep, outputs);
}

}  // namespace

SweepReport run_sweep(const Sweep& sweep, const SweepOptions& options) {
    check_sweep_folder(options.out, paths_of(run_inputs(sweep.base)), !options.shard.all());
    const FolderLock lock(options.out, !options.shard.all());
    SweepReport report;
    Progress progress(options.progress);
    const ShardRange part = range_of(options.shard, sweep.variants.size());  // few heats in two
    const std::span<const Variant> all(sweep.variants);
    for (std::size_t first = part.first; first < part.last;) {
        std::size_t last = first;
        while (last < part.last && all[last].heat == all[first].heat) ++last;
        run_group({sweep, options, all.subspan(first, last - first), ""}, progress, report);
        first = last;
    }
    progress.stage(StageId::labels, "all variants");
    merge(sweep, options, report);
    progress.finish();
    return report;
}

}  // namespace diurna
