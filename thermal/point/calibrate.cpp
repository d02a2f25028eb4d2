#include "thermal/point/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "thermal/point/point_job_file.hpp"
#include "thermal/point/run_column.hpp"

namespace diurna {

namespace {

constexpr double coldest_measured = 30.0,
                 hottest_measured = 3000.0;  // [K] that may have been measured
constexpr double close = 0.95;               // of correlations

double temperature_of(const PointRow& row, const Calibration& asked) {
    if (asked.depth > 0.0) return row.depth_temperature;
    switch (asked.of) {
        case MeasuredOf::back:
            return row.back_temperature;
        case MeasuredOf::ground:
            return row.ground_temperature;
        case MeasuredOf::leaf:
            return row.leaf_temperature;
        case MeasuredOf::surface:
            break;
    }
    return row.surface_temperature;
}

std::size_t value_column(const CsvTable& table, const std::string& asked) {
    if (!asked.empty()) return table.column(asked);
    if (table.header.size() != 2) {
        throw InputError(table.path.string(), fmt::format("has {} columns", table.header.size()),
                         "calibrate.column selects the measured one");
    }
    return 1 - table.column("time");
}

void read_curve(const PointJob& job, CalibrationReport& report) {
    const CsvTable table = read_csv(report.asked.file);
    const std::size_t time = table.column("time"),
                      column = value_column(table, report.asked.column);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const Instant when = parse_instant(table.rows[r][time], table.where(r, time));
        const std::string& cell = table.rows[r][column];
        if (cell.empty() || cell == "nan" || cell == "NaN") {
            ++report.missing;
            continue;
        }
        const double kelvin = report.asked.factor * table.number(r, column) + report.asked.zero;
        if (kelvin < coldest_measured || kelvin > hottest_measured) {
            throw InputError(
                table.where(r, column),
                fmt::format("found {} (which is {:.4g} K), expected a temperature", cell, kelvin),
                "calibrate.unit is the unit of the measurement: K, degC, degF");
        }
        if (when < job.start || when > job.end) {
            ++report.beyond;
            continue;
        }
        if (!report.when.empty() && when <= report.when.back()) {
            throw InputError(table.where(r, time), "is not later than the previous row");
        }
        report.when.push_back(when);
        report.measured.push_back(kelvin);
    }
    if (report.measured.size() <= report.asked.sought.size()) {
        throw InputError(report.asked.file.string(),
                         fmt::format("has {} values from {} to {}, too few for {} parameters",
                                     report.measured.size(), format_instant(job.start),
                                     format_instant(job.end), report.asked.sought.size()),
                         "time.start and end must include the measurement");
    }
}

/// The column's temperature at the instants of what was measured.
std::vector<double> column_at_instants(const PointJob& job, const PointResult& result,
                                       const CalibrationReport& report) {
    std::vector<double> values;
    for (const Instant when : report.when) {
        const double place = seconds_between(job.start, when) / job.step;
        const std::size_t left = std::min(std::size_t(std::max(0.0, place)), result.row.size() - 2);
        values.push_back(std::lerp(temperature_of(result.row[left], report.asked),
                                   temperature_of(result.row[left + 1], report.asked),
                                   std::clamp(place - double(left), 0.0, 1.0)));
    }
    return values;
}

/// Layers may be among what is sought: of every column that is run.
void check_of(const PointResult& result, const Calibration& asked) {
    if (asked.depth > result.depth.back()) {
        throw InputError(asked.where,
                         fmt::format("depth_m = {:g}, but the column's deepest node is at {:.4g} m",
                                     asked.depth, result.depth.back()));
    }
    const bool there = asked.of == MeasuredOf::surface ||
                       (asked.of == MeasuredOf::back ? result.has_back : result.has_canopy);
    if (there) return;
    throw InputError(asked.where,
                     asked.of == MeasuredOf::back
                         ? "of = \"back\", but the material has no exposed back"
                         : "of = \"ground\" or \"leaf\", but the material has no canopy");
}

void tell(CalibrationReport& report) {
    const Fit& fit = report.fit;
    const auto& sought = report.asked.sought;
    if (report.beyond > 0) {
        report.notes.push_back(
            fmt::format("{} outside the span skipped", number_of(report.beyond, "measured value")));
    }
    if (report.missing > 0) {
        report.notes.push_back(fmt::format(
            "{} missing", number_of(report.missing, "measured value is", "measured values are")));
    }
    if (fit.independent < 0.9 * double(report.measured.size())) {
        report.notes.push_back(
            fmt::format("residuals are autocorrelated ({:.2f} between neighbours): {} values count "
                        "as {:.0f}, and intervals are {:.1f} times as wide as for independent ones",
                        fit.alike, report.measured.size(), fit.independent,
                        std::sqrt(double(report.measured.size()) / fit.independent)));
    }
    for (std::size_t i = 0; i < sought.size(); ++i) {
        if (fit.number[i].at_bound) {
            report.notes.push_back(fmt::format(
                "{} is at its bound {:g}: the measurement requires {}, or another value is wrong",
                sought[i].key, fit.number[i].value,
                fit.number[i].value > sought[i].low ? "more" : "less"));
        } else if (fit.number[i].least < sought[i].low || fit.number[i].most > sought[i].high) {
            report.notes.push_back(
                fmt::format("the interval of {} extends beyond {:g} to {:g}: the measurement "
                            "determines it poorly",
                            sought[i].key, sought[i].low, sought[i].high));
        }
        for (std::size_t j = 0; j < i; ++j) {
            const double r = fit.correlation[i][j];
            if (std::abs(r) < close) continue;
            report.notes.push_back(fmt::format(
                "{} and {} cannot be separated (correlation {:+.3f}): fit only one of them",
                sought[j].key, sought[i].key, r));
        }
    }
}

}  // namespace

