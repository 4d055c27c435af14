// A child process with its input and outputs on pipes, killed when it outlives the test.
// SPDX-License-Identifier: MIT
#ifndef TESTS_NAVD_PROCESS_HPP
#define TESTS_NAVD_PROCESS_HPP
#include "board.hpp"
#include <csignal>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/wait.h>
#include <vector>

class Process
{
  public:
    explicit Process(std::vector<std::string> arguments)
    {
        int out_pipe[2];
        int err_pipe[2];
        int in_pipe[2];
        if (pipe2(in_pipe, O_CLOEXEC) != 0 || pipe2(out_pipe, O_CLOEXEC) != 0 || pipe2(err_pipe, O_CLOEXEC) != 0)
        {
            throw std::runtime_error("no pipe");
        }
        std::vector<char*> argv;
        for (std::string& a : arguments)
        {
            argv.push_back(a.data());
        }
        argv.push_back(nullptr);
        pid = fork();
        if (pid == 0)
        {
            dup2(in_pipe[0], STDIN_FILENO);
            dup2(out_pipe[1], STDOUT_FILENO);
            dup2(err_pipe[1], STDERR_FILENO);
            execvp(argv[0], argv.data());
            _exit(127);
        }
        close(in_pipe[0]);
        close(out_pipe[1]);
        close(err_pipe[1]);
        in_fd = in_pipe[1];
        out_fd = out_pipe[0];
        err_fd = err_pipe[0];
    }
    ~Process()
    {
        if (status < 0)
        {
            kill(pid, SIGKILL);
            waitpid(pid, nullptr, 0);
        }
        close_in();
        close_out();
        close(err_fd);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void signal(int number) const { kill(pid, number); }
    void close_in() { close_one(in_fd); }
    void close_out() { close_one(out_fd); }
    /// Small pipe, so that a daemon whose lines are not read soon waits.
    void shrink_out() const { (void)fcntl(out_fd, F_SETPIPE_SZ, 4096); }

    /// Read both outputs until `enough` says so. \return false when limit_s passed, or the outputs ended, before that.
    template <typename Enough> bool read_until(Enough enough, double limit_s, bool read_out = true)
    {
        for (const double end = seconds_now() + limit_s; !enough();)
        {
            const double left = end - seconds_now();
            const bool want_out = read_out && out_fd >= 0 && !out_ended;
            if (left <= 0 || (err_ended && !want_out))
            {
                return false;
            }
            pollfd p[2] = {{err_ended ? -1 : err_fd, POLLIN, 0}, {want_out ? out_fd : -1, POLLIN, 0}};
            (void)poll(p, 2, static_cast<int>(left * 1000) + 1);
            err_ended = err_ended || (p[0].revents != 0 && !drain(err_fd, err));
            out_ended = out_ended || (p[1].revents != 0 && !drain(out_fd, out));
        }
        return true;
    }
    /// Reads to the end. \return exit code, or -1 when it did not end in time, or 128 + signal.
    int finish(double limit_s)
    {
        (void)read_until([] { return false; }, limit_s);
        const double end = seconds_now() + 1.0;
        int code = 0;
        while (waitpid(pid, &code, WNOHANG) == 0)
        {
            if (seconds_now() > end)
            {
                return -1;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        status = WIFEXITED(code) ? WEXITSTATUS(code) : 128 + WTERMSIG(code);
        return status;
    }

    /// Whole lines so far, each parsed; a line that is no JSON throws.
    static std::vector<nlohmann::json> lines(const std::string& text)
    {
        std::vector<nlohmann::json> list;
        for (size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
        {
            list.push_back(nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                 text.begin() + static_cast<std::ptrdiff_t>(end)));
        }
        return list;
    }
    std::vector<nlohmann::json> states() const { return lines(out); }
    /// Events of a name on standard error, whose other lines are left out.
    std::vector<nlohmann::json> events(const std::string& name) const
    {
        std::vector<nlohmann::json> list;
        std::istringstream stream(err);
        for (std::string line; std::getline(stream, line);)
        {
            if (line.rfind("{\"event\":\"" + name + "\"", 0) == 0 && line.back() == '}')
            {
                list.push_back(nlohmann::json::parse(line));
            }
        }
        return list;
    }

    std::string out;
    std::string err;

  private:
    static void close_one(int& fd)
    {
        if (fd >= 0)
        {
            close(fd);
            fd = -1;
        }
    }
    static bool drain(int fd, std::string& text)
    {
        char buffer[65536];
        const ssize_t n = read(fd, buffer, sizeof buffer);
        text.append(buffer, n > 0 ? static_cast<size_t>(n) : 0);
        return n > 0;
    }

    pid_t pid;
    int in_fd;
    int out_fd;
    int err_fd;
    bool out_ended = false;
    bool err_ended = false;
    int status = -1;
};
#endif // TESTS_NAVD_PROCESS_HPP
