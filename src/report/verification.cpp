#include "report/verification.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.hpp"
#include "report/html.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;

/// Errors below are rounding, whatever the spacing.
constexpr double rounding = 1e-11;

Json value_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class T>
Json value_or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// With the sign of what was measured less the reference.
std::string error_text(const VerifyRow& row) {
    return (row.measured < row.reference ? "−" : "+") + percent(row.error);
}

}  // namespace

std::optional<bool> VerifyRow::pass() const {
    if (!goal) return {};
    return failure.empty() && error <= *goal;
}

double VerifyRow::particle_steps_per_second() const {
    return method == "explicit" && solve_seconds > 0 ? particles * static_cast<double>(steps) / solve_seconds
                                                     : 0;
}

std::optional<double> observed_order(const std::vector<VerifyRow>& rows, const std::string& id,
                                     const std::string& variant) {
    std::vector<std::array<double, 2>> points;
    bool shrinks = false;
    for (const VerifyRow& row : rows)
        if (row.id == id && row.variant == variant && row.failure.empty() && row.error > 0) {
            points.push_back({std::log(row.spacing), std::log(row.error)});
            shrinks |= row.error > rounding;
        }
    if (points.size() < 2 || !shrinks) return {};
    std::array<double, 2> mean{};
    for (const auto& p : points)
        for (int k = 0; k < 2; ++k) mean[k] += p[k] / static_cast<double>(points.size());
    double across = 0, along = 0;
    for (const auto& p : points) {
        across += (p[0] - mean[0]) * (p[1] - mean[1]);
        along += (p[0] - mean[0]) * (p[0] - mean[0]);
    }
    if (!(along > 0)) return {};
    return across / along;
}

namespace {

const char* verdict_word(const VerifyRow& row) {
    if (!row.failure.empty()) return "failed";
    const std::optional<bool> pass = row.pass();
    return !pass ? "-" : *pass ? "pass" : "MISSED";
}

/// Rows of a case and variant stand together: is this the first of them, and the last?
bool begins_group(const std::vector<VerifyRow>& rows, std::size_t k) {
    return k == 0 || rows[k].id != rows[k - 1].id || rows[k].variant != rows[k - 1].variant;
}

std::string order_text(const std::vector<VerifyRow>& rows, const VerifyRow& row) {
    const std::optional<double> order = observed_order(rows, row.id, row.variant);
    if (order) return fmt::format("{:.1f}", *order);
    return row.failure.empty() && row.error <= rounding ? "rounding" : "-";
}

std::string speed_text(const VerifyRow& row) {
    return row.method == "static" ? "static" : fmt::format("{:.2f}", row.particle_steps_per_second() / 1e6);
}

const std::vector<std::string>& table_head() {
    static const std::vector<std::string> head{"case",    "variant", "resolution", "particles",
                                               "error",   "goal",    "",           "order",
                                               "seconds", "CPU",     "Mp-steps/s"};
    return head;
}

std::vector<std::string> cells_of(const std::vector<VerifyRow>& rows, std::size_t k) {
    const VerifyRow& row = rows[k];
    const bool first = begins_group(rows, k);
    return {first ? row.id : "",
            first ? row.variant : "",
            fmt::format("{} = {:g}", row.parameter, row.resolution),
            fmt::format("{}", row.particles),
            row.failure.empty() ? error_text(row) : row.failure,
            row.goal ? percent(*row.goal) : "-",
            verdict_word(row),
            first ? order_text(rows, row) : "",
            fmt::format("{:.2f}", row.seconds),
            fmt::format("{:.2f}", row.cpu_seconds),
            speed_text(row)};
}

}  // namespace

