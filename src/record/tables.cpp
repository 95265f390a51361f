#include "record/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "record/files.hpp"

namespace hibi {

namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

struct Column {
    std::string name, unit;
};

/// In double quotes where a comma or a quote would mislead a reader of CSV (RFC 4180).
std::string quoted(const std::string& name) {
    if (name.find_first_of(",\"") == std::string::npos) return name;
    std::string text = "\"";
    for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
    return text + "\"";
}

std::string header(const std::vector<Column>& columns, const std::string& comment) {
    std::vector<std::string> units, names;
    for (const Column& c : columns) {
        units.push_back(fmt::format("{} ({})", c.name, c.unit));
        names.push_back(quoted(c.name));
    }
    return fmt::format("# {}{}{}\n{}\n", fmt::join(units, ", "), comment.empty() ? "" : "; ", comment,
                       fmt::join(names, ","));
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    bool inside_quotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool doubled = inside_quotes && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
        if (doubled)
            cells.back() += line[++i];
        else if (line[i] == '"')
            inside_quotes = !inside_quotes;
        else if (line[i] == ',' && !inside_quotes)
            cells.emplace_back();
        else
            cells.back() += line[i];
    }
    return cells;
}

/// The rows of a file, as numbers by column name.
class Table {
 public:
    explicit Table(const std::filesystem::path& file) : file_(file) {
        const std::string text = read_file(file);
        int number = 0;
        for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos;
             begin = end + 1) {
            ++number;
            const std::string line = text.substr(begin, end - begin);
            if (line.starts_with('#')) continue;
            if (names_.empty())
                names_ = split(line);
            else
                add(split(line), number);
        }
        for (std::size_t c = 0; c < names_.size(); ++c) column_[names_[c]] = c;
    }

    std::size_t rows() const { return rows_.size(); }
    const std::vector<std::string>& names() const { return names_; }
    bool has(const std::string& name) const { return column_.contains(name); }
    double number(std::size_t row, const std::string& name) const {
        const auto found = column_.find(name);
        if (found == column_.end())
            throw std::runtime_error(fmt::format("{}: the column \"{}\" is missing", file_.string(), name));
        const double value = rows_[row][found->second];
        if (std::isnan(value))
            throw std::runtime_error(
                fmt::format("{}: a value of column \"{}\" is missing", file_.string(), name));
        return value;
    }
    /// Nothing where the cell is empty or the table has no such column.
    std::optional<double> optional_number(std::size_t row, const std::string& name) const {
        const auto found = column_.find(name);
        if (found == column_.end() || std::isnan(rows_[row][found->second])) return std::nullopt;
        return rows_[row][found->second];
    }
    int whole(std::size_t row, const std::string& name) const { return static_cast<int>(number(row, name)); }

 private:
    void add(const std::vector<std::string>& cells, int line) {
        if (cells.size() != names_.size())
            throw std::runtime_error(fmt::format("{}:{}: found {} columns, expected {}", file_.string(), line,
                                                 cells.size(), names_.size()));
        std::vector<double> row(cells.size());
        for (std::size_t c = 0; c < cells.size(); ++c) {
            if (cells[c].empty()) {
                row[c] = std::numeric_limits<double>::quiet_NaN();
                continue;
            }
            const char* const end = cells[c].data() + cells[c].size();
            const auto [stop, error] = std::from_chars(cells[c].data(), end, row[c]);
            if (error != std::errc() || stop != end)
                throw std::runtime_error(fmt::format("{}:{}: \"{}\" in column \"{}\" is no number",
                                                     file_.string(), line, cells[c], names_[c]));
        }
        rows_.push_back(row);
    }

    std::filesystem::path file_;
    std::vector<std::string> names_;
    std::map<std::string, std::size_t> column_;
    std::vector<std::vector<double>> rows_;
};

}  // namespace

std::string history_header(const std::vector<std::string>& load_names, int dimension,
                           const std::string& comment) {
    std::vector<Column> columns = {{"time", "s"},      {"load", "N"},     {"displacement", "m"},
                                   {"kinetic", "J"},   {"elastic", "J"},  {"contact", "J"},
                                   {"damped", "J"},    {"released", "J"}, {"work", "J"},
                                   {"imbalance", "-"}, {"broken", "-"}};
    for (int a = 0; a < dimension; ++a)
        columns.push_back({fmt::format("momentum_{}", axis_names[a]), "kg m/s"});
    for (const std::string& name : load_names) {
        columns.push_back({"load." + name, "N"});
        columns.push_back({"displacement." + name, "m"});
    }
    columns.push_back({"crack_length", "m"});
    for (int a = 0; a < dimension; ++a) columns.push_back({fmt::format("crack_tip_{}", axis_names[a]), "m"});
    columns.insert(
        columns.end(),
        {{"crack_speed", "m/s"}, {"fragments", "-"}, {"largest_fragment", "kg"}, {"debris", "kg"}});
    return header(columns, comment);
}

