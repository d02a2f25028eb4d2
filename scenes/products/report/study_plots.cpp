#include "scenes/products/report/study_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/products/report/page.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t largest = 8u << 20;  // of a file that a page takes in [bytes]

/// A number as it is reported, a text, or nothing.
std::string reported(const OrderedJson& of, const char* key) {
    const auto found = of.find(key);
    if (found == of.end() || found->is_null()) return "";
    if (found->is_number()) return fmt::format("{:.4g}", found->get<double>());
    return found->is_string() ? escaped(found->get<std::string>()) : escaped(found->dump());
}

std::string cells(const std::vector<std::string>& texts, const char* cell) {
    std::string out = "<tr>";
    for (const std::string& text : texts) out += fmt::format("<{0}>{1}</{0}>", cell, text);
    return out + "</tr>\n";
}

/// "2026-07-15T07:12:31-04:00" as "2026-07-15 07:12".
std::string moment(const OrderedJson& of) {
    std::string time = of.value("time", "");
    if (time.size() > 16 && time[10] == 'T') time = time.substr(0, 10) + " " + time.substr(11, 5);
    return escaped(time);
}

std::string crossover_rows(const OrderedJson& study) {
    const std::string clock = study.contains("times") ? ", " + reported(study, "times") : "";
    std::string out = cells({"band µm", "crossing" + clock, "", "warmer after", "± min",
                             "hours below " + reported(study, "threshold_K") + " K", "lowest K"},
                            "th");
    for (const OrderedJson& band : study.at("bands")) {
        const std::string hours =
            reported(band, "hours_below_threshold") + " of " + reported(band, "hours");
        if (band.at("crossings").empty()) {
            out += cells({reported(band, "band_um"), "none", "", "", "", hours,
                          reported(band, "least_contrast_K")},
                         "td");
        }
        for (const OrderedJson& one : band.at("crossings")) {
            const bool varied = one.contains("sigma_s") && one["sigma_s"].is_number();
            const double sigma = varied ? one["sigma_s"].get<double>() : 0.0;
            out += cells(
                {reported(band, "band_um"), moment(one), reported(one, "kind"),
                 reported(one, "warmer_after"), varied ? fmt::format("{:.1f}", sigma / 60.0) : "",
                 hours, reported(one, "least_K")},
                "td");
        }
    }
    return out;
}

std::string contrast_rows(const OrderedJson& study) {
    std::string out =
        cells({"target", "band µm", "from", "highest at", "RSS contrast K", "sampling change K",
               "signal to clutter", "share above " + reported(study, "threshold_K") + " K",
               "lowest at", "RSS contrast K"},
              "th");
    for (const OrderedJson& one : study.at("targets")) {
        const OrderedJson highest = one.value("highest", OrderedJson::object());
        const OrderedJson lowest = one.value("lowest", OrderedJson::object());
        out +=
            cells({reported(one, "target"), reported(one, "band_um"), reported(one, "observer"),
                   moment(highest), reported(highest, "rss_K"),
                   reported(highest, "sampling_change_K"), reported(highest, "signal_to_clutter"),
                   reported(one, "share_of_pictures_above_threshold"), moment(lowest),
                   reported(lowest, "rss_K")},
                  "td");
    }
    return out;
}

std::string ends(const OrderedJson& of, const char* key) {
    const auto found = of.find(key);
    if (found == of.end() || !found->is_object()) return "";
    return reported(*found, "least") + " to " + reported(*found, "greatest");
}

std::string signature_rows(const OrderedJson& study) {
    std::string out = cells({"time", "band µm", "projected area m²", "radiant intensity W/sr",
                             "contrast intensity W/sr"},
                            "th");
    for (const OrderedJson& one : study.at("summary")) {
        out += cells({moment(one), reported(one, "band_um"), ends(one, "projected_area_m2"),
                      ends(one, "radiant_intensity_W_sr"), ends(one, "contrast_intensity_W_sr")},
                     "td");
    }
    return out;
}