std::string verification_table(const std::vector<VerifyRow>& rows) {
    std::vector<std::vector<std::string>> lines{table_head()};
    for (std::size_t k = 0; k < rows.size(); ++k) lines.push_back(cells_of(rows, k));
    std::vector<std::size_t> widths(table_head().size());
    for (const auto& line : lines)
        for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
    std::string text;
    for (const auto& line : lines) {
        std::string row;
        for (std::size_t c = 0; c < line.size(); ++c)
            row += c < 3 || c == 6 ? fmt::format("{:<{}}  ", line[c], widths[c])
                                   : fmt::format("{:>{}}  ", line[c], widths[c]);
        text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string verification_json(const std::vector<VerifyRow>& rows) {
    Json list = Json::array();
    for (const VerifyRow& row : rows)
        list.push_back({{"case", row.id},
                        {"variant", row.variant},
                        {"particles", row.particles},
                        {"resolution", row.resolution},
                        {"error", row.failure.empty() ? value_or_null(row.error) : Json(nullptr)},
                        {"goal", value_or_null(row.goal)},
                        {"seconds", row.seconds},
                        {"pass", value_or_null(row.pass())},
                        {"title", row.title},
                        {"scene", row.scene},
                        {"parameter", row.parameter},
                        {"spacing", row.spacing},
                        {"quantity", row.quantity},
                        {"unit", row.unit},
                        {"measured", value_or_null(row.measured)},
                        {"reference", value_or_null(row.reference)},
                        {"order", value_or_null(observed_order(rows, row.id, row.variant))},
                        {"method", row.method},
                        {"steps", row.steps},
                        {"solve_seconds", row.solve_seconds},
                        {"cpu_seconds", row.cpu_seconds},
                        {"particle_steps_per_second", row.particle_steps_per_second()},
                        {"failure", row.failure.empty() ? Json(nullptr) : Json(row.failure)}});
    return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string verification_csv(const std::vector<VerifyRow>& rows, const std::string& comment) {
    std::string text = fmt::format(
        "# seconds (s), error and goal (-), spacing (m; of factor: -), measured and reference in unit; {}\n"
        "case,variant,parameter,resolution,spacing,particles,method,steps,quantity,unit,measured,reference,"
        "error,"
        "goal,pass,"
        "order,seconds,solve_seconds,cpu_seconds,particle_steps_per_second,failure\n",
        comment);
    for (const VerifyRow& row : rows) {
        const std::optional<bool> pass = row.pass();
        const std::optional<double> order = observed_order(rows, row.id, row.variant);
        std::string failure = row.failure;
        std::ranges::replace(failure, ',', ';');
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.id, row.variant,
            row.parameter, row.resolution, row.spacing, row.particles, row.method, row.steps, row.quantity,
            row.unit, row.measured, row.reference, row.error, row.goal ? fmt::format("{}", *row.goal) : "",
            pass ? (*pass ? "true" : "false") : "", order ? fmt::format("{}", *order) : "", row.seconds,
            row.solve_seconds, row.cpu_seconds, row.particle_steps_per_second(), failure);
    }
    return text;
}

std::string verification_verdict(const std::vector<VerifyRow>& rows) {
    int goals = 0;
    std::vector<std::string> missed;
    for (const VerifyRow& row : rows) {
        const std::optional<bool> pass = row.pass();
        if (!pass) continue;
        ++goals;
        if (!*pass) missed.push_back(fmt::format("{} at {} = {:g}", row.id, row.parameter, row.resolution));
    }
    if (goals == 0) return "No goals.";
    if (missed.empty()) return fmt::format("All {} goals reached.", goals);
    return fmt::format("{} of {} goals missed: {}.", missed.size(), goals, fmt::join(missed, ", "));
}

std::vector<Chart> speed_charts(const std::vector<VerifyRow>& rows) {
    std::vector<Chart> charts;
    std::vector<std::string> ids;  // of the lines of the last chart, in their colours
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const VerifyRow& row = rows[k];
        if (charts.empty() || charts.back().title != row.group) {
            charts.push_back({.title = row.group,
                              .x = {.title = "Time of a run", .unit = "s", .logarithmic = true},
                              .y = {.title = "Error", .unit = "", .logarithmic = true}});
            ids.clear();
        }
        Chart& chart = charts.back();
        if (begins_group(rows, k)) {
            if (std::ranges::find(ids, row.id) == ids.end()) ids.push_back(row.id);
            const auto colour = std::ranges::find(ids, row.id) - ids.begin();
            const bool thesis = row.variant == "thesis";
            chart.lines.push_back({.label = thesis ? "" : row.title,
                                   .colour = static_cast<int>(colour),
                                   .points = true,
                                   .dashed = thesis});
            if (thesis) chart.note = "Dashed: the thesis variant.";
        }
        if (!row.failure.empty()) continue;
        chart.lines.back().x.push_back(row.seconds);
        chart.lines.back().y.push_back(row.error);
    }
    std::erase_if(charts, [](const Chart& chart) {
        return std::ranges::none_of(chart.lines, [](const ChartLine& line) { return !line.x.empty(); });
    });
    return charts;
}

namespace {

std::string row_html(const std::vector<VerifyRow>& rows, std::size_t k) {
    const VerifyRow& row = rows[k];
    const bool thesis = row.variant == "thesis";
    const std::optional<bool> pass = row.pass();
    const auto cell = [](const std::string& text, const char* kind = "") {
        return fmt::format("<td{}>{}</td>", *kind ? fmt::format(" class=\"{}\"", kind) : "", escaped(text));
    };
    const char* begin = thesis ? "<tr class=\"thesis\">" : "<tr>";
    const std::string order = order_text(rows, row);
    std::string text;
    if (begins_group(rows, k))
        text += fmt::format(
            "{}<th scope=\"rowgroup\" colspan=\"7\" class=\"words\">{}{} <span>· {}</span></th></tr>\n",
            begin, escaped(row.title), thesis ? ", thesis variant" : "",
            order == "rounding" ? "rounding alone" : "order " + order);
    text += begin + cell(fmt::format("{} = {:g}", row.parameter, row.resolution), "words");
    text += row.failure.empty() ? cell(error_text(row)) : cell(row.failure, "missed");
    text += cell(row.goal ? percent(*row.goal) : "");
    text += !pass ? cell("") : *pass ? cell("reached", "reached") : cell("missed", "missed");
    text += cell(format_si(row.seconds, "s"));
    text += cell(fmt::format("{}", row.particles));
    text += cell(speed_text(row));
    return text + "</tr>\n";
}

std::string case_list(const std::vector<VerifyRow>& rows) {
    std::string text =
        "<div class=\"scroll\"><table class=\"compared\">\n<thead><tr><th scope=\"col\">Case</th><th "
        "scope=\"col\">Compared"
        "</th><th scope=\"col\">With</th><th scope=\"col\">Scene</th></tr></thead>\n<tbody>\n";
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k > 0 && rows[k].id == rows[k - 1].id) continue;
        text += fmt::format(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>hibi new --from {}</td></tr>\n",
            escaped(rows[k].title), escaped(rows[k].quantity), escaped(rows[k].reference_text),
            escaped(rows[k].scene));
    }
    return text + "</tbody></table></div>\n";
}

}  // namespace

