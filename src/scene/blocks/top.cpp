#include "scene/blocks/blocks.hpp"
#include "scene/scene_file.hpp"

namespace hibi {

SceneBlock top_block() {
    Block<Scene> top("", KeyBlock::Form::single, "What the experiment is.");
    top.keys.title = "the top of the file";
    top.bound(
        {"version", KeyKind::integer, "", "version of the scene format", "1"},
        [](BlockReader& block, Scene&) {
            const auto version = block.integer("version");
            if (version && *version != 1)
                block.fail("version",
                           fmt::format("version {} of the scene format is not known here", *version),
                           "this program reads version = 1");
        },
        [](WrittenKeys& out, const Scene&) { out.add("version", "1"); });
    top.add("title", &Scene::title, "", "shown on every frame; one line, in any script; there are no emoji",
            R"("Bending failure")",
            by_default("the file's name"));
    top.add("about", &Scene::about, "", "what it shows, and where it is from", R"("Figure 7 of ...")",
            by_default("empty"));
    top.afterwards([](BlockReader& block, Scene& scene) {
        if (scene.title.find_first_of("\n\r\t") != std::string::npos)
            block.fail("title", "title needs to be one line");
    });

    SceneBlock result{top.keys};
    result.read = [top](const Value& document, ReadContext& context, Scene& scene) {
        scene.title = scene_name(scene.file);
        Value own;  // without the blocks
        own.place = document.place;
        for (const Entry& entry : document.entries)
            if (top.keys.find(entry.key)) own.entries.push_back(entry);
        BlockReader reader(context, own, scene_block(""), "", "the scene");
        top.read(reader, scene);
    };
    result.write = [top](const Scene& scene) {
        WrittenKeys out{scene};
        top.write(out, scene);
        return out.in_lines();
    };
    return result;
}

}  // namespace hibi
