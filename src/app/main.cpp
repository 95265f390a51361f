#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "app/command_line.hpp"
#include "base/memory.hpp"
#include "scene/read.hpp"

int main(int argc, char** argv) {
    hibi::keep_freed_memory();
    try {
        return hibi::run_command_line(argc, argv);
    } catch (const hibi::SceneErrors& errors) {
        fmt::print(stderr, "{}\n", errors.what());
        return 2;
    } catch (const std::invalid_argument& error) {
        fmt::print(stderr, "hibi: error: {}\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "hibi: error: {}\n", error.what());
        return 1;
    }
}