std::string history_line(const HistoryRow& row, int dimension) {
    std::string line =
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}", row.time, row.load, row.displacement, row.kinetic,
                    row.elastic, row.contact, row.damped, row.released, row.work, row.imbalance, row.broken);
    for (int a = 0; a < dimension; ++a) line += fmt::format(",{}", row.momentum[a]);
    for (std::size_t i = 0; i < row.loads.size(); ++i)
        line += fmt::format(",{},{}", row.loads[i], row.displacements[i]);
    line += fmt::format(",{}", row.crack.length);
    for (int a = 0; a < dimension; ++a) line += row.crack.tip ? fmt::format(",{}", (*row.crack.tip)[a]) : ",";
    line += fmt::format(",{},{},{},{}", row.crack.speed, row.fragments.count, row.fragments.largest,
                        row.fragments.debris);
    return line + "\n";
}

std::string breaks_header(int dimension, const std::string& comment) {
    std::vector<Column> columns = {{"time", "s"}, {"bond", "-"}, {"first", "-"}, {"second", "-"}};
    for (int a = 0; a < dimension; ++a) columns.push_back({axis_names[a], "m"});
    columns.push_back({"strain", "-"});
    return header(columns, comment);
}

std::string break_line(const Break& row, int dimension) {
    std::string line = fmt::format("{},{},{},{}", row.time, row.bond, row.first, row.second);
    for (int a = 0; a < dimension; ++a) line += fmt::format(",{}", row.position[a]);
    return line + fmt::format(",{}\n", row.strain);
}

History read_history(const std::filesystem::path& file) {
    const Table table(file);
    History history;
    history.dimension = table.has("momentum_z") ? 3 : 2;
    const std::string prefix = "load.";
    for (const std::string& name : table.names())
        if (name.starts_with(prefix)) history.load_names.push_back(name.substr(prefix.size()));
    for (std::size_t r = 0; r < table.rows(); ++r) {
        const auto number = [&](const std::string& name) { return table.number(r, name); };
        HistoryRow row;
        row.time = number("time");
        row.load = number("load");
        row.displacement = number("displacement");
        row.kinetic = number("kinetic");
        row.elastic = number("elastic");
        row.contact = number("contact");
        row.damped = number("damped");
        row.released = number("released");
        row.work = number("work");
        row.imbalance = number("imbalance");
        row.broken = table.whole(r, "broken");
        for (int a = 0; a < history.dimension; ++a)
            row.momentum[a] = number(fmt::format("momentum_{}", axis_names[a]));
        for (const std::string& name : history.load_names) {
            row.loads.push_back(number("load." + name));
            row.displacements.push_back(number("displacement." + name));
        }
        // Runs of earlier versions lack them.
        const auto measure = [&](const std::string& name) { return table.optional_number(r, name); };
        row.crack.length = measure("crack_length").value_or(0);
        row.crack.speed = measure("crack_speed").value_or(0);
        for (int a = 0; a < history.dimension; ++a) {
            const auto place = measure(fmt::format("crack_tip_{}", axis_names[a]));
            if (!place) continue;
            if (!row.crack.tip) row.crack.tip = Vec3::Zero();
            (*row.crack.tip)[a] = *place;
        }
        row.fragments.count = static_cast<int>(measure("fragments").value_or(0));
        row.fragments.largest = measure("largest_fragment").value_or(0);
        row.fragments.debris = measure("debris").value_or(0);
        history.rows.push_back(row);
    }
    return history;
}

std::vector<Break> read_breaks(const std::filesystem::path& file) {
    const Table table(file);
    std::vector<Break> breaks;
    for (std::size_t r = 0; r < table.rows(); ++r) {
        Break b;
        b.time = table.number(r, "time");
        b.bond = table.whole(r, "bond");
        b.first = table.whole(r, "first");
        b.second = table.whole(r, "second");
        for (int a = 0; a < 3; ++a)
            if (table.has(axis_names[a])) b.position[a] = table.number(r, axis_names[a]);
        b.strain = table.number(r, "strain");
        breaks.push_back(b);
    }
    return breaks;
}

}  // namespace hibi
