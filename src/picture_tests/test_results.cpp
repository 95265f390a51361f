#include "picture_tests/test_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const SceneResult& r) {
    std::string text = fmt::format("{:<4} {:<24} ", r.passes() ? "ok" : "FAIL", r.name);
    if (!r.error.empty()) return text + r.error;
    std::string updates;
    for (const std::string& update : r.updates) updates += "\n       " + update;
    if (r.passes() && !updates.empty()) return text + "updated" + updates;
    if (!r.complaint.empty())
        return text + fmt::format(
                          "{}; look at the pictures that hibi test --update missing {} writes, and commit "
                          "them",
                          r.complaint, r.file.string());
    const char* how =
        r.exact ? "exact" : "tolerant, since the references are from another renderer or processor";
    if (r.passes())
        return text + fmt::format("{} pictures {} ({}; {:.1f} s)", r.moments.size(), to_string(r.sameness()),
                                  how, r.seconds);
    text += r.physics.empty() ? "drawing changed, physics the same" : r.physics;
    text += fmt::format(" ({})", how);
    for (const MomentResult& m : r.moments) {
        if (m.complaint.empty()) continue;
        text += fmt::format("\n       {}: {}", m.moment, m.complaint);
        if (!m.page.empty()) text += "\n         " + m.page.string();
    }
    return text + updates;
}

}  // namespace

std::string results_text(const std::vector<SceneResult>& results) {
    std::string text;
    for (const SceneResult& r : results) text += line_of(r) + "\n";
    const auto passed = std::ranges::count_if(results, &SceneResult::passes);
    return text + fmt::format("{} of {} scenes pass\n", passed, results.size());
}

std::string results_json(const std::vector<SceneResult>& results) {
    Json list = Json::array();
    for (const SceneResult& r : results) {
        Json moments = Json::array();
        for (const MomentResult& m : r.moments)
            moments.push_back({{"moment", m.moment},
                               {"sameness", to_string(m.sameness)},
                               {"complaint", m.complaint},
                               {"tile", m.pixels.tile},
                               {"pixels", m.pixels.pixels},
                               {"mean", m.pixels.mean},
                               {"rmse", m.pixels.rmse},
                               {"ssim", m.pixels.ssim},
                               {"page", m.page.string()}});
        list.push_back({{"scene", r.file.string()},
                        {"pass", r.passes()},
                        {"verdict", !r.error.empty()       ? r.error
                                    : !r.complaint.empty() ? r.complaint
                                    : !r.physics.empty()   ? r.physics
                                    : r.passes()           ? "same"
                                                           : "drawing changed, physics the same"},
                        {"exact", r.exact},
                        {"seconds", r.seconds},
                        {"updates", r.updates},
                        {"frames", moments}});
    }
    return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<JunitCase> junit_cases(const std::vector<SceneResult>& results) {
    std::vector<JunitCase> cases;
    for (const SceneResult& r : results) {
        const std::string failure = !r.complaint.empty() ? r.complaint : r.physics;
        cases.push_back({r.name, "physics", r.seconds, failure, r.error});
        for (const MomentResult& m : r.moments) cases.push_back({r.name, m.moment, 0, m.complaint, ""});
    }
    return cases;
}

int test_status(const std::vector<SceneResult>& results) {
    const auto failed = [](const SceneResult& r) { return !r.error.empty(); };
    if (std::ranges::any_of(results, failed)) return 1;
    return std::ranges::all_of(results, &SceneResult::passes) ? 0 : 3;
}

}  // namespace hibi
