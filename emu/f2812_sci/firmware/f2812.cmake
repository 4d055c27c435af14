# add_f2812_firmware(NAME app SOURCES main.c ... [INCLUDES dir ...] [DEFINES A=1 ...] [BITS 32|64] [CORE] [IGNORE_CASE] [OBJECT])
#
# TI-style C for the TMS320F2812 as a program that runs on the emulated board: ${CMAKE_BINARY_DIR}/firmware/app.f2812 (app.64.f2812 with
# BITS 64), a static executable, by the target firmware_app (firmware_app_64). CORE links the navigation core in float; IGNORE_CASE finds
# #include names as Windows does; OBJECT makes ${CMAKE_BINARY_DIR}/firmware/app.64.o instead, which offers f2812_program_app to a program
# that links it with the emulator. f2812-cc --help says the rest.


function(add_f2812_firmware)
  cmake_parse_arguments(A "CORE;IGNORE_CASE;OBJECT" "NAME;BITS" "SOURCES;INCLUDES;DEFINES" ${ARGN})
  set(here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  if(NOT A_NAME OR NOT A_SOURCES OR A_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "add_f2812_firmware(NAME n SOURCES a.c ...): NAME or SOURCES is missing, or unknown: ${A_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT A_BITS)
    set(A_BITS 32)
  endif()
  if(INS_F2812_RUNTIME) # in the tree
    set(cc ${here}/../f2812-cc --lib ${INS_F2812_RUNTIME})
    set(runtime ${INS_F2812_RUNTIME}/${A_BITS}/libf2812.a ${INS_F2812_RUNTIME}/${A_BITS}/libdsp281x.a ${here}/../f2812-cc
                ${here}/../shim/program.c ${here}/../shim/prelink.ld)
    if(A_CORE)
      list(APPEND runtime ${INS_F2812_RUNTIME}/${A_BITS}/libinsf.a)
    endif()
  else()
    find_program(INS_F2812_CC f2812-cc PATHS ${here}/../../../bin ${here}/../../../../bin NO_DEFAULT_PATH REQUIRED)
    set(cc ${INS_F2812_CC})
    set(runtime ${INS_F2812_CC})
  endif()
  set(flags -m${A_BITS})
  set(suffix "")
  if(A_BITS EQUAL 64)
    set(suffix .64)
  endif()
  if(A_CORE)
    list(APPEND flags --core)
  endif()
  if(A_IGNORE_CASE)
    list(APPEND flags --ignore-case)
  endif()
  set(compile_flags ${flags})
  foreach(folder ${A_INCLUDES})
    get_filename_component(folder ${folder} ABSOLUTE)
    list(APPEND compile_flags -I${folder})
  endforeach()
  foreach(define ${A_DEFINES})
    list(APPEND compile_flags -D${define})
  endforeach()
  set(work ${CMAKE_CURRENT_BINARY_DIR}/firmware/${A_NAME}${suffix})
  set(objects "")
  foreach(source ${A_SOURCES})
    get_filename_component(source ${source} ABSOLUTE)
    get_filename_component(stem ${source} NAME_WE)
    string(MD5 unique ${source})
    string(SUBSTRING ${unique} 0 6 unique)
    set(object ${work}/${stem}-${unique}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${work}
      COMMAND ${cc} ${compile_flags} -MD -MF ${object}.d -MT ${object} -c ${source} -o ${object}
      DEPENDS ${source} ${runtime} DEPFILE ${object}.d
      COMMENT "F2812 ${A_NAME}${suffix}: ${stem}.c" VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  if(A_OBJECT)
    set(program ${CMAKE_BINARY_DIR}/firmware/${A_NAME}${suffix}.o)
    list(APPEND flags --object ${A_NAME})
  else()
    set(program ${CMAKE_BINARY_DIR}/firmware/${A_NAME}${suffix}.f2812)
  endif()
  add_custom_command(OUTPUT ${program}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/firmware
    COMMAND ${cc} ${flags} ${objects} -o ${program}
    DEPENDS ${objects} ${runtime}
    COMMENT "F2812 ${A_NAME}${suffix}" VERBATIM)
  string(REPLACE "." "_" target_suffix "${suffix}")
  set(target firmware_${A_NAME}${target_suffix})
  if(A_OBJECT)
    string(APPEND target _object)
  endif()
  add_custom_target(${target} ALL DEPENDS ${program})
endfunction()
