/// \file   process.cpp
/// \brief  See process.hpp. SPDX-License-Identifier: MIT
#include "process.hpp"
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <elf.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace libins
{
namespace
{

constexpr int program_fd = 3;
constexpr size_t said_most = 400; ///< characters of a program's output in a message

/// In the child, between fork and exec: only what may be called there. Does not return.
[[noreturn]] void become(const char* path, int socket, int output, int failure, pid_t parent)
{
    char* const arguments[] = {const_cast<char*>(path), const_cast<char*>("--pipe"), const_cast<char*>("3"), nullptr};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN); // Ctrl-C is for the run, which ends its programs
    if (getppid() != parent)
    {
        _exit(1);
    }
    // Above the numbers that they get, whatever was closed here.
    const int link = fcntl(socket, F_DUPFD_CLOEXEC, program_fd + 1);
    const int said = fcntl(output, F_DUPFD_CLOEXEC, program_fd + 1);
    const int kept = fcntl(failure, F_DUPFD_CLOEXEC, program_fd + 1);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(said, STDOUT_FILENO);
    dup2(said, STDERR_FILENO);
    dup2(link, program_fd);
    execv(path, arguments);
    const int why = errno;
    const ssize_t told = write(kept, &why, sizeof why);
    _exit(told == sizeof why ? 1 : 2);
}

/// Why a file that cannot be executed cannot.
std::string not_executed(const std::string& path, int why)
{
    if (why == ENOENT)
    {
        return "there is no such file; build it, or give its path";
    }
    if (why == EACCES)
    {
        return "it may not be executed; chmod +x, and see that it is a file on a disk mounted without noexec";
    }
    std::array<unsigned char, EI_NIDENT> ident{};
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const bool elf = file >= 0 && read(file, ident.data(), ident.size()) == static_cast<ssize_t>(ident.size()) &&
                     std::memcmp(ident.data(), ELFMAG, SELFMAG) == 0;
    close(file);
    if (why == ENOEXEC && elf && ident[EI_CLASS] == ELFCLASS32)
    {
        return "this kernel runs no 32-bit programs; build the firmware with BITS 64";
    }
    if (why == ENOEXEC)
    {
        return "it is no program for this machine; add_f2812_firmware() and f2812-cc make board programs";
    }
    return std::strerror(why);
}

} // namespace

Process::Process(std::string station, std::string path)
    : station_(std::move(station)), path_(std::move(path)), octets_(new uint8_t[F2812_LINK_OCTETS + 1])
{
    try
    {
        begin();
        greet();
    }
    catch (...)
    {
        end();
        throw;
    }
}

Process::~Process()
{
    end();
}

void Process::end() noexcept
{
    if (pid_ > 0)
    {
        kill(pid_, SIGKILL);
        while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR)
        {
        }
        pid_ = -1;
    }
    for (int* const fd : {&socket_, &output_})
    {
        if (*fd >= 0)
        {
            close(std::exchange(*fd, -1));
        }
    }
}

void Process::begin()
{
    std::array<int, 2> sockets{}, failure{};
    output_ = memfd_create("f2812 output", MFD_CLOEXEC);
    if (output_ < 0 || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    {
        fail(std::string("no socket could be made for it: ") + std::strerror(errno), 0);
    }
    socket_ = sockets[0];
    if (pipe2(failure.data(), O_CLOEXEC) != 0)
    {
        close(sockets[1]);
        fail(std::string("no pipe could be made for it: ") + std::strerror(errno), 0);
    }
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0)
    {
        become(path_.c_str(), sockets[1], output_, failure[1], parent);
    }
    const int no_fork = errno;
    close(sockets[1]);
    close(failure[1]);
    int why = 0;
    ssize_t told = 0;
    while (pid_ > 0 && (told = read(failure[0], &why, sizeof why)) < 0 && errno == EINTR)
    {
    }
    close(failure[0]);
    if (pid_ < 0)
    {
        fail(std::string("no process could be made for it: ") + std::strerror(no_fork), 0);
    }
    if (told == sizeof why)
    {
        fail(not_executed(path_, why), 0);
    }
}

void Process::greet()
{
    const auto message = std::make_unique<f2812_link_t>();
    wait_for_message(hello_most_s, 0);
    const ssize_t size = recv(socket_, octets_.get(), F2812_LINK_OCTETS, MSG_PEEK);
    constexpr size_t head = 9; // kind, name of four characters, version
    const bool hello = size >= static_cast<ssize_t>(head) && octets_[0] == F2812_LINK_HELLO &&
                       std::memcmp(octets_.get() + 1, "F28W", 4) == 0;
    if (hello && octets_[5] != F2812_LINK_VERSION)
    {
        fail("it speaks version " + std::to_string(octets_[5]) + " of the link, this libins version " +
                 std::to_string(F2812_LINK_VERSION) + "; build it again with this libins",
             0);
    }
    if (size > 0 && !hello)
    {
        fail("it is no board program: it does not greet as one; add_f2812_firmware() and f2812-cc make them", 0);
    }
    receive(*message, 0);
    name_ = message->u.hello.name;
    bits_ = message->u.hello.bits;
}

