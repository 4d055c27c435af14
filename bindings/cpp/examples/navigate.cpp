#include "ins/ins.hpp"
#include <cstdio>

int main()
{
    Eigen::Matrix<ins::Real, 3, Eigen::Dynamic> w_ib_b(3, 500), dtheta_b(3, 500); // one sample a column
    Eigen::Matrix<ins::Real, 4, Eigen::Dynamic> q_nb(4, 500);                     // one attitude a column: x, y, z, w
    w_ib_b.colwise() = ins::Vector3(0, 0, ins::Real(0.2));                        // your gyro, rad/s
    ins::Rates rates;
    ins::Attitude attitude;
    if (!ok(rates.init(4, ins::Real(0.02))) || !ok(attitude.init(INS_CONING_HIST2_OPT, ins::Quaternion::Identity())) ||
        !rates.run(w_ib_b, dtheta_b) || !attitude.run(dtheta_b, q_nb))
    {
        return 1; // a Status says why
    }
    std::printf("heading %.3f rad\n", static_cast<double>(ins::to_euler(attitude.q_nb()).z()));
}
