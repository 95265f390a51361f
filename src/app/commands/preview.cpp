#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "pictures/draw.hpp"
#include "record/provenance.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

struct PreviewOptions {
    std::filesystem::path scene, png = "setup.png";
    Overrides overrides{};
    RendererOptions renderer{};
};

}  // namespace

void add_preview(CLI::App& app, int& status) {
    Command* preview = app.add_subcommand("preview", "Picture of the body with supports, loads and notches");
    const auto o = options_of<PreviewOptions>();
    add_scene(*preview, o->scene, o->overrides);
    preview->add_option("-o,--output", o->png, "PNG to write")->capture_default_str();
    add_drawing(*preview, o->renderer);
    preview->callback([o, &status] {
        std::vector<std::string> words{"hibi", "preview", path_word(o->scene)};
        for (const std::string& word : words_of(o->overrides)) words.push_back(word);
        words.insert(words.end(), {"-o", path_word(o->png)});
        draw_setup(read_and_build(o->scene, o->overrides), o->png, o->renderer, shell_command(words));
        fmt::print("{}\n", o->png.string());
        status = 0;
    });
}

}  // namespace hibi
