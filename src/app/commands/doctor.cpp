#include "app/doctor.hpp"

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_doctor(CLI::App& app, int& status) {
    Command* doctor = app.add_subcommand("doctor", "What works on this machine, and what to install");
    const auto json = options_of<bool>();
    doctor->add_flag("--json", *json, "print JSON");
    doctor->callback([json, &status] { status = doctor_command(*json); });
}

}  // namespace hibi
