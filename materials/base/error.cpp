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

/// At most 1000 bytes, no character of UTF-8 cut: a key or a path may be of any length.
std::string shortened(const std::string& text) {
    constexpr std::size_t most = 1000;
    if (text.size() <= most) return text;
    const auto goes_on = [&](std::size_t i) {
        return (static_cast<unsigned char>(text[i]) & 0xc0u) == 0x80u;
    };
    std::size_t head = most / 2, tail = text.size() - most / 2;
    while (head > 0 && goes_on(head)) --head;
    while (tail < text.size() && goes_on(tail)) ++tail;
    return text.substr(0, head) + " ... " + text.substr(tail);
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
    const std::string more = hint.empty() ? "" : " (" + shortened(hint) + ")";
    return plain(shortened(where) + ": " + shortened(problem) + more);
}

InputError::InputError(std::string where, std::string problem, std::string hint)
    : InputError(std::vector{Mistake{std::move(where), std::move(problem), std::move(hint)}}) {}

InputError::InputError(std::vector<Mistake> mistakes)
    : std::runtime_error(joined(mistakes)), mistakes_(std::move(mistakes)) {}

void InputError::print(std::FILE* to) const {
    const std::size_t shown = std::min(mistakes_.size(), most_mistakes_reported);
    for (std::size_t i = 0; i < shown; ++i) fmt::print(to, "{}\n", mistakes_[i].line());
    if (shown < mistakes_.size()) fmt::print(to, "and {} more\n", mistakes_.size() - shown);
}

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

std::string small_letters(std::string_view text) {
    std::string small(text);
    for (char& c : small) {
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    }
    return small;
}

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
    std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
    std::string found;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(small_letters(word), small_letters(candidate));
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
