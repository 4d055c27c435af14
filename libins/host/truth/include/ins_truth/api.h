/// \file   ins_truth/api.h
/// \brief  What a user of libins_truth sees: the export mark.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_API_H_INCLUDED
#define INS_TRUTH_API_H_INCLUDED

#define INS_TRUTH_API __attribute__((visibility("default")))

#endif // INS_TRUTH_API_H_INCLUDED
