/// The programs of firmware/, compiled unmodified, against hosts at the other ends of their lines.
#include "shim_board.hpp"
#include <cstdlib>
#include <map>

namespace
{
const bool LONG = std::getenv("INS_BENCH") != nullptr;
const unsigned ECHO_OCTETS = LONG ? 20000 : 500;

/// A Hayes modem: echo until ATE0, registered from the third question on, answers after a while.
struct modem
{
    shim_board& board;
    host line;
    std::string command;
    size_t seen = 0;
    bool echo = true;
    bool deaf = false;
    bool data = false;
    unsigned asked = 0;
    std::vector<std::string> commands;

    explicit modem(shim_board& b) : board(b), line(b, "SCIRXDA", "SCITXDA", 115200) {}

    void answer()
    {
        commands.push_back(command);
        if (command == "AT+CREG?")
        {
            line.send(++asked < 3 ? "\r\n+CREG: 0,2\r\n" : "\r\n+CREG: 0,1\r\n");
        }
        if (command == "ATD5551234")
        {
            line.send("\r\nCONNECT 9600\r\n");
            data = true;
        }
        else if (command == "ATD999")
        {
            line.send("\r\nBUSY\r\n");
        }
        else
        {
            line.send(command == "at+bad" ? "\r\n+CME ERROR: 3\r\n" : "\r\nOK\r\n");
        }
        echo = echo && command != "ATE0";
        command.clear();
    }
    void poll()
    {
        for (; seen < line.octets.size(); seen++)
        {
            const char c = line.octets[seen];
            if (deaf)
            {
                continue;
            }
            if (data)
            {
                command += c;
                if (command.size() >= 3 && command.compare(command.size() - 3, 3, "+++") == 0)
                {
                    data = false;
                    command.clear();
                    line.send("\r\nOK\r\n");
                }
                continue;
            }
            if (echo)
            {
                line.send(std::string(1, c));
            }
            if (c == '\r')
            {
                answer();
            }
            else
            {
                command += c;
            }
        }
    }
};

struct desk
{
    shim_board board;
    modem m{board};
    host console{board, "SCIRXDB", "SCITXDB", 38400};

    desk() : board(f2812_program_modem, true, false) {}
    void pass(double seconds)
    {
        const emu_time_t end = board.sched.now + static_cast<emu_time_t>(seconds * EMU_PS_PER_S);
        while (board.sched.now < end)
        {
            ASSERT_EQ(board.run(EMU_PS_PER_S / 1000), F2812_REACHED) << board.end();
            m.poll();
        }
    }
    std::string said(double seconds)
    {
        console.octets.clear();
        pass(seconds);
        return console.octets;
    }
    std::string type(const std::string& text, double seconds)
    {
        console.send(text);
        return said(seconds);
    }
};
} // namespace

TEST(shim_programs, loopback_fifo_checks_every_octet_and_returns)
{
    shim_board b(f2812_program_loopback_fifo);
    EXPECT_EQ(b.run(EMU_PS_PER_S), F2812_ENDED);
    EXPECT_EQ(b.end(), "main() returned");
    EXPECT_TRUE(b.reports.empty());
}

TEST(shim_programs, echo_gives_every_octet_back)
{
    shim_board b(f2812_program_echo);
    host h(b, "SCIRXDA", "SCITXDA", 9600);
    b.run(EMU_PS_PER_S / 25);
    EXPECT_EQ(h.octets, "echo ready\r\n");
    h.octets.clear();
    std::string sent;
    uint64_t seed = 9600;
    for (unsigned i = 0; i < ECHO_OCTETS; i++)
    {
        sent += static_cast<char>(emu_random(&seed));
        h.send(sent.substr(i));
        b.run(EMU_PS_PER_S * 11 / 9600);
    }
    b.run(EMU_PS_PER_S / 100);
    EXPECT_EQ(h.octets, sent);
    EXPECT_EQ(h.wrong, 0u);
    EXPECT_TRUE(b.reports.empty());
}

TEST(shim_programs, autobaud_finds_the_bauds_of_hosts)
{
    for (const double baud : {2400.0, 9600.0, 38400.0, 115200.0})
    {
        shim_board b(f2812_program_autobaud);
        host h(b, "SCIRXDA", "SCITXDA", baud);
        b.run(EMU_PS_PER_S / 25);
        h.send("A");
        b.run(EMU_PS_PER_S / 25);
        h.send("hello");
        b.run(EMU_PS_PER_S / 10);
        EXPECT_EQ(h.octets, "Ahello") << baud;
        EXPECT_EQ(h.wrong, 0u) << baud;
    }
}

TEST(shim_programs, the_modem_driver_sets_up_dials_connects_and_hangs_up)
{
    desk d;
    d.pass(1.2);
    EXPECT_EQ(d.console.octets, "modem driver\r\nready\r\n> ");
    EXPECT_EQ(d.m.commands,
              (std::vector<std::string>{"ATZ", "ATE0", "AT+CMEE=1", "AT&D0", "AT+CREG?", "AT+CREG?", "AT+CREG?"}));
    EXPECT_EQ(d.type("dial 999\r", 0.2), "dial 999\r\nbusy\r\n> ");
    EXPECT_EQ(d.type("at+bad\r", 0.2), "at+bad\r\nerror\r\n> ");
    EXPECT_EQ(d.type("nonsensE\x08"
                     "e\r",
                     0.2),
              "nonsensE\b \be\r\nwhat?\r\n> ");
    d.m.line.send("\r\nRING\r\n");
    EXPECT_EQ(d.said(0.1), "[ring]\r\n");
    EXPECT_EQ(d.type("dial 5551234\r", 0.2), "dial 5551234\r\nconnected\r\n");
    d.m.line.send("data from afar");
    EXPECT_EQ(d.type("data from here", 0.8), "data from afar");
    EXPECT_EQ(d.m.command, "data from here");
    EXPECT_EQ(d.type("+++", 1.3), "\r\nOK\r\nhung up\r\n> ");
    EXPECT_EQ(d.m.commands.back(), "ATH");
    EXPECT_EQ(d.type("status\r", 0.3).substr(0, 54),
              "status\r\nstate ready\r\ncalls 1\r\nrings 1\r\nretries 0\r\nmode");
    EXPECT_EQ(d.m.line.wrong + d.console.wrong, 0u);
    EXPECT_TRUE(d.board.reports.empty());
}

TEST(shim_programs, the_modem_driver_asks_again_and_gives_up_on_a_deaf_modem)
{
    desk d;
    d.m.deaf = true;
    EXPECT_EQ(d.said(1.2), "modem driver\r\nno modem\r\n");
    EXPECT_EQ(d.m.line.octets, "ATZ\rATZ\rATZ\r");
    d.m.deaf = false;
    EXPECT_EQ(d.said(2.3), "modem driver\r\nready\r\n> ");
}
