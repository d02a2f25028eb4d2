#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/modtran/deck.hpp"
#include "materials/modtran/tape7.hpp"

namespace diurna {

/// A MODTRAN 5 program, which reads `tape5` in its working folder and writes `tape7` there.
///
/// executable  absolute path, from the command line or DIURNA_MODTRAN; never from a scene file
struct ModtranRunner {
    std::filesystem::path executable;
    std::filesystem::path data;  // MODTRAN_DATA of its environment; empty: not set
    std::chrono::milliseconds time_limit{600'000};
    std::uintmax_t output_limit = 512u << 20;  // bytes, all files of its folder together
};

/// From the command line, else the environment's DIURNA_MODTRAN; nothing if neither is set. Throws
/// InputError for a name that is not the absolute path of an executable file.
std::optional<ModtranRunner> modtran_runner(const std::string& command_line_word);

/// Runs the program on a tape5 in a new temporary folder that is removed afterwards: no shell, its
/// own process group, empty standard input, discarded standard output, an environment of only PATH,
/// LANG and MODTRAN_DATA. Returns the text of its tape7.
/// Throws std::runtime_error if it fails, takes longer or writes more than allowed (it and its
/// children are then killed), or leaves no result.
std::string run_modtran(const ModtranRunner& runner, const std::string& tape5);

/// Runs the decks as one tape5 and reads the result: one run of its tape7 per deck, in order.
/// Throws also std::runtime_error if the numbers of runs differ, InputError for a damaged tape7.
std::vector<Tape7Run> run_decks(const ModtranRunner& runner, const std::vector<ModtranDeck>& decks);

}  // namespace diurna