/// Ranges of the first probability, "0.5: detection 8450, recognition 2210".
std::string ranges(const OrderedJson& of, const char* key) {
    std::string out;
    const OrderedJson tasks = of.value(key, OrderedJson::object());
    for (const auto& [task, range] : tasks.items()) {
        if (!range.is_object() || range.empty() || !range.begin()->is_number()) continue;
        out += out.empty() ? escaped(range.begin().key()) + ": " : ", ";
        out += fmt::format("{} {:.0f}", escaped(task), range.begin()->get<double>());
    }
    return out;
}

std::string detection_rows(const OrderedJson& study) {
    std::string out =
        cells({"time", "contrast K", "area m²", "range of a probability by Johnson's cycles, m",
               "by the targeting task metric, m"},
              "th");
    for (const OrderedJson& one : study.at("instants")) {
        out +=
            cells({moment(one), reported(one, "rss_contrast_K"), reported(one, "projected_area_m2"),
                   ranges(one, "johnson_range_m"), ranges(one, "ttp_range_m")},
                  "td");
    }
    return out;
}

/// The answers of a kind that is known here; of others the plot has to do.
std::string answers(const OrderedJson& study) {
    const std::string kind = study.at("study");
    std::string rows;
    if (kind == "crossover") rows = crossover_rows(study);
    if (kind == "contrast") rows = contrast_rows(study);
    if (kind == "signature") rows = signature_rows(study);
    if (kind == "detection") rows = detection_rows(study);
    return rows.empty() ? "" : wide("<table class=\"figures\">\n" + rows + "</table>");
}

/// As a picture: whatever stands in the file, a browser runs nothing of it.
std::string plot(const std::string& drawing, const std::string& says) {
    return wide(fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">", says,
                            base64(std::as_bytes(std::span(drawing)))));
}

/// A line for a study of another scene, or of other settings, than the run's; else "".
std::string made_from_another(const OrderedJson& study, const std::string& heat_sha256) {
    const OrderedJson from = study.value("made_from", OrderedJson::object());
    if (from.value("heat_sha256", "") == heat_sha256) return "";
    std::string settings;
    for (const OrderedJson& one : from.value("settings", OrderedJson::array())) {
        settings += (settings.empty() ? " with " : ", ") + escaped(one.get<std::string>());
    }
    return fmt::format(
        "<p><b>Another scene or other settings</b>: computed from {}{}; its heat balance differs "
        "from this run's.</p>\n",
        escaped(from.value("scene", "an unknown scene")), settings);
}

/// One study, of NAME.json and NAME.svg; "" where these are none.
std::string study_of(const fs::path& json, const std::string& heat_sha256) {
    fs::path drawing = json;
    drawing.replace_extension(".svg");
    if (!fs::is_regular_file(drawing)) return "";
    const OrderedJson study = OrderedJson::parse(read_text(json, largest));
    if (!study.is_object() || !study.contains("study")) return "";
    const std::string kind = study.at("study"), name = study.at("name"),
                      says = escaped(kind + " " + name);
    std::string out = "<h3>" + says + "</h3>\n";
    if (kind == "crossover") {
        out += fmt::format("<p>{} and {}, seen by {}</p>\n", reported(study, "first"),
                           reported(study, "second"), reported(study, "observer"));
    }
    out += made_from_another(study, heat_sha256);
    if (study.contains("object")) out += "<p>" + reported(study, "object") + "</p>\n";
    return out + plot(read_text(drawing, largest), says) + answers(study);
}

}  // namespace

std::string study_plots(const fs::path& folder, const std::string& heat_sha256) {
    std::vector<fs::path> found;
    for (const char* inner :
         {"", "crossover", "contrast", "signature", "detection", "sensitivity", "calibrate"}) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder / inner, none)) {
            if (entry.path().extension() == ".json") found.push_back(entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    std::string out;
    for (const fs::path& json : found) {
        try {
            out += study_of(json, heat_sha256);
        } catch (const std::exception& error) {  // not JSON, of another form, too large
            out += fmt::format("<p>{} is not shown: {}</p>\n",
                               escaped(json.lexically_relative(folder).string()),
                               escaped(error.what()));
        }
    }
    if (out.empty()) return "";
    return "<h2>Studies</h2>\n<p class=\"key\">Results of earlier study commands in the run's "
           "folder; a run does not recompute them.</p>\n" +
           out;
}

}  // namespace diurna
