#include "materials/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "materials/base/plain_text.hpp"

namespace diurna {

namespace {

std::string joined(const std::vector<Mistake>& mistakes) {
    std::string text;
    for (const Mistake& mistake : mistakes) {
        if (!text.empty()) text += '\n';
        text += mistake.line();
    }
    return text;
}

/// Levenshtein's distance: insertions, deletions and substitutions.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string Mistake::line() const {
    return plain(where + ": " + problem + (hint.empty() ? "" : " (" + hint + ")"));
}

InputError::InputError(std::string where, std::string problem, std::string hint)
    : InputError(std::vector{Mistake{std::move(where), std::move(problem), std::move(hint)}}) {}

InputError::InputError(std::vector<Mistake> mistakes)
    : std::runtime_error(joined(mistakes)), mistakes_(std::move(mistakes)) {}

void check_within(const std::string& where, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw InputError(where, fmt::format("found {:g}, expected {:g} to {:g}", value, least, most));
}

void refuse_word(const std::string& where, std::string_view word,
                 std::span<const std::string> known) {
    throw InputError(
        where,
        fmt::format("found '{}', expected one of {}", word.substr(0, 40), fmt::join(known, " ")),
        did_you_mean(word, known));
}

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
    std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
    std::string found;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best) {
            best = distance;
            found = candidate;
        }
    }
    return found;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
    const std::string found = nearest(word, candidates);
    return found.empty() ? "" : "did you mean '" + found + "'?";
}

}  // namespace diurna
