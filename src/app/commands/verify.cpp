#include "studies/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "base/parallel.hpp"

namespace hibi {

namespace {

struct VerifyCommand {
    VerifyOptions verify{};
    bool list = false;  ///< print the cases instead
    bool json = false;  ///< print verify.json instead of the table
};

void print_cases() {
    for (const VerifyCase& c : verify_cases()) {
        std::vector<std::string> values;
        for (const VerifyResolution& r : c.resolutions) values.push_back(fmt::format("{:g}", r.value));
        fmt::print("{:<26} {:<28} {} = {}\n", c.id, c.title, c.parameter, fmt::join(values, ", "));
    }
}

}  // namespace

void add_verify(CLI::App& app, int& status) {
    Command* verify =
        app.add_subcommand("verify", "Accuracy and speed, against answers that are known without particles");
    const auto o = options_of<VerifyCommand>();
    verify->add_option("--case", o->verify.cases, "only this case; may be repeated")->allow_extra_args(false);
    verify->add_option("--variant", o->verify.variant, "default or thesis, of elasticity (default: both)")
        ->check(CLI::IsMember({"default", "thesis"}))
        ->type_name("TEXT");
    verify->add_flag("--list", o->list, "list the cases");
    verify->add_flag("--quick", o->verify.quick, "coarse resolutions only: less than a minute on two cores");
    verify->add_option("--goals", o->verify.goals, "multiply the errors that are allowed by this")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verify->add_option("-o,--output", o->verify.folder, "folder to write to")->capture_default_str();
    verify->add_flag("--json", o->json, "print verify.json instead of the table");
    add_threads(*verify);
    add_quiet(*verify, o->verify.quiet);
    verify->callback([o, &status] {
        if (o->list) {
            print_cases();
            status = 0;
            return;
        }
        const Verification result = run_verification(o->verify);
        if (o->json)
            fmt::print("{}", verification_json(result.rows));
        else
            fmt::print("{}\n{}\n{:.0f} s, {} thread{}; {}\n", verification_table(result.rows),
                       verification_verdict(result.rows), result.seconds, threads(),
                       threads() == 1 ? "" : "s", (o->verify.folder / "verify.html").string());
        status = result.passes() ? 0 : 1;
    });
}

}  // namespace hibi