CalibrationReport calibrate(const std::filesystem::path& file,
                            const std::vector<std::string>& settings, bool allow_outside) {
    return calibrate(file.string(), [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = settings;
        all.insert(all.end(), more.begin(), more.end());
        return read_column_job(file, allow_outside, all);
    });
}

CalibrationReport calibrate(const std::string& file, const ColumnWith& column_with) {
    const auto job_with = [&](std::span<const double> numbers,
                              const std::vector<SoughtNumber>& sought) {
        std::vector<std::string> all;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            all.push_back(fmt::format("{}={:.17g}", sought[i].key, numbers[i]));
        }
        return column_with(all);
    };
    const PointJob as_it_is = job_with({}, {});
    if (!as_it_is.calibrate) {
        throw InputError(file, "no table [calibrate], expected one");
    }
    CalibrationReport report{.asked = *as_it_is.calibrate, .when = {}, .measured = {}, .fit = {}};
    const auto& sought = report.asked.sought;
    read_curve(as_it_is, report);
    LeastSquares problem{
        .model = {}, .measured = report.measured, .start = {}, .low = {}, .high = {}};
    for (const SoughtNumber& number : sought) {
        problem.start.push_back(number.start);
        problem.low.push_back(number.low);
        problem.high.push_back(number.high);
    }
    for (const std::vector<double>& ends : {problem.start, problem.low, problem.high}) {
        for (std::size_t i = 0; i < sought.size(); ++i) {
            std::vector<double> numbers = problem.start;
            numbers[i] = ends[i];
            try {
                job_with(numbers, sought);
            } catch (const InputError& error) {
                const Mistake& found = error.mistakes().front();
                throw InputError(sought[i].where,
                                 fmt::format("{} = {:g}: {}: {}", sought[i].key, ends[i],
                                             found.where, found.problem),
                                 found.hint);
            }
        }
    }
    problem.model = [&](std::span<const double> numbers) {
        const PointJob job = job_with(numbers, sought);
        const PointResult result = run_column(job);
        check_of(result, report.asked);
        report.heat_converged &= result.converged;
        return column_at_instants(job, result, report);
    };
    report.fit = fit(problem);
    for (std::size_t i = 0; i < sought.size(); ++i) {
        if (!report.fit.number[i].idle) continue;
        throw InputError(sought[i].where,
                         fmt::format("\"{}\" has no effect on the curve", sought[i].key));
    }
    tell(report);
    return report;
}

}  // namespace diurna
