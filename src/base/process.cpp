#include "base/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace hibi {

namespace {

/// The children that run now, for the handler of signals: a study that is ended takes its runs with it.
std::array<std::atomic<pid_t>, 1024> children{};

void end_children(int signal) {
    for (const std::atomic<pid_t>& child : children)
        if (const pid_t id = child.load(); id > 0) kill(id, SIGTERM);
    std::signal(signal, SIG_DFL);
    raise(signal);
}

/// Counts a child among them while it runs.
class Registered {
 public:
    explicit Registered(pid_t id) {
        for (std::atomic<pid_t>& place : children) {
            pid_t none = 0;
            if (place.compare_exchange_strong(none, id)) {
                place_ = &place;
                return;
            }
        }
    }
    ~Registered() {
        if (place_) place_->store(0);
    }
    Registered(const Registered&) = delete;
    Registered& operator=(const Registered&) = delete;

 private:
    std::atomic<pid_t>* place_ = nullptr;
};

}  // namespace

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
    const Registered registered(error == 0 ? child : 0);
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
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, end_children);
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
