#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hibi {

/// One line of a table on the page.
struct DifferenceRow {
    std::string name, value, limit;  ///< limit may be empty
    std::optional<bool> holds{};     ///< nothing: it decides nothing
};
struct DifferenceTable {
    std::string title, note;  ///< note may be empty
    std::vector<DifferenceRow> rows;
};

/// Everything a page of a comparison shows. Pictures are bytes, since the page is one file.
struct DifferencePage {
    std::string title;
    std::string verdict;  ///< in one line
    bool differs = false;
    std::string expected_name, actual_name;
    struct Pictures {
        std::string name;                    ///< of the frame; may be empty
        std::string expected, actual, heat;  ///< PNG, of one size
        int width = 0, height = 0;
        std::array<int, 4> tile{};  ///< x, y, width, height of the worst tile; no width: none
    };
    std::optional<Pictures> pictures{};
    std::vector<DifferenceTable> tables;
};

/// One offline HTML page: both pictures under a slider or flickering, heat map, the worst tile
/// enlarged, and all numbers. Light and dark. It asks nothing of a network.
std::string difference_page(const DifferencePage& content);

}  // namespace hibi
