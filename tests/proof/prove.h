/// \file   prove.h
/// \brief  The words of a proof in ESBMC. A local variable that is not set stands for any value.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_PROVE_H
#define INS_TESTS_PROVE_H
#include "sound.h"

void __ESBMC_assume(_Bool);
void __ESBMC_assert(_Bool, const char*);
#define GIVEN(condition) __ESBMC_assume(condition)
#define PROVE(condition) __ESBMC_assert(condition, #condition)

#endif // INS_TESTS_PROVE_H
