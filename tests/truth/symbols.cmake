# SPDX-License-Identifier: MIT
# Fails when ARCHIVE needs a symbol that is neither its own nor in the list below (sanitizer and coverage run times aside).
cmake_minimum_required(VERSION 3.25)
set(allowed sqrt floor fabs malloc calloc free memcpy memset vsnprintf)

function(symbols out option)
  execute_process(COMMAND ${NM} --format=posix ${option} ${ARCHIVE} OUTPUT_VARIABLE text RESULT_VARIABLE rc)
  if(NOT rc EQUAL 0)
    message(FATAL_ERROR "${NM} ${option} ${ARCHIVE} failed")
  endif()
  string(REPLACE "\n" ";" names "${text}") # lines: "name letter value size", or a heading "archive[member]:"
  list(FILTER names INCLUDE REGEX "^[^ :]+ [A-Za-z]( |$)")
  list(TRANSFORM names REPLACE " .*" "")
  set(${out} ${names} PARENT_SCOPE)
endfunction()

symbols(own --defined-only)
symbols(needed --undefined-only)
if(NOT "ins_truth_sincos" IN_LIST own)
  message(FATAL_ERROR "ins_truth_sincos not found in ${ARCHIVE}: is the list of symbols read correctly?")
endif()
list(REMOVE_DUPLICATES needed)
list(REMOVE_ITEM needed ${own} ${allowed})
list(FILTER needed EXCLUDE REGEX "^(__asan_|__ubsan_|__gcov_|__stack_chk_fail|_GLOBAL_OFFSET_TABLE_)")
if(needed)
  message(FATAL_ERROR "libins_truth needs ${needed}; only ${allowed} are allowed")
endif()
