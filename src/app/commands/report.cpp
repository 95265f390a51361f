#include "pictures/report.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

struct ReportOptions {
    std::filesystem::path folder;  ///< of the run
    RendererOptions renderer{};
};

}  // namespace

void add_report(CLI::App& app, int& status) {
    Command* report = app.add_subcommand("report", "Page, caption and snippets of a recorded run once more");
    const auto o = options_of<ReportOptions>();
    report->add_option("DIR", o->folder, "folder of the run")->required();
    add_drawing(*report, o->renderer);
    report->callback([o, &status] {
        write_report(read_recorded_scene(o->folder), RunReader(o->folder), o->renderer);
        fmt::print("{}\n", (o->folder / "report.html").string());
        status = 0;
    });
}

}  // namespace hibi