std::string Process::said() const
{
    std::array<char, said_most> text{};
    const off_t size = lseek(output_, 0, SEEK_END);
    const off_t from = std::max<off_t>(0, size - static_cast<off_t>(text.size()));
    const ssize_t got = pread(output_, text.data(), text.size(), from);
    std::string tail(text.data(), got > 0 ? static_cast<size_t>(got) : 0);
    while (!tail.empty() && tail.back() == '\n')
    {
        tail.pop_back();
    }
    return tail.empty() ? tail : "; it wrote: " + tail;
}

void Process::fail(const std::string& what, emu_time_t at)
{
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "%.9f", static_cast<double>(at) * 1e-12);
    const std::string text = "station " + station_ + ", program " + path_ + ", at " + seconds.data() + " s: " + what +
                             (output_ >= 0 ? said() : "");
    end();
    throw ProgramError(text);
}

void Process::gone(emu_time_t at)
{
    int status = 0;
    // It closed the socket: it is ending, or it goes on without a run, and is ended here.
    pid_t ended = 0;
    constexpr int looks = 100;
    for (int i = 0; i < looks && ended == 0; i++)
    {
        ended = waitpid(pid_, &status, WNOHANG);
        poll(nullptr, 0, ended == 0 ? 10 : 0);
    }
    if (ended != pid_)
    {
        fail("it closed its socket and went on; a board program may not", at);
    }
    pid_ = -1;
    if (WIFSIGNALED(status))
    {
        fail("it was ended by signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) +
                 "): the firmware used memory that is not its own, or somebody killed it; run it alone in a debugger",
             at);
    }
    const std::string status_text = std::to_string(WEXITSTATUS(status));
    fail(bits_ == 0 ? "it ended with status " + status_text +
                          " and did not greet: it is no board program; add_f2812_firmware() and f2812-cc make them"
                    : "it ended by itself with status " + status_text + "; a board program ends when its run does",
         at);
}

void Process::send(f2812_link_t& message, emu_time_t at)
{
    if (socket_ < 0)
    {
        throw ProgramError("station " + station_ + ", program " + path_ + ": it has ended; make a new net");
    }
    emu_state_t io{};
    io.to = octets_.get();
    io.size = F2812_LINK_OCTETS;
    const size_t size = f2812_link_walk(&message, &io);
    if (size == 0)
    {
        throw std::logic_error("a message that is too long");
    }
    ssize_t sent = 0;
    while ((sent = ::send(socket_, octets_.get(), size, MSG_NOSIGNAL)) < 0 && errno == EINTR)
    {
    }
    if (sent != static_cast<ssize_t>(size))
    {
        gone(at);
    }
}

void Process::wait_for_message(double most_s, emu_time_t at)
{
    using clock = std::chrono::steady_clock;
    const auto end = clock::now() + std::chrono::duration<double>(most_s);
    for (;;)
    {
        pollfd socket{socket_, POLLIN, 0};
        const double left_ms = std::ceil(std::chrono::duration<double, std::milli>(end - clock::now()).count());
        const int ready = poll(&socket, 1, static_cast<int>(std::max(0.0, std::min(left_ms, 1e9))));
        if (ready > 0)
        {
            return;
        }
        if (ready == 0 && left_ms <= 0.0)
        {
            fail("no answer for " + std::to_string(static_cast<int>(most_s)) +
                     " s of wall clock: the firmware loops where no hook is (code that f2812-cc did not compile, or a "
                     "loop without a volatile access); give it one, or set a longer patience_s",
                 at);
        }
    }
}

void Process::receive(f2812_link_t& message, emu_time_t at)
{
    wait_for_message(patience_s_, at);
    const ssize_t size = recv(socket_, octets_.get(), F2812_LINK_OCTETS + 1, 0);
    if (size <= 0)
    {
        gone(at);
    }
    emu_state_t io{};
    io.from = octets_.get();
    io.size = static_cast<size_t>(size);
    if (f2812_link_walk(&message, &io) == 0)
    {
        fail("it sent " + std::to_string(size) + " octets that are no message; build it again with this libins", at);
    }
}

} // namespace libins
