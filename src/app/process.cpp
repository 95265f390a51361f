#include "app/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace hibi {

std::filesystem::path this_program() {
    std::error_code error;
    const std::filesystem::path link = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::path(program_invocation_name) : link;  // a bare chroot has no /proc
}

ProcessEnd run_process(const std::vector<std::string>& words) {
    int pipe_ends[2];
    if (pipe2(pipe_ends, O_CLOEXEC) != 0)
        throw std::runtime_error(fmt::format("cannot start {}: {}", words[0], std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int error = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    ProcessEnd end;
    if (error == 0) {
        char buffer[4096];
        ssize_t got = 0;
        while ((got = read(pipe_ends[0], buffer, sizeof buffer)) > 0 || (got < 0 && errno == EINTR))
            if (got > 0) end.error_output.append(buffer, static_cast<std::size_t>(got));
    }
    close(pipe_ends[0]);
    if (error != 0)
        throw std::runtime_error(fmt::format("cannot start {}: {}", words[0], std::strerror(error)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    end.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return end;
}

void in_parallel(int count, int jobs, const std::function<void(int)>& work,
                 const std::function<void()>& done) {
    std::atomic<int> next = 0;
    std::mutex mutex;  // guards done and error
    std::exception_ptr error;
    const auto loop = [&] {
        for (int k = next++; k < count; k = next++) {
            try {
                work(k);
                const std::lock_guard lock(mutex);
                done();
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!error) error = std::current_exception();
                next = count;
            }
        }
    };
    std::vector<std::thread> threads;
    for (int k = 0; k < std::min(jobs, count); ++k) threads.emplace_back(loop);
    for (std::thread& thread : threads) thread.join();
    if (error) std::rethrow_exception(error);
}

}  // namespace hibi
