# What f2812-cc links board programs with, for 32 and 64 bits, in ${CMAKE_BINARY_DIR}/f2812/BITS: the device and the shim (libf2812.a), the
# common sources of the headers (libdsp281x.a), and the core in float, compiled to let time pass (libinsf.a) and with the firmware's stdint.h:
# an octet has 16 bits there.
set(INS_F2812_RUNTIME ${CMAKE_BINARY_DIR}/f2812 CACHE INTERNAL "what add_f2812_firmware() links with")
find_program(INS_I686_CC i686-linux-gnu-gcc)
if(NOT INS_I686_CC)
  message(FATAL_ERROR "i686-linux-gnu-gcc, which builds firmware for the F2812 board, is missing. Install it: sudo apt-get install "
                      "--no-install-recommends gcc-i686-linux-gnu libc6-dev-i386-cross (or configure with -DINS_BUILD_FIRMWARE=OFF)")
endif()

# f2812_archive(LIBRARY BITS FOLDER COMMAND ... SOURCES ...): one object of each source by the command, then the archive.
function(f2812_archive library bits)
  cmake_parse_arguments(A "" "" "COMMAND;SOURCES;DEPENDS" ${ARGN})
  set(work ${INS_F2812_RUNTIME}/${bits}/${library}.dir)
  set(objects "")
  foreach(source ${A_SOURCES})
    string(REGEX REPLACE "[/.]" "_" name ${source})
    get_filename_component(name ${source} NAME)
    string(MD5 unique ${source})
    string(SUBSTRING ${unique} 0 6 unique)
    set(object ${work}/${name}-${unique}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${work}
      COMMAND ${A_COMMAND} -MD -MF ${object}.d -MT ${object} -c ${source} -o ${object}
      DEPENDS ${source} ${A_DEPENDS} DEPFILE ${object}.d VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set(archive ${INS_F2812_RUNTIME}/${bits}/${library}.a)
  add_custom_command(OUTPUT ${archive}
    COMMAND ${CMAKE_COMMAND} -E rm -f ${archive}
    COMMAND ${CMAKE_AR} rcs ${archive} ${objects}
    DEPENDS ${objects} COMMENT "F2812 runtime: ${library}, ${bits} bits" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY INS_F2812_ARCHIVES ${archive})
endfunction()

set(here ${CMAKE_CURRENT_SOURCE_DIR})
list(TRANSFORM F2812_SOURCES PREPEND ${here}/ OUTPUT_VARIABLE device)
list(TRANSFORM F2812_SHIM_SOURCES PREPEND ${here}/ OUTPUT_VARIABLE shim)
file(GLOB common CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/emu/common/src/*.c)
file(GLOB guest CONFIGURE_DEPENDS ${here}/dsp281x/source/*.c)
get_target_property(core_sources ins_coref SOURCES)
list(TRANSFORM core_sources PREPEND ${PROJECT_SOURCE_DIR}/libins/core/)
foreach(bits 32 64)
  if(bits EQUAL 32)
    set(cc ${CMAKE_C_COMPILER_LAUNCHER} ${INS_I686_CC} -msse2 -mfpmath=sse -fno-pie)
  else()
    set(cc ${CMAKE_C_COMPILER_LAUNCHER} gcc -fPIE)
  endif()
  set(strict -std=c11 -O2 -Wall -Wextra -Werror -ffp-contract=off -fvisibility=hidden)
  f2812_archive(libf2812 ${bits}
    COMMAND ${cc} ${strict} -I${here}/include -I${PROJECT_SOURCE_DIR}/emu/common/include
    SOURCES ${device} ${common} ${shim} ${here}/shim/main.c ${here}/shim/fault.c ${here}/shim/pipe.c ${here}/shim/pipe_watch.c
            ${here}/shim/summary.c)
  f2812_archive(libdsp281x ${bits} COMMAND ${here}/f2812-cc -m${bits} DEPENDS ${here}/f2812-cc SOURCES ${guest})
  f2812_archive(libinsf ${bits}
    COMMAND ${cc} ${strict} -DINS_REAL_FLOAT -fsanitize-coverage=trace-pc -I${here}/shim/include -I${PROJECT_SOURCE_DIR}/libins/core/include
    SOURCES ${core_sources})
endforeach()
get_property(archives GLOBAL PROPERTY INS_F2812_ARCHIVES)
add_custom_target(f2812_runtime ALL DEPENDS ${archives})
