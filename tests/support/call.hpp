#pragma once
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace hibi {

struct Answer {
    int status = -1;
    std::string out;  ///< standard output and error together
};

/// What a command of the shell answers.
inline Answer call(const std::string& command) {
    Answer answer;
    FILE* pipe = popen(("{ " + command + "\n} 2>&1").c_str(), "r");
    char buffer[4096];
    while (const std::size_t got = fread(buffer, 1, sizeof buffer, pipe)) answer.out.append(buffer, got);
    const int status = pclose(pipe);
    answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return answer;
}

}  // namespace hibi
