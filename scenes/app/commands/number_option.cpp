#include "scenes/app/commands/number_option.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <string_view>

#include "materials/base/csv.hpp"

namespace diurna {

namespace {

std::string expected(Range range, const std::string& unit) {
    const std::string behind = unit.empty() ? "" : " " + unit;
    const bool below = std::isfinite(range.least), above = std::isfinite(range.most);
    if (below && above) return fmt::format("{:g} to {:g}{}", range.least, range.most, behind);
    if (below) return fmt::format("{:g}{} or more", range.least, behind);
    if (above) return fmt::format("{:g}{} or less", range.most, behind);
    return "a finite number" + (unit.empty() ? "" : fmt::format(" [{}]", unit));
}

/// A check that adds nothing to the help page.
CLI::Option* checked(CLI::Option* option, std::function<std::string(std::string&)> check) {
    return option->check(CLI::Validator(std::move(check), ""));
}

bool has_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// Of an option's type, which CLI11 gives with the checks behind it: "FLOAT:NONNEGATIVE".
bool is_number(const std::string& type) {
    return type.starts_with("FLOAT") || type.starts_with("INT") || type.starts_with("UINT");
}

/// A finite number, its sign written or not.
bool read_number(std::string_view text, double& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return parse_number(text, value);
}

}  // namespace

CLI::Option* within(CLI::Option* option, Range range, const std::string& unit) {
    return checked(option, [range, unit](const std::string& text) {
        double value = 0.0;
        const bool number = read_number(text, value);
        if (number && value >= range.least && value <= range.most) return std::string();
        return fmt::format("found '{}', expected {}", text.substr(0, 40), expected(range, unit));
    });
}

CLI::Option* whole_within(CLI::Option* option, int least, int most) {
    return checked(option, [least, most](const std::string& text) {
        double value = 0.0;
        const bool number = read_number(text, value) && value == std::floor(value) &&
                            text.find_first_not_of("+-0123456789") == std::string::npos;
        if (number && value >= least && value <= most) return std::string();
        return fmt::format("found '{}', expected a whole number from {} to {}", text.substr(0, 40),
                           least, most);
    });
}

void check_option_values(CLI::App& app) {
    for (CLI::App* verb : app.get_subcommands({})) {
        for (CLI::Option* option : verb->get_options()) {
            if (!has_value(*option)) continue;
            if (is_number(option->get_type_name())) within(option, {});
            checked(option, [](const std::string& text) {
                return text.find_first_not_of(" \t") == std::string::npos
                           ? std::string("found an empty value, expected a value")
                           : std::string();
            });
        }
    }
}

}  // namespace diurna
