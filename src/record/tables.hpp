#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "results/history.hpp"

namespace hibi {

/// history.csv and breaks.csv as text: a comment line with units and perhaps more, the names of the columns,
/// a line per row. Numbers have as many digits as it takes to read the same bits again.

std::string history_header(const std::vector<std::string>& load_names, int dimension,
                           const std::string& comment = {});
std::string history_line(const HistoryRow& row, int dimension);
std::string breaks_header(int dimension, const std::string& comment = {});
std::string break_line(const Break& row, int dimension);

/// Both find columns by name, so that more can be added, and leave out a last line without its end: the run
/// was killed while writing it. Throw std::runtime_error naming file and line.
History read_history(const std::filesystem::path& file);
std::vector<Break> read_breaks(const std::filesystem::path& file);

}  // namespace hibi
