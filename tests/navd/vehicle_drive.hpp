// A drive as a receiver and an odometer board would tell it: sentences of a car that turns, with fixes where they are wanted.
// SPDX-License-Identifier: MIT
#ifndef TESTS_NAVD_VEHICLE_DRIVE_HPP
#define TESTS_NAVD_VEHICLE_DRIVE_HPP
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>

namespace vehicle_drive
{
constexpr double PI = 3.14159265358979323846;
constexpr double LATITUDE = 52.5 * PI / 180;
constexpr double LONGITUDE = -13.375 * PI / 180;
constexpr double METRES_PER_COUNT = 0.04;
constexpr double LSB = 180.0 / 4096 * PI / 180;
constexpr double RADIUS_N = 6376073; ///< of the meridian there, WGS-84 [m]
constexpr double RADIUS_E = 6391684; ///< of the normal [m]
constexpr double FIX_SIGMA = 3;      ///< [m]

inline std::string sentence(const std::string& body)
{
    unsigned sum = 0;
    for (const char c : body)
    {
        sum ^= static_cast<unsigned char>(c);
    }
    char end[8];
    (void)std::snprintf(end, sizeof end, "*%02X\r\n", sum);
    return "$" + body + end;
}

inline std::string board_sentence(uint32_t ms, uint32_t counts, uint32_t code)
{
    return sentence("PINSD," + std::to_string(ms) + "," + std::to_string(counts) + "," + std::to_string(code));
}

/// ddmm.mmmmmmm,N
inline std::string angle(double rad, int digits, const char* signs)
{
    const double minutes = std::fabs(rad) * 180 / PI * 60;
    const int whole = static_cast<int>(minutes / 60);
    char text[40];
    (void)std::snprintf(text, sizeof text, "%0*d%010.7f,%c", digits, whole, minutes - 60 * whole, signs[rad < 0]);
    return text;
}

class Drive
{
  public:
    explicit Drive(unsigned seed) : random(seed) {}

    /// 100 ms of it: the board's sentence, and before it, each tenth time, the receiver's.
    std::string step(bool visible, bool with_course = false)
    {
        const double rate = 0.3 * std::sin(0.13 * t);
        const double middle = heading + rate * 0.05;
        east += 0.1 * speed * std::sin(middle);
        north += 0.1 * speed * std::cos(middle);
        heading += 0.1 * rate;
        way += 0.1 * speed;
        t += 0.1;
        tick++;
        const double now = 0.3 * std::sin(0.13 * t);
        const std::string board = board_sentence(100 * tick, static_cast<uint32_t>(way / METRES_PER_COUNT),
                                                 static_cast<uint32_t>(std::lround((now + bias) / LSB + 2048)));
        return tick % 10 == 0 ? receiver(visible, with_course) + board : board;
    }
    double latitude() const { return LATITUDE + north / RADIUS_N; }
    double longitude() const { return LONGITUDE + east / (RADIUS_E * std::cos(LATITUDE)); }

    double t = 0, east = 0, north = 0, heading = 2, speed = 10, way = 0, bias = 0.005;
    uint32_t tick = 0;

  private:
    std::string receiver(bool visible, bool with_course)
    {
        char clock[16];
        const int s = 45296 + static_cast<int>(std::lround(t)); // 12:34:56 and on
        (void)std::snprintf(clock, sizeof clock, "%02d%02d%02d.00", s / 3600 % 24, s / 60 % 60, s % 60);
        if (!visible)
        {
            return sentence(std::string("GPGGA,") + clock + ",,,,,0,00,,,M,,M,,");
        }
        // One after the other: within one expression the order would be the compiler's.
        const double east_error = FIX_SIGMA * normal(random);
        const double north_error = FIX_SIGMA * normal(random);
        const std::string where = angle(latitude() + north_error / RADIUS_N, 2, "NS") + "," +
                                  angle(longitude() + east_error / (RADIUS_E * std::cos(LATITUDE)), 3, "EW");
        char motion[64] = ",,";
        if (with_course)
        {
            (void)std::snprintf(motion, sizeof motion, ",%.3f,%.2f", speed * 3600 / 1852,
                                std::fmod(heading * 180 / PI + 720, 360));
        }
        return sentence(std::string("GPGGA,") + clock + "," + where + ",1,09,0.60,40.0,M,0.0,M,,") +
               sentence(std::string("GPRMC,") + clock + ",A," + where + motion + ",030526,,,A");
    }

    std::mt19937 random;
    std::normal_distribution<double> normal;
};
} // namespace vehicle_drive
#endif // TESTS_NAVD_VEHICLE_DRIVE_HPP
