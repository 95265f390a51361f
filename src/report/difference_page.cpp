#include "report/difference_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/html.hpp"
#include "report/page_files.hpp"

namespace hibi {

namespace {

constexpr int tile_zoom = 8;

std::string picture(const char* name, const std::string& png, const std::string& alternative) {
    return fmt::format("<img class=\"{}\" alt=\"{}\" draggable=\"false\" src=\"{}\">\n", name,
                       escaped(alternative), data_uri("image/png", png));
}

std::string pictures_html(const DifferencePage::Pictures& p) {
    std::string text;
    if (!p.name.empty()) text += fmt::format("<h2>{}</h2>\n", escaped(p.name));
    // A small picture is shown larger, or nothing would be seen of it.
    const int wide = p.width < 640 ? 2 * p.width : p.width;
    text += fmt::format(
        "<div class=\"view\" id=\"view\" data-mode=\"slider\" style=\"--split: 50%; --wide: {}px\">\n", wide);
    text += picture("expected", p.expected, "Expected picture") +
            picture("actual", p.actual, "Actual picture") +
            picture("heat", p.heat, "Where they differ, the brighter the more");
    text +=
        "<span class=\"edge\"></span><span class=\"tag left\">expected</span><span class=\"tag "
        "right\">actual</span>\n</div>\n<div class=\"bar\">\n";
    for (const auto& [mode, words] :
         {std::pair("slider", "Slider"), std::pair("flicker", "Flicker"), std::pair("heat", "Heat map")})
        text += fmt::format("<button type=\"button\" data-mode-of=\"{}\">{}</button>\n", mode, words);
    text +=
        "<input type=\"range\" id=\"split\" min=\"0\" max=\"100\" step=\"0.5\" value=\"50\" "
        "aria-label=\"Border between expected, left, and actual, right\">\n</div>\n";
    const auto& [x, y, w, h] = p.tile;
    if (w == 0) return text;
    text +=
        fmt::format("<h2>Worst tile, {} × {} pixels at ({}, {})</h2>\n<div class=\"tiles\">\n", w, h, x, y);
    for (const char* of : {"expected", "actual", "heat"})
        text += fmt::format(
            "<figure><canvas width=\"{0}\" height=\"{1}\" data-of=\"{2}\" data-tile=\"{3} {4} {5} {6}\" "
            "role=\"img\" aria-label=\"Worst tile: {2}\"></canvas><figcaption>{2}</figcaption></figure>\n",
            tile_zoom * w, tile_zoom * h, of, x, y, w, h);
    return text + "</div>\n";
}

std::string table_html(const DifferenceTable& table) {
    std::string text = fmt::format("<h2>{}</h2>\n", escaped(table.title));
    if (!table.note.empty()) text += fmt::format("<p class=\"faint\">{}</p>\n", escaped(table.note));
    if (table.rows.empty()) return text;
    const bool limited =
        std::ranges::any_of(table.rows, [](const DifferenceRow& r) { return !r.limit.empty(); });
    text += "<div class=\"scroll\"><table>\n";
    if (limited)
        text +=
            "<thead><tr><th scope=\"col\"></th><th scope=\"col\">Measured</th><th "
            "scope=\"col\">Limit</th></tr>"
            "</thead>\n";
    text += "<tbody>\n";
    for (const DifferenceRow& row : table.rows)
        text += fmt::format("<tr{}><th scope=\"row\">{}</th><td>{}</td>{}</tr>\n",
                            row.holds.value_or(true) ? "" : " class=\"wrong\"", escaped(row.name),
                            escaped(row.value), limited ? "<td>" + escaped(row.limit) + "</td>" : "");
    return text + "</tbody></table></div>\n";
}

}  // namespace

std::string difference_page(const DifferencePage& c) {
    std::string page = page_head(
        c.title,
        {.title = c.title, .version = HIBI_VERSION, .scene_hash = {}, .parameters = {}, .command = {}},
        difference_style);
    page += fmt::format(
        "<header><div><h1>{}</h1>\n<p class=\"faint\">expected {} · actual "
        "{}</p>\n</div>{}</header>\n<main>\n",
        escaped(c.title), escaped(c.expected_name), escaped(c.actual_name), theme_button());
    page +=
        fmt::format("<p class=\"outcome {}\">{}</p>\n", c.differs ? "differs" : "same", escaped(c.verdict));
    if (c.pictures) page += pictures_html(*c.pictures);
    for (const DifferenceTable& table : c.tables) page += table_html(table);
    page += fmt::format("</main>\n<footer>hibi {}</footer>\n", HIBI_VERSION);
    page += fmt::format("<script>\n{}</script>\n</body>\n</html>\n", difference_script);
    return page;
}

}  // namespace hibi
