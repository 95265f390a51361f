#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hibi {

/// The file of the program that runs.
std::filesystem::path this_program();

struct ProcessEnd {
    int status = 0;            ///< exit status, or 128 + the number of the signal that ended it
    std::string error_output;  ///< what it wrote to standard error
};

/// Runs a program to its end, its standard output thrown away. words[0] is its file. Throws
/// std::runtime_error where it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& words);

/// Calls work(0) .. work(count - 1) on so many threads; done(k) on the calling thread's behalf, one at a
/// time. The first exception is thrown again when all have stopped. A signal that ends this program ends its
/// children, too.
void in_parallel(int count, int jobs, const std::function<void(int)>& work,
                 const std::function<void()>& done);

}  // namespace hibi
