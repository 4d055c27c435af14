/// \file   gauss.c
/// \brief  10-node Gauss-Legendre quadrature; Abramowitz and Stegun 1964, table 25.4.
/// SPDX-License-Identifier: MIT
#include "gauss_internal.h"

void ins_gauss_add(ins_gauss_integrand_t* f, const void* ctx, double a, double b, int n, double sum[])
{
    static const double node[5][2] = {{0.14887433898163121, 0.29552422471475287},
                                      {0.43339539412924719, 0.26926671930999636},
                                      {0.67940956829902441, 0.21908636251598204},
                                      {0.86506336668898451, 0.14945134915058059},
                                      {0.97390652851717172, 0.066671344308688138}};
    const double half = 0.5 * (b - a);
    const double middle = 0.5 * (a + b);
    for (int k = 0; k < 5; k++)
    {
        double before[INS_GAUSS_MOST];
        double after[INS_GAUSS_MOST];
        f(ctx, middle - half * node[k][0], before);
        f(ctx, middle + half * node[k][0], after);
        for (int i = 0; i < n; i++)
        {
            sum[i] += half * node[k][1] * (before[i] + after[i]);
        }
    }
}
