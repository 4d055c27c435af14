/// \file   process.hpp
/// \brief  A board program as a process of its own, and the messages of emu_f2812/wirelink.h with it.
///
/// Whatever the program does, a call comes back: with its answer, or with an exception that says which program, which station and when.
/// No process outlives its object, nor this process.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu_f2812/wirelink.h"
#include <memory>
#include <stdexcept>
#include <string>
#include <sys/types.h>

namespace libins
{

/// A station's program died, hangs or says what it must not.
class ProgramError : public std::runtime_error
{
  public:
    using std::runtime_error::runtime_error;
};

class Process
{
  public:
    static constexpr double patience_default_s = 60.0; ///< of wall clock without a message
    static constexpr double hello_most_s = 10.0;       ///< a board program speaks before it does anything else

    /// Begins it. Throws ProgramError.
    Process(std::string station, std::string path);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// `at` is for the message of an error.
    void send(f2812_link_t& message, emu_time_t at);
    void receive(f2812_link_t& message, emu_time_t at);
    void set_patience(double seconds) { patience_s_ = seconds; }
    const std::string& name() const { return name_; } ///< of the firmware, as the program says
    unsigned bits() const { return bits_; }
    pid_t pid() const { return pid_; }

  private:
    void begin();
    void greet();
    void wait_for_message(double most_s, emu_time_t at);
    [[noreturn]] void gone(emu_time_t at);
    [[noreturn]] void fail(const std::string& what, emu_time_t at);
    std::string said() const;
    void end() noexcept;

    std::string station_, path_, name_;
    unsigned bits_ = 0;
    pid_t pid_ = -1;
    int socket_ = -1;
    int output_ = -1; ///< what the program wrote to stdout and stderr
    double patience_s_ = patience_default_s;
    std::unique_ptr<uint8_t[]> octets_;
};

} // namespace libins