std::string verification_page(const std::vector<VerifyRow>& rows, const VerifyConditions& conditions,
                              const Provenance& provenance) {
    const bool good = std::ranges::all_of(
        rows, [](const VerifyRow& row) { return row.failure.empty() && row.pass().value_or(true); });
    std::string page = page_head("Verification", provenance);
    page +=
        "<header><div><h1>Accuracy and speed</h1>\n<p class=\"faint\">Experiments whose answers are known, "
        "at "
        "several resolutions: how far the program is off, and how long it takes.</p></div>" +
        theme_button() + "</header>\n<main>\n";
    page += fmt::format("<p class=\"verdict{}\"><strong>{}</strong></p>\n", good ? "" : " bad",
                        escaped(verification_verdict(rows)));
    page += "<section class=\"charts pairs\" aria-label=\"Error over time\">\n";
    for (const Chart& chart : speed_charts(rows))
        page += "<figure class=\"chart\">" + chart_in_both_themes(chart, 100) + "</figure>\n";
    page +=
        "</section>\n<h2>All runs</h2>\n<div class=\"scroll\"><table class=\"verification\">\n<thead><tr>"
        "<th scope=\"col\" class=\"words\">Resolution</th>";
    for (const char* name : {"Error", "Goal", "", "Time", "Particles", "10⁶ particle-steps/s"})
        page += fmt::format("<th scope=\"col\">{}</th>", name);
    page += "</tr></thead>\n<tbody>\n";
    for (std::size_t k = 0; k < rows.size(); ++k) page += row_html(rows, k);
    page +=
        "</tbody></table></div>\n<p class=\"faint\">Order: the slope of error over spacing, both "
        "logarithmic; 2 means "
        "that half the spacing leaves a quarter of the error; where the error changes its sign it says "
        "little. "
        "The thesis variant has no goals.</p>\n";
    page += "<h2>What is compared</h2>\n" + case_list(rows);
    page += fmt::format(
        "<h2>How it was made</h2>\n<p>The runs were made one after the other, each with {} thread{}; models "
        "of fewer than "
        "4096 particles use one. Time is that of a whole run: reading the scene, building it, and all steps. "
        "Where the method is static, equilibrium is solved for; the thesis variant comes to rest in damped "
        "motion instead. "
        "In all "
        "{}{}.</p>\n",
        conditions.threads, conditions.threads == 1 ? "" : "s", format_si(conditions.seconds, "s"),
        conditions.quick ? ", with the coarse resolutions alone" : "");
    page += fmt::format("<div class=\"command\"><pre>{}</pre></div>\n</main>\n<footer>hibi {}</footer>\n",
                        escaped(provenance.command), escaped(provenance.version));
    page +=
        "<script>\nconst root = document.documentElement;\n"
        "document.getElementById('theme').addEventListener('click',\n"
        "  () => { root.dataset.theme = root.dataset.theme === 'dark' ? 'light' : 'dark'; });\n"
        "</script>\n</body>\n</html>\n";
    return page;
}

}  // namespace hibi
