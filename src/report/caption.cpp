#include "report/caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/units.hpp"
#include "report/place.hpp"

namespace hibi {

namespace {

/// Where a set of particles is: a whole edge is named by its side.
std::string place_of(const Extent& body, const Topology& topology, const std::vector<int>& particles) {
    Vec3 middle = Vec3::Zero();
    for (const int i : particles)
        middle += topology.reference_position[i] / static_cast<double>(particles.size());
    return place_in(body, middle);
}

std::string direction_words(const Vec3& d) {
    if (std::abs(d.y()) >= std::abs(d.x())) return d.y() < 0 ? "downwards" : "upwards";
    return d.x() < 0 ? "to the left" : "to the right";
}

std::string replaced(std::string text, const std::map<char, std::string>& by) {
    std::string result;
    for (const char c : text) {
        const auto found = by.find(c);
        result += found == by.end() ? std::string(1, c) : found->second;
    }
    return result;
}

/// Characters that Markdown would take for its own.
std::string markdown_escaped(const std::string& text) {
    std::map<char, std::string> by;
    for (const char c : std::string("\\`*_{}[]<>#|$~^@&")) by[c] = std::string("\\") + c;
    return replaced(text, by);
}

std::string quoted(const std::string& text) { return replaced(text, {{'"', "\\\""}, {'\\', "\\\\"}}); }

}  // namespace

Caption caption_of(const RunSummary& s, const Topology& topology, const std::string& about,
                   const std::string& description) {
    Caption c;
    const auto sentence = [](std::string& to, const std::string& text) {
        to += (to.empty() ? "" : " ") + text + (text.ends_with('.') ? "" : ".");
    };
    const Events& e = s.events;
    const bool loaded = e.peak_load.has_value();
    const auto under = [&](const Event& event) {
        return loaded ? " under " + format_si(event.load, "N") : std::string();
    };
    sentence(c.text, s.title);
    if (!about.empty()) sentence(c.text, about);
    sentence(c.text, description);
    if (e.first_break)
        sentence(c.text, fmt::format("The first bond breaks at t = {}{}", format_si(e.first_break->time, "s"),
                                     under(*e.first_break)));
    if (e.separation)
        sentence(c.text, fmt::format("The body separates at t = {}{}", format_si(e.separation->time, "s"),
                                     under(*e.separation)));
    if (!e.first_break) sentence(c.text, "No bond breaks");
    sentence(c.text, fmt::format("Energy balance within {:.2g} %", 100 * s.worst_imbalance));
    if (s.stopped)
        sentence(c.text, "The run stopped early, so it is not to be trusted");
    else if (!s.trusted)
        sentence(c.text, "This run is not to be trusted");
    sentence(c.text,
             fmt::format("Computed and drawn by hibi {}, scene {}", s.version, s.scene_hash.substr(0, 12)));

    const Extent body = extent_of(topology);
    const Vec3 size =
        body.high - body.low + Vec3::Constant(topology.spacing.empty() ? 0 : topology.spacing.front());
    sentence(c.alternative,
             fmt::format("A body {} wide and {} high, drawn as {} discs", format_si(size.x(), "m", 3, true),
                         format_si(size.y(), "m", 3, true), s.particles));
    for (const Support& support : topology.supports)
        sentence(
            c.alternative,
            fmt::format("It {} {}", support.axes[0] && support.axes[1] ? "is clamped" : "runs on rollers",
                        place_of(body, topology, support.particles)));
    for (const LoadMark& load : topology.loads)
        sentence(c.alternative,
                 fmt::format("It is {} {} {}",
                             load.kind == "force" || load.kind == "pressure" ? "loaded" : "moved",
                             direction_words(load.direction), place_of(body, topology, load.particles)));
    if (!topology.notches.empty())
        sentence(c.alternative,
                 fmt::format("It has a cut {}",
                             place_in(body, (topology.notches[0][0] + topology.notches[0][1]) / 2)));
    if (e.first_break)
        sentence(c.alternative,
                 fmt::format("The first bond breaks {}, at {}; {} of {} bonds are broken in the end{}",
                             part_of(body, e.first_break->position), place_text(e.first_break->position),
                             s.broken, s.bonds,
                             e.separation ? ", and the body is in pieces" : ""));
    return c;
}

std::string caption_markdown(const Caption& c, const std::string& title) {
    return fmt::format("# {}\n\n## Caption\n\n{}\n\n## Alternative text\n\n{}\n", markdown_escaped(title),
                       markdown_escaped(c.text), markdown_escaped(c.alternative));
}

std::string latex_escaped(const std::string& text) {
    std::string result = replaced(text, {{'<', "\\textless{}"},
                                         {'>', "\\textgreater{}"},
                                         {'|', "\\textbar{}"},
                                         {'"', "\\textquotedbl{}"},
                                         {'\n', " "},
                                         {'\\', "\\textbackslash{}"},
                                         {'~', "\\textasciitilde{}"},
                                         {'^', "\\textasciicircum{}"},
                                         {'_', "\\_"},
                                         {'%', "\\%"},
                                         {'&', "\\&"},
                                         {'#', "\\#"},
                                         {'$', "\\$"},
                                         {'{', "\\{"},
                                         {'}', "\\}"}});
    // The characters beyond ASCII that our own words use.
    for (const auto& [from, to] : {std::pair{"ν", "$\\nu$"},
                                   {"·", "\\textperiodcentered{}"},
                                   {"²", "$^2$"},
                                   {"−", "$-$"},
                                   {"×", "$\\times$"},
                                   {"µ", "\\textmu{}"}})
        for (std::size_t at = 0; (at = result.find(from, at)) != std::string::npos;)
            result.replace(at, std::string_view(from).size(), to);
    return result;
}

namespace {

/// The figures of a run's folder, and what each of them shows.
struct Shown {
    const char *name, *words, *alternative;
};
constexpr Shown figures[] = {
    {"strip", "Key frames.", ""},
    {"cracks", "Every broken bond in the unloaded body, coloured by its time of breaking.", ""},
    {"curve", "Load over displacement, and energies over time.",
     "Curves of the load over the displacement and of the energies over time, with the events marked."}};

std::string alternative_of(const Shown& figure, const Caption& c) {
    return *figure.alternative ? figure.alternative : c.alternative;
}

/// Else it is a picture that moves.
bool is_video(const std::string& film) { return film.ends_with(".mp4") || film.ends_with(".webm"); }

/// Letters, digits and hyphens: what every program takes for a label.
std::string label_of(const std::string& text) {
    std::string label;
    for (const char c : text) label += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
    return label;
}

}  // namespace

std::string latex_snippet(const Caption& c, const std::string& label, const std::string& film) {
    std::string text = "% \\usepackage{graphicx}, and \\usepackage{textcomp} in old distributions" +
                       (film.empty() ? std::string() : "; the film lies beside: " + film) + "\n";
    for (const Shown& figure : figures)
        text += fmt::format(
            "\\begin{{figure}}\n  \\centering\n  % {}\n  \\includegraphics[width=\\linewidth]"
            "{{figures/{}_print_170mm.png}}\n  \\caption{{{} {}}}\n  \\label{{fig:{}-{}}}\n"
            "\\end{{figure}}\n\n",
            latex_escaped(alternative_of(figure, c)), figure.name, latex_escaped(figure.words),
            latex_escaped(c.text), label_of(label), figure.name);
    return text;
}

std::string quarto_snippet(const Caption& c, const std::string& label, const std::string& film) {
    std::string text;
    if (is_video(film))
        text = fmt::format("{{{{< video {} title=\"{}\" >}}}}\n\n", film, quoted(c.alternative));
    else if (!film.empty())
        text = fmt::format("![]({}){{fig-alt=\"{}\"}}\n\n", film, quoted(c.alternative));
    for (const Shown& figure : figures)
        text += fmt::format("![{} {}](figures/{}_print_170mm.png){{#fig-{}-{} fig-alt=\"{}\"}}\n\n",
                            figure.words, markdown_escaped(c.text), figure.name, label_of(label), figure.name,
                            quoted(alternative_of(figure, c)));
    return text;
}

std::string markdown_snippet(const Caption& c, const std::string& film) {
    const std::string words = markdown_escaped(c.alternative);
    std::string text = film.empty()     ? fmt::format("![{}](poster.png)\n\n", words)
                       : is_video(film) ? fmt::format("[![{}](poster.png)]({})\n\n", words, film)
                                        : fmt::format("![{}]({})\n\n", words, film);
    for (const Shown& figure : figures)
        text += fmt::format("![{}]({}.png)\n\n*{} {}*\n\n", markdown_escaped(alternative_of(figure, c)),
                            figure.name, figure.words, markdown_escaped(c.text));
    return text + (film.empty() ? "" : fmt::format("[Film]({}) · ", film)) + "[Report](report.html)\n";
}

}  // namespace hibi
